#include "mesh_plot.h"

#include "processes.h"

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

/// Appends the edge of a cell from one vertex to another as a line in x / b and y / b.
class EdgeWriter {
public:
  EdgeWriter(std::ostream& out, const Solution& solution)
      : out(out), field(solution.displacement), b(solution.space->outer_radius()),
        element(dynamic_cast<const FE_Q<2>&>(solution.space->dof_handler().get_fe())),
        dofs(element.n_dofs_per_cell()) {}

  void operator()(const DoFHandler<2>::active_cell_iterator& cell, const Point<2>& from,
                  const Point<2>& to) {
    cell->get_dof_indices(dofs);
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    // Straight in (r, z), a long edge around the axle is an arc.
    const unsigned int n = from[1] == to[1] ? 1 : std::ceil((high[1] - low[1]) / 0.02);
    for (unsigned int i = 0; i <= n; ++i) {
      const Point<2> place = from + (to - from) * (static_cast<double>(i) / n);
      double u = 0;
      for (unsigned int k = 0; k < dofs.size(); ++k)
        u += field(dofs[k]) * element.shape_value(k, {(place[0] - low[0]) / (high[0] - low[0]),
                                                      (place[1] - low[1]) / (high[1] - low[1])});
      const double r = (place[0] + u) / b;
      out << r * std::cos(place[1]) << ' ' << r * std::sin(place[1]) << '\n';
    }
    out << '\n';
  }

private:
  std::ostream& out;
  const FieldVector& field;
  const double b;
  const FE_Q<2>& element;
  std::vector<types::global_dof_index> dofs;
};

} // namespace

std::optional<Drawing> plot_mesh(const Scene& scene, const Solution& solution) {
  std::ostringstream edges;
  edges.precision(7);
  EdgeWriter write_edge(edges, solution);
  for (const auto& cell : solution.space->dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    // The other two edges belong to neighbours as well.
    write_edge(cell, cell->vertex(0), cell->vertex(1));
    write_edge(cell, cell->vertex(1), cell->vertex(3));
    if (cell->at_boundary(0))
      write_edge(cell, cell->vertex(0), cell->vertex(2));
  }
  std::ostringstream script;
  script.precision(7);
  script << "$edges << EOD\n";
  for (const auto& part : gather_texts(solution.space->communicator(), edges.str()))
    script << part;
  const double half_width = std::max(0.1, 1.4 * solution.result.patch.half_width());
  const double width = std::min(1., std::sin(std::min(half_width, 1.57)));
  // Where the lowest point of the surface is, in units of b.
  const double lowest =
      -1 - scene.road((scene.zone_begin + scene.zone_end) / 2) / scene.outer_radius;
  double largest_radius = 1;
  for (const SurfacePoint& point : solution.result.surface)
    largest_radius = std::max(largest_radius, 1 + point.displacement / scene.outer_radius);
  script << "EOD\nhalf = " << 1.1 * largest_radius << R"(
set multiplot
set size ratio -1 1,0.62
set origin 0,0.38
set xrange [-half:half]
set yrange [-half:half]
set xlabel 'x / b'
set ylabel 'y / b'
plot '$edges' with lines linewidth 0.5 linecolor rgb '#1f5fa8' notitle
set size ratio -1 1,0.38
set origin 0,0
)"
         << "set xrange [" << -width << ':' << width << "]\nset yrange [" << lowest - 0.02 << ':'
         << lowest + 0.7 * width << "]\n"
         << "plot '$edges' with lines linewidth 0.5 linecolor rgb '#1f5fa8' notitle\n";
  if (process_number(solution.space->communicator()) > 0)
    return {};
  return Drawing(script.str(), 760, 1100);
}

} // namespace rollwave
