#include "rollwave/contact/load_control.h"

#include "rollwave/base/errors.h"
#include "rollwave/contact/active_set.h"
#include "rollwave/scene/scene.h"
#include "rollwave/scene/units.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

/// @param load at the nearest or farthest @p distance
[[noreturn]] void refuse_load(const Scene& scene, const std::string& where, double distance,
                              double load) {
  std::ostringstream text;
  text.precision(6);
  text << "no distance gives this load: the road is " << where << " the axle at the distance "
       << distance * scene.units.length << scene.units.after(Quantity::length)
       << ", and the load there is about " << load * scene.units.of(Quantity::force)
       << scene.units.after(Quantity::force)
       << (scene.units.material.is_given() ? "; Material/Shear modulus may be in another unit" : "");
  throw BadValue("Road", "Load", text.str());
}

/// The distances between which the wanted one lies. The load falls as the distance grows.
struct Bracket {
  double near, far;
  bool is_near_tried = false, is_far_tried = false;

  explicit Bracket(const Scene& scene)
      : near(scene.least_distance), far(scene.road.greatest_distance()) {}

  /// @param excess of the load at a distance over the wanted one
  void narrow(double distance, double excess) {
    (excess > 0 ? near : far) = distance;
    (excess > 0 ? is_near_tried : is_far_tried) = true;
  }

  bool is_narrow(double tolerance) const {
    return is_near_tried && is_far_tried && far - near <= tolerance * near;
  }

  /// The distance to try next: that of Newton's method if it lies within the bracket. Otherwise an
  /// end that has not been tried, so that a load out of reach is found at once, or the middle.
  /// @param newton nullopt without contact, where the stiffness is 0
  double next(std::optional<double> newton) const {
    if (newton && near < *newton && *newton < far)
      return *newton;
    if (!is_near_tried && !(newton && *newton >= far))
      return near;
    if (!is_far_tried && std::isfinite(far))
      return far;
    return std::isfinite(far) ? near + (far - near) / 2 : 2 * near;
  }
};

/// The change of the contact state for each unit of length by which the road comes nearer while the
/// same nodes stay in contact: they follow it, du_i = -dphi/dc.
ContactState rate_of_approach(ContactLinearSolver& solver, const ContactProblem& problem,
                              const ContactSolution& solution) {
  Vector<double> displacement(problem.size());
  for (unsigned int i = 0; i < problem.size(); ++i)
    if (solution.active[i])
      displacement(i) = -problem.road.distance_derivative(problem.x[i]);
  return solver.derivative(solution.active, displacement, final_accuracy);
}

/// How much nearer the road comes while contact grows by about @p n_cells cells at an end, the
/// largest of all ends. A node at the end entered contact force / force rate ago, and its neighbour
/// outside follows after gap / gap rate.
double approach_of_growth(const ContactProblem& problem, const ContactSolution& solution,
                          const ContactState& rate, unsigned int degree, double n_cells) {
  const int n = problem.size(), p = degree;
  double approach = 0;
  for (int i = 0; i < n; ++i)
    for (const int out : {-1, 1}) {
      const int j = i + out;
      if (!solution.active[i] || j < 0 || j >= n || solution.active[j])
        continue;
      const double gap = problem.phi(j) - solution.state.displacement(j);
      const double gap_rate = problem.road.distance_derivative(problem.x[j]) + rate.displacement(j);
      if (!(rate.force(i) > 0 && gap_rate > 0))
        continue;
      const double of_node = solution.state.force(i) / rate.force(i) + gap / gap_rate;
      const double cell = std::abs(problem.x[std::clamp(i + p * out, 0, n - 1)] - problem.x[i]);
      const double spacing = std::abs(problem.x[j] - problem.x[std::clamp(i - out, 0, n - 1)]) / 2;
      approach = std::max(approach, n_cells * of_node * cell / spacing);
    }
  return approach;
}

} // namespace

Loads contact_stiffness(ContactLinearSolver& solver, const ContactBoundary& boundary,
                        const Scene& scene, const ContactProblem& problem,
                        const ContactSolution& solution, unsigned int most_steps) {
  const ContactState rate = rate_of_approach(solver, problem, solution);
  const Loads fixed_set_stiffness =
      loads_of(problem, rate.force); // while the same nodes stay in contact
  if (!(fixed_set_stiffness.total > 0))
    return fixed_set_stiffness;
  // The pattern of nodes at the ends repeats with each cell. Two cells average over it.
  constexpr double n_cells = 2;
  const double c = scene.road.distance;
  const unsigned int degree = boundary.space().dof_handler().get_fe().degree;
  const double step =
      std::min({approach_of_growth(problem, solution, rate, degree, n_cells) / 2,
                loads_of(problem, solution.state.force).total / fixed_set_stiffness.total / 2,
                c - scene.least_distance, scene.road.greatest_distance() - c});
  if (!(step > 1e-10 * c))
    return fixed_set_stiffness;
  const auto loads_at = [&](double distance) {
    const ContactProblem moved = make_contact_problem(boundary, with_distance(scene, distance));
    const ContactSolution contact =
        active_set(solver, moved, most_steps, problem.pressures(solution.state.force));
    return loads_of(moved, contact.state.force);
  };
  const Loads near = loads_at(c - step), far = loads_at(c + step);
  return {(near.total - far.total) / (2 * step), (near.vertical - far.vertical) / (2 * step),
          (near.work_conjugate - far.work_conjugate) / (2 * step)};
}

RoadPosition find_distance(ContactLinearSolver& solver, const ContactBoundary& boundary,
                           const Scene& scene, unsigned int most_steps,
                           const Vector<double>& start) {
  constexpr double tolerance = 1e-10, tolerance_at_tangent = 1e-2;
  constexpr unsigned int most_trials = 100;
  const auto [wanted, kind] = *scene.load;
  Bracket bracket(scene);
  RoadPosition road = {scene.road.distance, 0, start};
  for (unsigned int trial = 0; trial < most_trials; ++trial) {
    const ContactProblem problem =
        make_contact_problem(boundary, with_distance(scene, road.distance));
    const ContactSolution contact = active_set(solver, problem, most_steps, road.pressure);
    road.pressure = problem.pressures(contact.state.force);
    road.load = loads_of(problem, contact.state.force).of(kind);
    road.history.push_back(
        {road.distance, road.load, static_cast<unsigned int>(contact.history.size())});
    const double excess = road.load - wanted;
    if (std::abs(excess) <= tolerance * wanted)
      return road;
    const bool is_resolved =
        kind != LoadKind::work_conjugate || !reaches_tangent(problem, contact.active);
    if (excess < 0 && road.distance == scene.least_distance && is_resolved)
      refuse_load(scene, "nearest to", road.distance, road.load);
    if (excess > 0 && road.distance == scene.road.greatest_distance())
      refuse_load(scene, "farthest from", road.distance, road.load);
    bracket.narrow(road.distance, excess);
    if (bracket.is_narrow(4e-16)) // both ends are neighbouring numbers
      return road;
    // Nearer roads have contact up to the tangent too, so that no mesh like this one does better.
    if (!is_resolved && excess < 0 &&
        (excess > -tolerance_at_tangent * wanted || bracket.is_narrow(tolerance_at_tangent) ||
         road.distance == scene.least_distance))
      return road;
    // The stiffness while the same nodes stay in contact. For the work-conjugate load it leaves
    // out the change of dphi/dc, which is 0 on a flat road.
    const double stiffness =
        loads_of(problem, rate_of_approach(solver, problem, contact).force).of(kind);
    road.distance = bracket.next(stiffness > 0 ? std::optional(road.distance + excess / stiffness)
                                               : std::nullopt);
  }
  std::ostringstream text;
  text << "no distance was found for Road/Load = " << wanted * scene.units.of(Quantity::force)
       << ": after " << most_trials << " trials the distance is between "
       << bracket.near * scene.units.length << " and " << bracket.far * scene.units.length
       << ", and the load reached is " << road.load * scene.units.of(Quantity::force);
  throw NotSolved(text.str());
}

std::optional<std::string> missing_load_text(const Scene& scene, double load) {
  constexpr double tolerance = 1e-9;
  const double wanted = scene.load->value, force = scene.units.of(Quantity::force);
  if (std::abs(load - wanted) <= tolerance * wanted)
    return {};
  std::ostringstream text;
  text << "the load is " << std::setprecision(12) << load * force << ", wanted " << wanted * force
       << std::setprecision(3) << " (relative difference " << std::abs(load / wanted - 1)
       << "): the next distance in double precision is no better; change Road/Load, or prescribe "
          "Road/Distance";
  return text.str();
}

bool reaches_tangent(const ContactProblem& problem, const std::vector<bool>& active) {
  const int n = problem.size();
  const double tangent = problem.road.tangent_angle();
  const auto first = std::find(active.begin(), active.end(), true);
  if (first == active.end() || !problem.road.is_convex()) // others have no tangent
    return false;
  const int left = first - active.begin(),
            right = n - 1 - (std::find(active.rbegin(), active.rend(), true) - active.rbegin());
  const auto& x = problem.x;
  const auto neighbour = [&](int i, int out) { // beyond the zone the spacing goes on
    const int j = i + out;
    return 0 <= j && j < n ? x[j] : n > 1 ? 2 * x[i] - x[i - out] : x[i];
  };
  return neighbour(left, -1) <= -tangent || neighbour(right, 1) >= tangent;
}

} // namespace rollwave
