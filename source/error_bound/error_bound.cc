#include "rollwave/error_bound/error_bound.h"

#include "rollwave/error_bound/certificate_integrals.h"
#include "rollwave/error_bound/dual_system.h"
#include "rollwave/scene/scene.h"

#include <boost/math/tools/roots.hpp>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace rollwave {

using dealii::numbers::PI;

namespace {

/// The intervals of both loads.
/// @param delta of the force, finite
LoadBounds bound_loads(const Scene& scene, const LoadFunctions& w,
                       const CertificateIntegrals& integrals, double delta, double round_off) {
  const double squared = integrals.bound_squared + integrals.gap_work;
  const double radius = std::sqrt(std::max(squared, 0.)) / 2 + 2 * delta;
  const double size = std::sqrt(integrals.norm_squared);
  LoadBounds loads = {bound_load(w[0], integrals.loads[0], radius, size, round_off),
                      bound_load(w[1], integrals.loads[1], radius, size, round_off)};
  loads.total.lower = std::max(loads.total.lower, 0.);
  const auto is_below_axle = [](double z) { return std::abs(from_lowest_point(z)) <= PI / 2; };
  if (is_below_axle(scene.zone_begin) && is_below_axle(scene.zone_end))
    loads.vertical.lower = std::max(loads.vertical.lower, 0.);
  return loads;
}

/// The bounds that eta, delta and the integrals of v give.
CertifiedError bound_error(const Scene& scene, const LoadFunctions& w,
                           const CertificateIntegrals& integrals, const ForceIntegral* force) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CertifiedError error = {};
  error.eta = std::sqrt(std::max(double(integrals.bound_squared), 0.));
  error.force_data = force ? force->error() : 0;
  if (force)
    error.sampled_width = force->scan_width();
  error.norm_squared = integrals.norm_squared;
  error.energy_norm = error.relative = error.upper_bound = infinity;
  error.lower_bound = -infinity;
  error.loads = {{0, infinity}, {-infinity, infinity}};
  const double delta = error.force_data;
  if (!std::isfinite(delta))
    return error;
  const double error_of_v = error.eta + delta, norm = std::sqrt(error.norm_squared);
  error.energy_norm =
      bound_of_discrete(error.eta, std::sqrt(double(integrals.discrete_squared)),
                        integrals.gap_work / 2, std::sqrt(double(integrals.moved_squared))) +
      delta;
  // A lower bound of |u|. Below 1e-9 of the error bound it is round-off.
  const double smallest_norm = norm - error_of_v;
  if (error.energy_norm == 0)
    error.relative = 0;
  else if (smallest_norm > 1e-9 * error.energy_norm)
    error.relative = error.energy_norm / smallest_norm;
  // The heights of cells and Q_h are differences of radii, which cancel in a thin ring.
  const double cancellation = scene.outer_radius / (scene.outer_radius - scene.inner_radius);
  const double round_off = 1e-15 * cancellation;
  const double work_of_force = integrals.work_of_force;
  const double energy = error.norm_squared / 2 - work_of_force;
  const double energy_error =
      delta * norm + round_off * (error.norm_squared + std::abs(work_of_force));
  error.lower_bound = energy - energy_error - error.eta * error.eta / 2 - delta * error_of_v;
  error.upper_bound = energy + energy_error;
  error.loads = bound_loads(scene, w, integrals, delta, 10 * round_off);
  return error;
}

} // namespace

double bound_of_discrete(double eta, double eta_0, double gap_work, double moved) {
  // x = eta cos(t), y = eta sin(t): the first bound falls with t, the second one grows.
  const auto difference = [=](double t) {
    const double by_fluxes =
        eta_0 / 2 + std::sqrt(eta_0 * eta_0 / 4 + gap_work + eta * std::sin(t) * moved);
    return eta * std::cos(t) + moved - by_fluxes;
  };
  const double at_begin = difference(0), at_end = difference(PI / 2);
  if (!(at_begin > 0))
    return eta + moved;
  if (!(at_end < 0))
    return eta_0 / 2 + std::sqrt(eta_0 * eta_0 / 4 + gap_work + eta * moved);
  std::uintmax_t most_evaluations = 100;
  const auto [low, high] = boost::math::tools::toms748_solve(
      difference, 0., PI / 2, at_begin, at_end, boost::math::tools::eps_tolerance<double>(40),
      most_evaluations);
  return eta * std::cos(low) + moved;
}

Certificate certify(const SolvedContact& solved, const FieldVector& field,
                    const ForceIntegral* force, const DualSystem& dual, RunStatistics& statistics) {
  const auto& [scene, boundary, problem, contact] = solved;
  const AdmissibleRoad road = admissible_road(boundary, scene);
  const FieldVector displacement = project_contact_nodes(boundary, road, contact.active, field);
  const AdmissibleTrace trace(boundary, scene, road, displacement, contact.active);
  const auto pressures = admissible_pressures(boundary, scene, contact);
  const FieldVector psi = dual.stress_function(scene, pressures, force, statistics);
  const LoadFunctions w = load_functions(scene);
  std::vector<double> cell_bounds;
  const CertificateIntegrals integrals = integrate_certificate(
      boundary.space(), scene, {field, displacement, trace, pressures, psi, force, w},
      dual.shapes(), cell_bounds);
  return {bound_error(scene, w, integrals, force), std::move(cell_bounds), trace,
          double(integrals.work_of_force)};
}

} // namespace rollwave
