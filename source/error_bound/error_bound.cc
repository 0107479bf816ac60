#include "rollwave/error_bound/error_bound.h"

#include "rollwave/base/work.h"
#include "rollwave/error_bound/admissible_pressure.h"
#include "rollwave/error_bound/angular_enrichment.h"
#include "rollwave/error_bound/constitutive_error.h"
#include "rollwave/error_bound/dual_problem.h"
#include "rollwave/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rollwave {

using namespace dealii;

Certificate certify(const RingSpace& space, const Scene& scene, const ContactProblem& problem,
                    const ContactSolution& contact, const FieldVector& field,
                    const std::optional<FieldVector>& load, DualProblem& dual, Work& work) {
  const Work::Phase phase(work, "certificate");
  const FieldVector displacement = project_contact_nodes(space, problem, contact.active, field);
  const AdmissibleTrace trace(space, scene, displacement, contact.active);
  const auto pressures = admissible_pressures(space, scene, contact);
  const FieldVector potential =
      dual.potential.solve(dual.shapes, stress_function_constraints(space, scene, pressures),
                           dual.uneven_force(scene), work);
  const AngularEnrichment bubbles(space, scene, dual.shapes, potential, pressures,
                                  dual.uneven_force(scene), dual.bubbles);
  ConstitutiveError integrals = integrate_constitutive_error(space, scene, displacement, trace,
                                                             pressures, potential, bubbles, dual);
  double work_of_projection = 0; // on the contact nodes
  if (load) {
    FieldVector projection = displacement;
    projection -= field;
    work_of_projection = projection * *load;
  }

  const double eta = std::sqrt(std::max(integrals.bound_squared, 0.));
  const double delta = dual.force ? dual.force->error() : 0;
  const double energy_norm = eta + delta;
  const double norm_squared = integrals.norm_squared;
  const double energy = norm_squared / 2 - integrals.work_of_force;
  // Heights and moments are differences of radii.
  const double cancellation = scene.outer_radius / (scene.outer_radius - scene.inner_radius);
  const double round_off =
      1e-15 * cancellation * (norm_squared + std::abs(integrals.work_of_force));
  const double energy_error = delta * std::sqrt(norm_squared) + round_off;
  const double smallest_norm = std::sqrt(norm_squared) - energy_norm;
  double relative = std::numeric_limits<double>::infinity();
  if (smallest_norm > 0)
    relative = energy_norm / smallest_norm;
  else if (energy_norm == 0)
    relative = 0;
  return {{energy_norm, delta, relative,
           energy - energy_error - eta * eta / 2 - delta * energy_norm, energy + energy_error,
           norm_squared},
          std::move(integrals.cell_bounds),
          trace,
          integrals.work_of_correction + work_of_projection};
}

} // namespace rollwave
