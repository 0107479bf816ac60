#include "rollwave/error_bound/error_bound.h"

#include "rollwave/base/work.h"
#include "rollwave/error_bound/admissible_pressure.h"
#include "rollwave/error_bound/angular_enrichment.h"
#include "rollwave/error_bound/constitutive_error.h"
#include "rollwave/error_bound/stress_function.h"
#include "rollwave/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// The bounds that eta, delta and the integrals of v give.
CertifiedError bound_error(const Scene& scene, const ConstitutiveError& integrals,
                           const ForceIntegral* force) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double delta = force ? force->error() : 0, sampled_width = force ? force->scan_width() : 0;
  const double eta = std::sqrt(std::max(integrals.bound_squared, 0.));
  const double norm_squared = integrals.norm_squared;
  if (!std::isfinite(delta))
    return {infinity, delta, infinity, -infinity, infinity, norm_squared, sampled_width};
  const double energy_norm = eta + delta;
  const double energy = norm_squared / 2 - integrals.work_of_force;
  // Heights and moments are differences of radii.
  const double cancellation = scene.outer_radius / (scene.outer_radius - scene.inner_radius);
  const double round_off =
      1e-15 * cancellation * (norm_squared + std::abs(integrals.work_of_force));
  const double energy_error = delta * std::sqrt(norm_squared) + round_off;
  // Of u; what is less than this share of the bound may be rounding.
  const double smallest_norm = std::sqrt(norm_squared) - energy_norm;
  const bool has_digits = smallest_norm > 1e-9 * energy_norm;
  return {energy_norm,
          delta,
          energy_norm == 0 ? 0
          : has_digits     ? energy_norm / smallest_norm
                           : infinity,
          energy - energy_error - eta * eta / 2 - delta * energy_norm,
          energy + energy_error,
          norm_squared,
          sampled_width};
}

} // namespace

Certificate certify(const RingSpace& space, const Scene& scene, const ContactProblem& problem,
                    const ContactSolution& contact, const FieldVector& field,
                    const ForceIntegral* force, const std::optional<FieldVector>& load,
                    StressFunction& stress_function, Work& work) {
  const Work::Phase phase(work, "certificate");
  const FieldVector displacement = project_contact_nodes(space, problem, contact.active, field);
  const AdmissibleTrace trace(space, scene, displacement, contact.active);
  const auto pressures = admissible_pressures(space, scene, contact);
  const ForceIntegral* const uneven = force && !force->is_number() ? force : nullptr;
  const FieldVector potential = stress_function.solve(scene, pressures, uneven, work);
  RadialShapesOfMesh& shapes = stress_function.shapes();
  const AngularEnrichment bubbles(space, scene, shapes, potential, pressures, uneven);
  ConstitutiveError integrals = integrate_constitutive_error(
      space, scene, {displacement, trace, pressures, potential, bubbles, force}, shapes);
  double work_of_projection = 0; // on the contact nodes
  if (load) {
    FieldVector projection = displacement;
    projection -= field;
    work_of_projection = projection * *load;
  }
  const CertifiedError error = bound_error(scene, integrals, force);
  return {error, std::move(integrals.cell_bounds), trace,
          integrals.work_of_correction + work_of_projection};
}

} // namespace rollwave
