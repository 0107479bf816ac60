#include "rollwave/contact/load_control.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/falling_zero.h"
#include "rollwave/base/interrupt.h"
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

/// Why a load is out of reach on a mesh: it is too large or too small at @p road, which is the
/// nearest or the farthest from the axle, as @p where says.
std::string out_of_reach_text(const Scene& scene, const std::string& where,
                              const RoadPosition& road, bool is_at_tangent) {
  std::ostringstream text;
  text.precision(6);
  text << "no distance gives this load: the road is " << where << " the axle at the distance "
       << road.distance * scene.units.length << scene.units.after(Quantity::length)
       << ", and the load there is about " << road.load * scene.units.of(Quantity::force)
       << scene.units.after(Quantity::force) << "; ";
  if (is_at_tangent)
    text << "contact reaches the tangent of the drum on this mesh: raise Mesh/Angular cells";
  else if (scene.units.material.is_given())
    text << "Material/Shear modulus may be in another unit than the load";
  else
    text << "without section Material, loads are relative to the shear modulus";
  return text.str();
}

/// The least distance of a node from the road.
double least_gap(const ContactProblem& problem, const ContactSolution& contact) {
  const Vector<double> gaps = problem.gaps(contact.state.displacement);
  return *std::min_element(gaps.begin(), gaps.end());
}

/// The load falls as the distance grows, by a jump only where a node passes the tangent of a drum.
std::optional<std::string> missing_load_text(const Scene& scene, double load, bool is_at_tangent) {
  constexpr double tolerance = 1e-9;
  const double wanted = scene.load->value, force = scene.units.of(Quantity::force);
  if (std::abs(load - wanted) <= tolerance * wanted)
    return {};
  std::ostringstream text;
  text << "the load is " << std::setprecision(12) << load * force << ", wanted " << wanted * force
       << std::setprecision(3) << " (relative difference " << std::abs(load / wanted - 1) << "): "
       << (is_at_tangent ? "it jumps where a node passes the tangent of the drum; raise "
                           "Mesh/Angular cells"
                         : "the next distance in double precision is no better; change Road/Load, "
                           "or prescribe Road/Distance");
  return text.str();
}

/// The change of the contact state for each unit of length by which the road comes nearer while the
/// same nodes stay in contact: they follow it, du_i = -dphi/dc.
ContactState rate_of_approach(const ContactEquations& equations, const ContactProblem& problem,
                              const ContactSolution& solution, RunStatistics& statistics) {
  Vector<double> displacement(problem.size());
  for (unsigned int i = 0; i < problem.size(); ++i)
    if (solution.active[i])
      displacement(i) = -problem.road.distance_derivative(problem.x[i]);
  return equations.derivative(solution.active, displacement, statistics);
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

/// -d/dc of the loads while the same nodes stay in contact. d^2 phi/dc^2 enters that of G.
Loads fixed_set_stiffness(const ContactProblem& problem, const ContactSolution& solution,
                          const ContactState& rate) {
  Loads stiffness = loads_of(problem, rate.force);
  for (unsigned int i = 0; i < problem.size(); ++i)
    *stiffness.work_conjugate -=
        solution.state.force(i) * problem.road.second_distance_derivative(problem.x[i]);
  return stiffness;
}

} // namespace

bool reaches_tangent(const ContactBoundary& boundary, const Road& road,
                     const std::vector<bool>& active) {
  if (!road.is_convex()) // others have no tangent
    return false;
  const auto& surface = boundary.space().surface_nodes();
  const unsigned int n = surface.size();
  for (unsigned int i = 0; i < active.size(); ++i)
    for (const unsigned int step : {1u, n - 1}) {
      const unsigned int neighbour = (boundary.first_surface_node() + i + step) % n;
      if (active[i] &&
          std::abs(from_lowest_point(surface[neighbour].angle)) >= road.tangent_angle())
        return true;
    }
  return false;
}

std::optional<Loads> contact_stiffness(const ContactEquations& equations,
                                       const ContactBoundary& boundary, const Scene& scene,
                                       const ContactProblem& problem,
                                       const ContactSolution& solution, unsigned int most_steps,
                                       RunStatistics& statistics) {
  if (reaches_tangent(boundary, problem.road, solution.active))
    return {};
  const ContactState rate = rate_of_approach(equations, problem, solution, statistics);
  const Loads fixed = fixed_set_stiffness(problem, solution, rate);
  if (!(fixed.total > 0))
    return fixed;
  // The pattern of nodes at the ends repeats with each cell. Two cells average over it.
  constexpr double n_cells = 2;
  const double c = scene.road.distance;
  const unsigned int degree = boundary.space().dof_handler().get_fe().degree;
  const double step =
      std::min({approach_of_growth(problem, solution, rate, degree, n_cells) / 2,
                loads_of(problem, solution.state.force).total / fixed.total / 2, c / 2});
  if (!(step > 1e-10 * c))
    return fixed;
  const auto loads_at = [&](double distance) {
    const ContactProblem moved = make_contact_problem(boundary, with_distance(scene, distance));
    const ContactSolution contact = active_set(equations, moved, most_steps,
                                               problem.pressures(solution.state.force), statistics);
    return loads_of(moved, contact.state.force);
  };
  const Loads near = loads_at(c - step), far = loads_at(c + step);
  return Loads{(near.total - far.total) / (2 * step), (near.vertical - far.vertical) / (2 * step),
               (*near.work_conjugate - *far.work_conjugate) / (2 * step)};
}

RoadPosition find_distance(const ContactEquations& equations, const ContactBoundary& boundary,
                           const Scene& scene, unsigned int most_steps, const Vector<double>& start,
                           RunStatistics& statistics) {
  constexpr double tolerance = 1e-10;
  const auto [wanted, kind] = *scene.load;
  RoadPosition road = {scene.road.distance, 0, start};
  ContactProblem problem;
  ContactSolution contact;
  // The load above the wanted one. Without contact the least gap counts as a negative load, so that
  // the search sees how far away contact is.
  const auto excess_at = [&, wanted = wanted, kind = kind](double distance) {
    if (is_interrupted(boundary.space().communicator()))
      throw Interrupted("interrupted in the search for the distance");
    problem = make_contact_problem(boundary, with_distance(scene, distance));
    contact = active_set(equations, problem, most_steps, road.pressure, statistics);
    road.distance = distance;
    road.pressure = problem.pressures(contact.state.force);
    road.load = loads_of(problem, contact.state.force).of(kind);
    road.history.push_back(
        {distance, road.load, static_cast<unsigned int>(contact.history.size())});
    const double gap = road.load == 0 ? least_gap(problem, contact) : 0;
    const double excess = road.load - wanted - gap;
    return std::abs(excess) <= tolerance * wanted ? 0 : excess;
  };
  const double at_start = excess_at(road.distance);
  const double stiffness =
      loads_of(problem, rate_of_approach(equations, problem, contact, statistics).force).of(kind);
  // Twice the step of Newton's method, to the other side of the zero.
  const double first_step = 2 * std::abs(at_start) / (stiffness > 0 ? stiffness : 1);
  const ArgumentRange range = {scene.least_distance, scene.road.greatest_distance()};
  falling_zero(excess_at, road.distance, at_start, first_step, range, 4e-16);

  if (std::abs(road.load - wanted) <= tolerance * wanted)
    return road;
  const bool is_at_tangent = reaches_tangent(boundary, problem.road, contact.active);
  if (road.load < wanted && road.distance == range.least)
    road.refusal = out_of_reach_text(scene, "nearest to", road, is_at_tangent);
  else if (road.load > wanted && road.distance == range.greatest)
    road.refusal = out_of_reach_text(scene, "farthest from", road, is_at_tangent);
  else // both sides are neighbouring numbers
    road.shortfall = missing_load_text(scene, road.load, is_at_tangent);
  return road;
}

} // namespace rollwave
