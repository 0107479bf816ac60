#include "certificate.h"

#include "angular_bubbles.h"
#include "bound_integrals.h"
#include "certificate_parts.h"
#include "edge_pressure.h"
#include "mesh_system.h"
#include "scene.h"
#include "work.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rollwave {

using namespace dealii;

Certificate certify(const RingSpace& space, const Scene& scene, const ContactProblem& problem,
                    const ContactSolution& contact, const FieldVector& field, MeshSystem& system,
                    Work& work) {
  const Work::Phase phase(work, "certificate");
  prepare_certificate(space, scene, system.stiffness.kind, system, work);
  DualParts& dual = *system.dual;
  const bool is_uneven = dual.has_uneven_force();

  const FieldVector displacement = project_contact_nodes(space, problem, contact.active, field);
  const FeasibleTrace trace(space, scene, displacement, contact.active);
  const auto pressures = edge_pressures(space, scene, contact);
  const AffineConstraints<double> constraints =
      potential_constraints(space, scene, pressures, dual.jumps);
  const FieldVector potential = system.potential->solve(
      dual.shapes, constraints, is_uneven ? &dual.of_force->to_potential : nullptr, work);
  if (!system.is_kept)
    system.potential.reset();
  if (!system.bubbles)
    system.bubbles.emplace(space, dual.shapes);
  const AngularBubbles bubbles(space, scene, dual.shapes, potential, pressures,
                               is_uneven ? &dual.of_force->to_bubbles : nullptr, *system.bubbles);
  if (!system.is_kept)
    system.bubbles.reset();
  BoundIntegrals integrals =
      integrate_bound(space, scene, displacement, trace, pressures, potential, bubbles, dual);

  double work_of_projection = 0; // on the contact nodes
  if (system.load) {
    FieldVector projection = displacement;
    projection -= field;
    work_of_projection = projection * *system.load;
  }

  const double of_flux = std::sqrt(std::max(integrals.bound_squared, 0.));
  double epsilon = 0, missed = 0;
  if (is_uneven) {
    epsilon = dual.interpolant->error();
    missed = dual.of_force->missed;
  }
  if (!system.is_kept)
    system.dual.reset();
  const double eta = of_flux + missed;
  const double energy_norm = epsilon + eta;
  const double norm_squared = integrals.norm_squared;
  const double energy = norm_squared / 2 - integrals.work_of_force;
  // Heights and moments are differences of radii.
  const double cancellation = scene.outer_radius / (scene.outer_radius - scene.inner_radius);
  const double round_off =
      1e-15 * cancellation * (norm_squared + std::abs(integrals.work_of_force));
  const double energy_error = (epsilon + missed) * std::sqrt(norm_squared) + round_off;
  const double smallest_norm = std::sqrt(norm_squared) - energy_norm;
  double relative = std::numeric_limits<double>::infinity();
  if (smallest_norm > 0)
    relative = energy_norm / smallest_norm;
  else if (energy_norm == 0)
    relative = 0;
  return {{energy_norm, relative, energy - energy_error - eta * eta / 2 - epsilon * energy_norm,
           energy + energy_error, norm_squared},
          std::move(integrals.cell_bounds),
          trace,
          energy,
          integrals.work_of_rest + work_of_projection};
}

} // namespace rollwave
