#include "rollwave/run/measure.h"

#include "rollwave/mesh/ring_space.h"

#include <deal.II/grid/tria.h>

namespace rollwave {

using namespace dealii;

namespace {

MeshFigures describe_mesh(const RingSpace& space) {
  const auto& handler = space.dof_handler();
  const auto [least_diameter, largest_diameter] = space.diameters();
  return {handler.get_fe().degree,
          static_cast<unsigned int>(handler.get_triangulation().n_global_active_cells()),
          space.n_unknowns(),
          static_cast<unsigned int>(space.contact_nodes().size()),
          least_diameter,
          largest_diameter};
}

std::vector<ContactRow> tabulate_contact(const RingSpace& space, const ContactProblem& problem,
                                         const ContactState& state) {
  const Vector<double> gap = problem.gaps(state.displacement),
                       pressure = problem.pressures(state.force);
  std::vector<ContactRow> rows;
  for (unsigned int i = 0; i < problem.size(); ++i)
    rows.push_back({space.contact_nodes()[i].angle, state.displacement(i), problem.road(i), gap(i),
                    pressure(i), problem.weight(i)});
  return rows;
}

std::vector<SurfacePoint> tabulate_surface(const RingSpace& space, const FieldVector& field,
                                           const Vector<double>& pressure) {
  const std::vector<double> values = space.surface_values(field);
  std::vector<SurfacePoint> points;
  for (unsigned int i = 0; i < values.size(); ++i)
    points.push_back({space.surface_nodes()[i].angle, values[i], 0});
  for (unsigned int i = 0; i < values.size(); ++i)
    if (const auto node = space.contact_number(i))
      points[i].pressure = pressure(*node);
  return points;
}

} // namespace

Result measure(const RingSpace& space, const MeshSolution& solution) {
  const ContactState& state = solution.contact.state;
  Result result = {};
  result.mesh = describe_mesh(space);
  result.road_distance = solution.scene.road.distance;
  result.patch = solution.resultants;
  result.energy = solution.energy;
  result.residuals = solution.residuals;
  result.history = solution.contact.history;
  result.rho = solution.contact.rho;
  result.remarks = solution.remarks;
  result.shortfalls = solution.shortfalls;
  result.contact_rows = tabulate_contact(space, solution.problem, state);
  result.surface =
      tabulate_surface(space, solution.displacement, solution.problem.pressures(state.force));
  return result;
}

} // namespace rollwave
