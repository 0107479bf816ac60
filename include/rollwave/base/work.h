#ifndef ROLLWAVE_BASE_WORK_H
#define ROLLWAVE_BASE_WORK_H

#include <deal.II/base/timer.h>

#include <string>
#include <utility>
#include <vector>

namespace rollwave {

/// What a run has done and how long each phase took, so that it can be seen what a scene costs.
class Work {
public:
  unsigned int load_assemblies = 0;
  unsigned int stiffness_assemblies = 0;
  unsigned int orderings = 0;            ///< symbolic analyses of sparse matrices
  unsigned int factorisations = 0;       ///< of sparse matrices
  unsigned int dense_factorisations = 0; ///< of its Schur complement on contact nodes
  unsigned int forward_substitutions = 0;
  unsigned int back_substitutions = 0;
  unsigned int preconditioners = 0;   ///< set up for an iterative solver of linear systems
  unsigned int linear_iterations = 0; ///< of that solver
  unsigned long bytes_written = 0;

  /// Adds the time until it is destroyed to a phase. The time of a phase within another counts for
  /// the inner one only.
  class Phase {
  public:
    Phase(Work& work, const std::string& name);
    ~Phase();
    Phase(const Phase&) = delete;
    Phase& operator=(const Phase&) = delete;

  private:
    Work& work;
    const std::string name;
    Phase* const outer;
    double inner_seconds = 0;
    dealii::Timer timer;
  };

  void add_seconds(const std::string& phase, double seconds);

  /// Wall seconds by phase, in the order in which the phases were first entered.
  const std::vector<std::pair<std::string, double>>& seconds() const { return phases; }
  double total_seconds() const;

private:
  std::vector<std::pair<std::string, double>> phases;
  Phase* innermost = nullptr; ///< the phase that is going on
};

} // namespace rollwave

#endif
