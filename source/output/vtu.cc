#include "rollwave/output/vtu.h"

#include <deal.II/base/data_out_base.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/reference_cell.h>
#include <deal.II/grid/tria.h>

#include <cmath>
#include <limits>
#include <ostream>

namespace rollwave {

using namespace dealii;

namespace {

using Patch = DataOutBase::Patch<2>;

/// A piece of the file is as many cells: their patches take several times the memory of the mesh.
constexpr std::size_t cells_in_piece = 50000;

/// Makes a patch for each cell, with the element's own nodes at their deformed places.
class DeformedCells {
public:
  DeformedCells(const Solution& solution, double unit)
      : solution(solution), unit(unit), space(*solution.space),
        element(dynamic_cast<const FE_Q<2>&>(space.dof_handler().get_fe())),
        numbering(element.get_poly_space_numbering_inverse()),
        values(space.mapping(), element, element.get_unit_support_points(),
               update_quadrature_points),
        dofs(element.n_dofs_per_cell()) {
    if (solution.certificate)
      names.push_back("certified_error");
  }

  const std::vector<std::string>& dataset_names() const { return names; }

  Patch patch(const DoFHandler<2>::active_cell_iterator& cell, unsigned int index) {
    // Behind the data the places of the points
    const unsigned int x_row = names.size(), y_row = x_row + 1;
    values.reinit(cell);
    cell->get_dof_indices(dofs);
    Patch patch;
    patch.patch_index = index;
    patch.reference_cell = ReferenceCells::Quadrilateral;
    patch.n_subdivisions = element.degree;
    patch.points_are_available = true;
    patch.data.reinit(y_row + 1, dofs.size());
    for (unsigned int i = 0; i < dofs.size(); ++i) {
      const unsigned int node = numbering[i];
      const double u = solution.displacement(dofs[node]);
      const double r = values.quadrature_point(node)[0] + u;
      const double z = values.quadrature_point(node)[1];
      patch.data(0, i) = u * unit;
      patch.data(1, i) = std::numeric_limits<float>::quiet_NaN();
      if (solution.certificate)
        patch.data(2, i) = solution.certificate->cell_bounds[cell->active_cell_index()] * unit;
      patch.data(x_row, i) = r * std::cos(z) * unit;
      patch.data(y_row, i) = r * std::sin(z) * unit;
    }
    if (const auto face = space.surface_face(cell)) {
      const auto& nodes = space.surface_faces()[*face].nodes;
      const unsigned int n = nodes.size();
      for (unsigned int k = 0; k < n; ++k) {
        const auto contact = space.contact_number(nodes[k]);
        patch.data(1, n - 1 + n * k) =
            contact ? solution.result.contact_rows[*contact].pressure : 0;
      }
    }
    for (const unsigned int vertex : cell->vertex_indices())
      patch.vertices[vertex] = cell->vertex(vertex);
    return patch;
  }

private:
  const Solution& solution;
  const double unit;
  const RingSpace& space;
  const FE_Q<2>& element;
  /// From the order of points in a patch, r running fastest, to the element's own order.
  const std::vector<unsigned int> numbering;
  FEValues<2> values;
  std::vector<types::global_dof_index> dofs;
  std::vector<std::string> names = {"displacement", "pressure"};
};

DataOutBase::VtkFlags vtk_flags(const Solution& solution) {
  DataOutBase::VtkFlags flags;
  flags.write_higher_order_cells = solution.result.mesh.degree > 1;
  flags.print_date_and_time = false; // a run repeated gives the same file
  flags.compression_level = decltype(flags.compression_level)::best_speed;
  return flags;
}

} // namespace

void write_solution_pvtu(std::ostream& out, const Solution& solution,
                         const std::vector<std::string>& pieces) {
  DataOutBase::write_pvtu_record(out, pieces, DeformedCells(solution, 1).dataset_names(), {},
                                 vtk_flags(solution));
}

void write_solution_vtu(std::ostream& out, const Solution& solution, double unit) {
  DeformedCells cells(solution, unit);
  const DataOutBase::VtkFlags flags = vtk_flags(solution);
  try {
    DataOutBase::write_vtu_header(out, flags);
    std::vector<Patch> patches;
    const auto write_piece = [&] {
      DataOutBase::write_vtu_main(patches, cells.dataset_names(), {}, flags, out);
      patches.clear();
    };
    for (const auto& cell : solution.space->dof_handler().active_cell_iterators()) {
      if (!cell->is_locally_owned())
        continue;
      if (patches.size() == cells_in_piece)
        write_piece();
      patches.push_back(cells.patch(cell, patches.size()));
    }
    write_piece();
    DataOutBase::write_vtu_footer(out);
  } catch (const StandardExceptions::ExcIO&) {
    // The stream remembers its failure for its owner, who knows the file's name.
    if (!out.fail())
      throw;
  }
}

} // namespace rollwave
