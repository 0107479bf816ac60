#include "rollwave/run/measure.h"

#include "rollwave/mesh/contact_boundary.h"

#include <deal.II/grid/tria.h>

namespace rollwave {

using namespace dealii;

namespace {

MeshFigures describe_mesh(const ContactBoundary& boundary) {
  const RingSpace& space = boundary.space();
  const auto& handler = space.dof_handler();
  const auto [least_diameter, largest_diameter] = space.diameters();
  return {handler.get_fe().degree,
          static_cast<unsigned int>(handler.get_triangulation().n_global_active_cells()),
          space.n_unknowns(),
          boundary.size(),
          least_diameter,
          largest_diameter};
}

std::vector<ContactRow> tabulate_contact(const ContactBoundary& boundary,
                                         const ContactProblem& problem, const ContactState& state) {
  const Vector<double> gap = problem.gaps(state.displacement),
                       pressure = problem.pressures(state.force);
  std::vector<ContactRow> rows;
  for (unsigned int i = 0; i < problem.size(); ++i)
    rows.push_back({boundary.contact_nodes()[i].angle, state.displacement(i), problem.phi(i),
                    gap(i), pressure(i), problem.weight(i)});
  return rows;
}

std::vector<SurfacePoint> tabulate_surface(const ContactBoundary& boundary,
                                           const FieldVector& field,
                                           const Vector<double>& pressure) {
  const RingSpace& space = boundary.space();
  const std::vector<double> values = space.surface_values(field);
  std::vector<SurfacePoint> points;
  for (unsigned int i = 0; i < values.size(); ++i) {
    const auto node = boundary.contact_number(i);
    points.push_back({space.surface_nodes()[i].angle, values[i], node ? pressure(*node) : 0.});
  }
  return points;
}

} // namespace

Result measure(const MeshSolution& solution) {
  const ContactState& state = solution.contact.state;
  Result result = {};
  result.mesh = describe_mesh(solution.boundary);
  result.road_distance = solution.scene.road.distance;
  result.deflection = solution.scene.outer_radius - solution.scene.road.distance;
  result.relative_deflection =
      result.deflection / (solution.scene.outer_radius - solution.scene.inner_radius);
  result.distance_history = solution.distance_history;
  result.contact = solution.resultants;
  result.energy = solution.energy;
  result.residuals = solution.residuals;
  result.history = solution.contact.history;
  result.step_length = solution.contact.step_length;
  result.remarks = solution.remarks;
  result.shortfalls = solution.shortfalls;
  result.contact_rows = tabulate_contact(solution.boundary, solution.problem, state);
  result.surface = tabulate_surface(solution.boundary, solution.displacement,
                                    solution.problem.pressures(state.force));
  return result;
}

} // namespace rollwave
