#include "rollwave/contact/load_control.h"

#include "rollwave/base/errors.h"
#include "rollwave/contact/active_set.h"
#include "rollwave/scene/scene.h"
#include "rollwave/scene/units.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

[[noreturn]] void refuse_load(const Scene& scene, double largest) {
  std::ostringstream text;
  text.precision(6);
  text << "no distance gives this load: where the road is nearest to the axle, at "
       << scene.least_distance * scene.units.length << ", it is about "
       << largest * scene.units.of(Quantity::force);
  throw BadValue("Road", "Load", text.str());
}

/// Distances between which the wanted one lies.
struct Bracket {
  double near, far;
  bool is_near_tried = false, is_far_tried = false;

  explicit Bracket(const Scene& scene)
      : near(scene.least_distance), // the inside of a drum ends where its axis is the axle's
        far(scene.road_curvature < 0 ? -1 / scene.road_curvature
                                     : std::numeric_limits<double>::infinity()) {}

  /// @param excess of the load at a distance over the wanted one
  void narrow(double distance, double excess) {
    (excess > 0 ? near : far) = distance;
    (excess > 0 ? is_near_tried : is_far_tried) = true;
  }

  /// Whether both ends are neighbouring numbers, between which the load changes by more than the
  /// tolerance.
  bool is_exhausted() const { return is_far_tried && far - near <= 4e-16 * near; }

  /// The distance to try next: that of Newton's method, @p newton, unless it leads out of the
  /// bracket or is not a number.
  double next(double newton) const {
    if (near < newton && newton < far)
      return newton;
    if (!is_near_tried && !std::isnan(newton))
      return near;
    return std::isfinite(far) ? (near + far) / 2 : 2 * near;
  }
};

} // namespace

Loads contact_stiffness(ContactLinearSolver& solver, const ContactProblem& problem,
                        const ContactSolution& solution) {
  Vector<double> moved(problem.size());
  for (unsigned int i = 0; i < problem.size(); ++i)
    if (solution.active[i])
      moved(i) = problem.shape.distance_derivative(problem.x[i]);
  Vector<double> change = solver.force_change(solution.active, moved, final_accuracy);
  change *= -1;
  Loads stiffness = loads_of(problem, change);
  for (unsigned int i = 0; i < problem.size(); ++i)
    stiffness.work_conjugate -=
        solution.state.force(i) * problem.shape.second_distance_derivative(problem.x[i]);
  return stiffness;
}

RoadPosition find_distance(ContactLinearSolver& solver, const RingSpace& space, const Scene& scene,
                           unsigned int most_steps, const Vector<double>& start) {
  constexpr double tolerance = 1e-10;
  constexpr unsigned int most_trials = 100;
  const auto [wanted, kind] = *scene.load;
  Bracket bracket(scene);
  RoadPosition road = {scene.road_distance, start};
  for (unsigned int trial = 0; trial < most_trials; ++trial) {
    const ContactProblem problem = make_contact_problem(space, with_distance(scene, road.distance));
    const ContactSolution contact = active_set(solver, problem, most_steps, road.pressure);
    road.pressure = problem.pressures(contact.state.force);
    const double excess = loads_of(problem, contact.state.force).of(kind) - wanted;
    if (std::abs(excess) <= tolerance * wanted)
      return road;
    if (excess < 0 && road.distance == scene.least_distance)
      refuse_load(scene, wanted + excess);
    bracket.narrow(road.distance, excess);
    if (bracket.is_exhausted())
      return road;
    const double stiffness = contact_stiffness(solver, problem, contact).of(kind);
    road.distance = bracket.next(stiffness > 0 ? road.distance + excess / stiffness
                                               : std::numeric_limits<double>::quiet_NaN());
  }
  std::ostringstream text;
  text << "no distance was found for Road/Load = " << wanted * scene.units.of(Quantity::force)
       << ": after " << most_trials << " trials it is between " << bracket.near * scene.units.length
       << " and " << bracket.far * scene.units.length;
  throw NotSolved(text.str());
}

} // namespace rollwave
