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

} // namespace

Loads contact_stiffness(ContactLinearSolver& solver, const ContactProblem& problem,
                        const ContactSolution& solution) {
  ContactState moved = solution.state;
  moved.force = 0;
  for (unsigned int i = 0; i < problem.size(); ++i)
    if (solution.active[i])
      moved.displacement(i) = solution.state.displacement(i) + problem.shape.lift(problem.x[i]);
  solver.solve(solution.active, moved, final_accuracy);
  Vector<double> change = solution.state.force;
  change -= moved.force;
  for (unsigned int i = 0; i < problem.size(); ++i)
    if (!solution.active[i])
      change(i) = 0;
  Loads stiffness = loads_of(problem, change);
  for (unsigned int i = 0; i < problem.size(); ++i)
    stiffness.work_conjugate -= solution.state.force(i) * problem.shape.lift_slope(problem.x[i]);
  return stiffness;
}

RoadPosition find_distance(ContactLinearSolver& solver, const RingSpace& space, const Scene& scene,
                           unsigned int most_steps, const Vector<double>& start) {
  constexpr double tolerance = 1e-10;
  constexpr unsigned int most_trials = 100;
  const auto [wanted, kind] = *scene.load;
  double near = scene.least_distance; // the inside of a drum ends where its axis is the axle's
  double far = scene.road_curvature < 0 ? -1 / scene.road_curvature
                                        : std::numeric_limits<double>::infinity();
  bool is_near_tried = false, is_far_tried = false;
  RoadPosition road = {scene.road_distance, start};
  for (unsigned int trial = 0; trial < most_trials; ++trial) {
    const ContactProblem problem = make_contact_problem(space, with_distance(scene, road.distance));
    const ContactSolution contact = active_set(solver, problem, most_steps, road.pressure);
    const double load = loads_of(problem, contact.state.force).of(kind);
    road.pressure = contact.state.force;
    for (unsigned int i = 0; i < problem.size(); ++i)
      road.pressure(i) /= problem.weight(i);
    if (std::abs(load - wanted) <= tolerance * wanted)
      return road;
    if (load > wanted) {
      near = road.distance;
      is_near_tried = true;
    } else if (road.distance == scene.least_distance)
      refuse_load(scene, load);
    else {
      far = road.distance;
      is_far_tried = true;
    }
    if (is_far_tried && far - near <= 4e-16 * near)
      return road; // between neighbouring numbers the load changes by more than the tolerance

    const double stiffness = load > 0 ? contact_stiffness(solver, problem, contact).of(kind) : 0;
    const double newton = stiffness > 0 ? road.distance + (load - wanted) / stiffness : near;
    if (near < newton && newton < far)
      road.distance = newton;
    else if (!is_near_tried && stiffness > 0)
      road.distance = near;
    else
      road.distance = std::isfinite(far) ? (near + far) / 2 : 2 * near;
  }
  std::ostringstream text;
  text << "no distance was found for Road/Load = " << wanted * scene.units.of(Quantity::force)
       << ": after " << most_trials << " trials it is between " << near * scene.units.length
       << " and " << far * scene.units.length;
  throw NotSolved(text.str());
}

} // namespace rollwave
