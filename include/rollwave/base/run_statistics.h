#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rollwave {

/// Counts of the work of a run and the seconds of its phases.
class RunStatistics {
public:
  /// Called at the end of each phase with the seconds since it was entered, without inner phases.
  using Observer = std::function<void(const std::string& phase, double seconds)>;

  RunStatistics(Observer observer = {}) : observer(std::move(observer)) {}

  unsigned int load_assemblies = 0;
  unsigned int stiffness_assemblies = 0;
  unsigned int orderings = 0;            ///< symbolic analyses of sparse matrices
  unsigned int factorisations = 0;       ///< of sparse matrices
  unsigned int dense_factorisations = 0; ///< of parts of the Schur complement on the contact nodes
  unsigned int sparse_solves = 0;        ///< with a factor of a sparse matrix
  unsigned long bytes_written = 0;

  /// The names of all phases, in the order in which they follow each other.
  static const std::vector<std::string>& phase_names();

  /// Adds the time until it is destroyed to a phase. The time of a phase within another counts for
  /// the inner one only.
  class Phase {
  public:
    /// @param name one of phase_names(). @throws std::out_of_range for another
    Phase(RunStatistics& statistics, const std::string& name);
    ~Phase();
    Phase(const Phase&) = delete;
    Phase& operator=(const Phase&) = delete;

  private:
    RunStatistics& statistics;
    const std::string name;
    Phase* const outer;
    double inner_seconds = 0;
    const std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  };

  /// Wall seconds of a phase; nullopt if it has not been entered.
  std::optional<double> seconds(const std::string& phase) const;
  double total_seconds() const;

private:
  Observer observer;
  std::map<std::string, double> seconds_of; ///< phases that have been entered
  Phase* innermost = nullptr;               ///< the phase that is going on
};

/// Wall seconds since this process has started, with the loading of its libraries, which takes
/// longer than a small scene; 0 if /proc is missing.
double seconds_of_process();

} // namespace rollwave
