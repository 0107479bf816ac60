#pragma once

#include "rollwave/base/note.h"
#include "rollwave/mesh/contact_boundary.h"
#include "rollwave/scene/loads.h"
#include "rollwave/scene/road.h"
#include "rollwave/scene/scene.h"
#include "rollwave/solver/contact_equations.h"

#include <deal.II/lac/vector.h>

#include <functional>
#include <optional>
#include <vector>

namespace rollwave {

class RunStatistics;

enum class ContactMethod {
  /// "active set": primal-dual active set (semismooth Newton); needs no step length.
  active_set,
  /// "uzawa": projected gradient steps on the pressure, the method of Ross and Bercovier.
  uzawa
};

enum class UzawaStop {
  /// "gap": ||change of the pressure|| / rho, the violation of the contact conditions as a
  /// displacement.
  gap,
  /// "change": ||u_new - u||, the rule behind the paper's figure 9. The violation has to be at most
  /// the square root of the tolerance as well, since short steps change u by little.
  change
};

/// Section `Contact`.
struct ContactOptions {
  ContactMethod method = ContactMethod::active_set;
  std::optional<double> rho; ///< nullopt: from an estimate of the largest compliance
  UzawaStop stop = UzawaStop::gap;
  double tolerance = 1e-8;
  unsigned int most_steps = 20000;
};

/**
 * The discrete contact conditions, for every contact node i:
 *
 *     u_i <= phi_i,   N_i >= 0,   N_i (phi_i - u_i) = 0,   pressure lambda_i = N_i / weight_i.
 */
struct ContactProblem {
  dealii::Vector<double> phi;     ///< phi_i, a length
  dealii::Vector<double> weight;  ///< the nodes' areas, see SurfaceNode
  std::vector<double> x;          ///< the nodes' angles from the lowest point
  std::vector<double> cell_ratio; ///< see SurfaceNode
  Road road;
  double unit = 1; ///< the scene's unit of displacement over pressure, in the user's units

  unsigned int size() const { return phi.size(); }

  /// phi_i - u_i
  dealii::Vector<double> gaps(const dealii::Vector<double>& displacement) const;

  /// lambda_i = N_i / weight_i, and N_i = weight_i lambda_i.
  dealii::Vector<double> pressures(const dealii::Vector<double>& force) const;
  dealii::Vector<double> forces(const dealii::Vector<double>& pressure) const;
};

/// The loads of nodal forces by the rule [.,.]_h.
Loads loads_of(const ContactProblem& problem, const dealii::Vector<double>& force);

/// The largest admissible residuals of a solved scene, relative to its data.
constexpr double wanted_residual = 1e-10;

/// The contact conditions at the nodes of the @p boundary of a scene.
ContactProblem make_contact_problem(const ContactBoundary& boundary, const Scene& scene);

/// One line of the history of a contact iteration.
struct ContactStep {
  unsigned int active;    ///< nodes in contact
  unsigned int changed;   ///< nodes that entered or left contact after this step
  double penetration;     ///< max (u_i - phi_i, 0), a length
  double lowest_pressure; ///< min (lambda_i, 0)
  /// The number that Uzawa's stopping rule compares with the tolerance; nullopt for the active set.
  std::optional<double> residual = {};
};

/// The step length of Uzawa's method and its limits, pressures over displacements.
struct StepLength {
  double rho;                    ///< in use
  double safe;                   ///< the method converges from any start with less
  std::optional<double> largest; ///< the method diverges with more; nullopt without contact
};

/// Called after each step of a contact iteration with all steps so far.
using ContactObserver = std::function<void(const std::vector<ContactStep>& history)>;

/// The state that a contact method has found, with its steps.
struct ContactSolution {
  ContactState state;
  std::vector<bool> active;
  std::vector<ContactStep> history;
  double gap_accuracy = 0; ///< how far nodes in contact may be from the road, a length
  std::vector<Note> notes = {};
  std::optional<StepLength> step_length = {}; ///< of Uzawa's method
};

/// The contact of a scene on one mesh.
struct SolvedContact {
  Scene scene; ///< with the distance, and the shear modulus, that a given load or nip needs
  ContactBoundary boundary; ///< of the scene's zone
  ContactProblem problem = {};
  ContactSolution contact = {};
};

/// Solves by the method of @p options, beginning with the contact pressures @p start (none when
/// it has no entries). @throws NotSolved as the methods do.
ContactSolution solve_contact(const ContactEquations& equations, const ContactProblem& problem,
                              const ContactOptions& options, const dealii::Vector<double>& start,
                              RunStatistics& statistics, const ContactObserver& step_ended = {});

} // namespace rollwave
