#include "rollwave/run/finish.h"

#include "rollwave/base/errors.h"
#include "rollwave/mesh/contact_boundary.h"
#include "rollwave/run/remarks.h"

#include <deal.II/grid/tria.h>
#include <deal.II/lac/vector.h>

#include <utility>

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
    rows.push_back({boundary.contact_nodes()[i].angle, problem.road.arc_length(problem.x[i]),
                    state.displacement(i), problem.phi(i), gap(i), pressure(i), problem.weight(i)});
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

Solution finish(Run run, LastSolution last) {
  MeshSolution& solution = last.solution;
  const Scene& scene = solution.scene;
  if (solution.road_refusal)
    throw BadValue("Road", scene.nip ? "Nip" : "Load", *solution.road_refusal);
  const ContactState& state = solution.contact.state;
  Result result = {std::move(solution.result)};
  result.mesh = describe_mesh(solution.boundary);
  result.road_distance = scene.road.distance;
  result.deflection = scene.outer_radius - scene.road.distance;
  result.relative_deflection = result.deflection / (scene.outer_radius - scene.inner_radius);
  if (last.certificate)
    result.certified = last.certificate->error;
  result.cycles = std::move(run.cycles);
  result.is_interrupted = last.is_interrupted;
  result.contact_rows = tabulate_contact(solution.boundary, solution.problem, state);
  result.surface = tabulate_surface(solution.boundary, solution.displacement,
                                    solution.problem.pressures(state.force));
  const auto notes = notes_on(run.options, run.mesh, solution, result);
  result.notes.insert(result.notes.end(), notes.begin(), notes.end());
  result.statistics = std::move(run.statistics);
  return {scene, std::move(run.mesh), std::move(solution.displacement), std::move(last.certificate),
          std::move(result)};
}

} // namespace rollwave
