#include "rollwave/output/vtu.h"

#include "rollwave/base/mpi_processes.h"
#include "rollwave/scene/units.h"

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/reference_cell.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <tuple>
#include <vector>

namespace rollwave {

using namespace dealii;

namespace {

using Patch = DataOutBase::Patch<2>;

/// The names of scalars and of components of vectors.
std::vector<std::string> field_names(const Solution& solution) {
  const Units& units = solution.scene.units;
  const std::string length = units.as_suffix(Quantity::length);
  std::vector<std::string> names = {"displacement" + length,
                                    "radial_stress" + units.as_suffix(Quantity::pressure),
                                    "radius" + length,
                                    "angle" + units.as_suffix(Quantity::angle),
                                    "x",
                                    "y"};
  if (solution.certificate)
    names.push_back("certified_error" + units.as_suffix(Quantity::energy_norm));
  return names;
}

/// The k-th of the points along a side of a cell; r runs fastest.
unsigned int point_on_side(unsigned int degree, unsigned int side, unsigned int k) {
  const bool is_radial = side >= 2;
  const unsigned int across = side % 2 == 0 ? 0 : degree;
  return is_radial ? k + (degree + 1) * across : across + (degree + 1) * k;
}

/// Moves points of a side that is half of a coarser cell's side onto that one, so that there is no
/// crack: onto the polynomial through its points at their deformed places, or, for cells of four
/// nodes, onto the straight lines between these.
/// @param values of the coarser cells, at the points of a patch
void join_to_coarser_cells(const DoFHandler<2>::active_cell_iterator& cell, FEValues<2>& values,
                           const FieldVector& displacement, double length, bool is_curved,
                           Patch& patch) {
  const unsigned int p = patch.n_subdivisions, x = patch.data.n_rows() - 2;
  const auto basis = Polynomials::LagrangeEquidistant::generate_complete_basis(p);
  const auto share = [&basis, p, is_curved](unsigned int m, double t) {
    return is_curved ? basis[m].value(t) : std::max(0., 1 - std::abs(p * t - m));
  };
  std::vector<double> u(values.n_quadrature_points);
  for (const unsigned int side : cell->face_indices()) {
    if (cell->at_boundary(side) || !cell->neighbor_is_coarser(side))
      continue;
    const auto [coarse_side, half] = cell->neighbor_of_coarser_neighbor(side);
    values.reinit(cell->neighbor(side));
    values.get_function_values(displacement, u);
    for (unsigned int k = 0; k <= p; ++k) {
      const double t = (half + 1. * k / p) / 2;
      Tensor<1, 2> place;
      for (unsigned int m = 0; m <= p; ++m) {
        const unsigned int q = point_on_side(p, coarse_side, m);
        const double r = values.quadrature_point(q)[0], z = values.quadrature_point(q)[1];
        const double scaled = share(m, t) * (r + u[q]) * length;
        place[0] += scaled * std::cos(z);
        place[1] += scaled * std::sin(z);
      }
      for (unsigned int d = 0; d < 2; ++d)
        patch.data(x + d, point_on_side(p, side, k)) = place[d];
    }
  }
}

/// A patch for each cell of this process. Its points are equidistant in (r, z), as VTK's Lagrange
/// cells have them, and lie at their deformed places. Their fields, then their places, are rows.
std::vector<Patch> deformed_cells(const Solution& solution, bool is_curved) {
  const RingSpace& space = solution.space();
  const auto& element = space.dof_handler().get_fe();
  const QIterated<2> points(QTrapezoid<1>(), element.degree); // r running fastest, as in a patch
  FEValues<2> values(space.mapping(), element, points,
                     update_quadrature_points | update_values | update_gradients);
  FEValues<2> values_of_coarser(space.mapping(), element, points,
                                update_quadrature_points | update_values);
  std::vector<double> u(points.size());
  std::vector<Tensor<1, 2>> gradients(points.size());
  const Units& units = solution.scene.units;
  const double length = units.length, pressure = units.of(Quantity::pressure),
               energy_norm = units.of(Quantity::energy_norm);
  const unsigned int n_rows = field_names(solution).size() + 2;
  std::vector<Patch> patches;
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    values.reinit(cell);
    values.get_function_values(solution.displacement, u);
    values.get_function_gradients(solution.displacement, gradients);
    Patch patch;
    patch.patch_index = patches.size();
    patch.reference_cell = ReferenceCells::Quadrilateral;
    patch.n_subdivisions = element.degree;
    patch.points_are_available = true;
    patch.data.reinit(n_rows, points.size());
    for (const unsigned int q : values.quadrature_point_indices()) {
      const double r = values.quadrature_point(q)[0], z = values.quadrature_point(q)[1];
      unsigned int row = 0;
      const auto add = [&](double value) { patch.data(row++, q) = value; };
      const auto add_vector = [&](double radius) {
        add(radius * std::cos(z));
        add(radius * std::sin(z));
      };
      add(u[q] * length);
      add(gradients[q][0] * pressure);
      add(r * length);
      add(z);
      add_vector(u[q] * length);
      if (solution.certificate)
        add(solution.certificate->cell_bounds[cell->active_cell_index()] * energy_norm);
      add_vector((r + u[q]) * length);
    }
    join_to_coarser_cells(cell, values_of_coarser, solution.displacement, length, is_curved, patch);
    patches.push_back(std::move(patch));
  }
  return patches;
}

DataOutBase::VtkFlags vtk_flags(const Solution& solution, CellKind cells) {
  DataOutBase::VtkFlags flags;
  flags.write_higher_order_cells = solution.result.mesh.degree > 1 && cells == CellKind::high_order;
  flags.print_date_and_time = false; // a run repeated gives the same file
  flags.compression_level = decltype(flags.compression_level)::best_speed;
  return flags;
}

/// The cells of this process as one piece of the file; empty without cells.
std::string piece(const Solution& solution, const DataOutBase::VtkFlags& flags) {
  const std::string length = solution.scene.units.as_suffix(Quantity::length);
  std::ostringstream out;
  const auto patches = deformed_cells(solution, flags.write_higher_order_cells);
  if (!patches.empty())
    DataOutBase::write_vtu_main(patches, field_names(solution),
                                {{4, 5, "displacement_vector" + length, // x and y
                                  DataComponentInterpretation::component_is_part_of_vector}},
                                flags, out);
  return out.str();
}

/// The numbers of the scene, for captions.
void write_field_data(std::ostream& out, const Solution& solution) {
  const Units& units = solution.scene.units;
  out.precision(std::numeric_limits<double>::max_digits10);
  out << "<FieldData>\n";
  for (const auto& [name, value, quantity] :
       {std::tuple("omega", solution.scene.angular_velocity, Quantity::angular_velocity),
        {"c", solution.scene.road.distance, Quantity::length},
        {"F", solution.result.contact.loads.total, Quantity::force}})
    out << "<DataArray type=\"Float64\" Name=\"" << name << units.as_suffix(quantity)
        << "\" NumberOfTuples=\"1\" format=\"ascii\">" << value * units.of(quantity)
        << "</DataArray>\n";
  out << "</FieldData>\n";
}

} // namespace

std::string solution_vtu(const Solution& solution, CellKind kind) {
  const MPI_Comm communicator = solution.space().communicator();
  const unsigned int rank = process_number(communicator);
  const DataOutBase::VtkFlags flags = vtk_flags(solution, kind);
  std::ostringstream part;
  if (rank == 0) {
    DataOutBase::write_vtu_header(part, flags);
    write_field_data(part, solution);
  }
  part << piece(solution, flags);
  if (rank + 1 == count_processes(communicator))
    DataOutBase::write_vtu_footer(part);
  return part.str();
}

} // namespace rollwave
