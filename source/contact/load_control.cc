#include "rollwave/contact/load_control.h"

#include "rollwave/base/falling_zero.h"
#include "rollwave/contact/active_set.h"
#include "rollwave/contact/contact_patch.h"
#include "rollwave/scene/scene.h"
#include "rollwave/scene/units.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

/// What the distance is searched for: a length of contact or a load, both lengths in a Scene.
struct Target {
  std::string key; ///< "Nip" or "Load"
  double wanted;
  LoadKind kind; ///< of the load
  Quantity quantity;

  bool is_nip() const { return quantity == Quantity::length; }

  double of(const DistanceStep& step) const { return is_nip() ? step.nip : step.load; }
};

Target target_of(const Scene& scene) {
  const LoadKind kind = scene.load ? scene.load->kind : LoadKind::vertical;
  return scene.nip ? Target{"Nip", *scene.nip, kind, Quantity::length}
                   : Target{"Load", scene.load->value, kind, Quantity::force};
}

/// Why load or nip are out of reach on a mesh: they are too large or too small at the last
/// distance, which is the nearest or the farthest from the axle, as @p where says.
std::string out_of_reach_text(const Scene& scene, const Target& target, const std::string& where,
                              const DistanceStep& last, bool is_at_tangent) {
  const Units& units = scene.units;
  const std::string name = target.is_nip() ? "nip" : "load";
  std::ostringstream text;
  text.precision(6);
  text << "no distance gives this " << name << ": the road is " << where << " the axle at the "
       << "distance " << last.distance * units.length << units.after(Quantity::length)
       << ", and the " << name << " there is about " << target.of(last) * units.of(target.quantity)
       << units.after(target.quantity) << "; ";
  if (is_at_tangent)
    text << "contact reaches the tangent of the drum on this mesh: raise Mesh/Angular cells";
  else if (target.is_nip())
    text << "it may be in another unit than the radii";
  else if (units.material.is_given())
    text << "Material/Shear modulus may be in another unit than the load";
  else
    text << "without section Material, loads are relative to the shear modulus";
  return text.str();
}

/// Load and nip fall as the distance grows: the load by a jump only where a node passes the tangent
/// of a drum, the nip where a node enters contact.
std::vector<Note> notes_on_miss(const Scene& scene, const Target& target, const DistanceStep& last,
                                bool is_at_tangent) {
  const double tolerance = target.is_nip() ? 1e-2 : 1e-9, reached = target.of(last),
               unit = scene.units.of(target.quantity);
  if (std::abs(reached - target.wanted) <= tolerance * target.wanted)
    return {};
  std::ostringstream text;
  text << "the " << (target.is_nip() ? "nip" : "load") << " is " << std::setprecision(12)
       << reached * unit << ", wanted " << target.wanted * unit << std::setprecision(3)
       << " (relative difference " << std::abs(reached / target.wanted - 1) << "): ";
  if (is_at_tangent)
    text << "it jumps where a node passes the tangent of the drum; raise Mesh/Angular cells";
  else if (target.is_nip())
    text << "it jumps where a node enters contact; raise Mesh/Angular cells";
  else
    text << "the next distance in double precision is no better; change Road/Load, or prescribe "
            "Road/Distance";
  return {{Note::Kind::shortfall, text.str()}};
}

/// The least distance of a node from the road.
double least_gap(const ContactProblem& problem, const ContactSolution& contact) {
  const Vector<double> gaps = problem.gaps(contact.state.displacement);
  return *std::min_element(gaps.begin(), gaps.end());
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
                                       const SolvedContact& solved, RunStatistics& statistics) {
  const ContactProblem& problem = solved.problem;
  const ContactSolution& solution = solved.contact;
  if (reaches_tangent(solved.boundary, problem.road, solution.active))
    return {};
  const ContactState rate = rate_of_approach(equations, problem, solution, statistics);
  const Loads fixed = fixed_set_stiffness(problem, solution, rate);
  if (!(fixed.total > 0))
    return fixed;
  // The pattern of nodes at the ends repeats with each cell. Two cells average over it.
  constexpr double n_cells = 2;
  const double c = solved.scene.road.distance;
  const unsigned int degree = solved.boundary.space().dof_handler().get_fe().degree;
  const double step =
      std::min({approach_of_growth(problem, solution, rate, degree, n_cells) / 2,
                loads_of(problem, solution.state.force).total / fixed.total / 2, c / 2});
  if (!(step > 1e-10 * c))
    return fixed;
  const auto loads_at = [&](double distance) {
    const ContactProblem moved =
        make_contact_problem(solved.boundary, with_distance(solved.scene, distance));
    constexpr unsigned int no_limit = std::numeric_limits<unsigned int>::max();
    const ContactSolution contact =
        active_set(equations, moved, no_limit, problem.pressures(solution.state.force), statistics);
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
  const Target target = target_of(scene);
  const double wanted = target.wanted;
  RoadPosition road = {scene.road.distance, start};
  ContactProblem problem;
  ContactSolution contact;
  // Load or nip above the wanted one. Without contact the least gap counts as a negative one, so
  // that the search sees how far away contact is.
  const auto excess_at = [&](double distance) {
    const Scene moved = with_distance(scene, distance);
    problem = make_contact_problem(boundary, moved);
    contact = active_set(equations, problem, most_steps, road.pressure, statistics);
    road.distance = distance;
    road.pressure = problem.pressures(contact.state.force);
    const ContactResultants resultants =
        measure_contact(moved, problem, contact, boundary.space().dof_handler().get_fe().degree);
    road.history.push_back({distance, resultants.loads.of(target.kind), resultants.length(),
                            static_cast<unsigned int>(contact.history.size())});
    const double reached = target.of(road.history.back());
    const double excess = reached - wanted - (reached > 0 ? 0 : least_gap(problem, contact));
    return std::abs(excess) <= tolerance * wanted ? 0 : excess;
  };
  const double at_start = excess_at(road.distance);
  const ArgumentRange range = {scene.least_distance, scene.road.greatest_distance()};
  const auto first_step = [&] {
    if (target.is_nip()) { // four times the one by which a chord would change its depth
      const double nip = road.history.back().nip;
      return std::abs(nip * nip - wanted * wanted) / 2 *
             (1 / scene.outer_radius + std::max(scene.road.curvature, 0.));
    }
    const ContactState rate = rate_of_approach(equations, problem, contact, statistics);
    const double stiffness = loads_of(problem, rate.force).of(target.kind);
    return 2 * std::abs(at_start) /
           (stiffness > 0 ? stiffness : 1); // twice that of Newton's method
  };
  falling_zero(excess_at, road.distance, at_start, first_step(), range, 4e-16);

  const DistanceStep& last = road.history.back();
  const double reached = target.of(last);
  if (std::abs(reached - wanted) <= tolerance * wanted)
    return road;
  const bool is_at_tangent = reaches_tangent(boundary, problem.road, contact.active);
  if (reached < wanted && road.distance == range.least)
    road.refusal = out_of_reach_text(scene, target, "nearest to", last, is_at_tangent);
  else if (reached > wanted && road.distance == range.greatest)
    road.refusal = out_of_reach_text(scene, target, "farthest from", last, is_at_tangent);
  else // both sides are neighbouring numbers
    road.notes = notes_on_miss(scene, target, last, is_at_tangent);
  return road;
}

} // namespace rollwave
