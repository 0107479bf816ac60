#include "rollwave/run/make_result.h"

#include "rollwave/mesh/contact_boundary.h"
#include "rollwave/run/remarks.h"

#include <deal.II/grid/tria.h>

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

Result make_result(const RunOptions& options, const Mesh& mesh, const MeshSolution& solution,
                   const std::optional<Certificate>& certificate, std::vector<CycleFigures> cycles,
                   bool is_interrupted, RunStatistics statistics) {
  const Scene& scene = solution.scene;
  const ContactState& state = solution.contact.state;
  Result result = {};
  result.mesh = describe_mesh(solution.boundary);
  result.road_distance = scene.road.distance;
  result.deflection = scene.outer_radius - scene.road.distance;
  result.relative_deflection = result.deflection / (scene.outer_radius - scene.inner_radius);
  result.contact = solution.resultants;
  result.energy = solution.energy;
  result.residuals = solution.residuals;
  if (certificate)
    result.certified = certificate->error;
  result.cycles = std::move(cycles);
  result.distance_history = solution.distance_history;
  result.history = solution.contact.history;
  result.step_length = solution.contact.step_length;
  if (scene.load && scene.nip)
    result.modulus_ratio = scene.units.material.shear_modulus / options.material.shear_modulus;
  result.is_interrupted = is_interrupted;
  result.contact_rows = tabulate_contact(solution.boundary, solution.problem, state);
  result.surface = tabulate_surface(solution.boundary, solution.displacement,
                                    solution.problem.pressures(state.force));
  result.notes = solution.notes;
  for (Note& note : notes_on(options, mesh, solution, result))
    result.notes.push_back(std::move(note));
  result.statistics = std::move(statistics);
  return result;
}

} // namespace rollwave
