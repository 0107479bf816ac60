#include "rollwave/output/vtu.h"

#include "rollwave/scene/units.h"

#include <deal.II/base/data_out_base.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/reference_cell.h>
#include <deal.II/grid/tria.h>

#include <cmath>
#include <limits>
#include <ostream>
#include <tuple>

namespace rollwave {

using namespace dealii;

namespace {

using Patch = DataOutBase::Patch<2>;

/// The patches of cells take several times the memory of the mesh, so that the file has pieces.
constexpr std::size_t cells_in_piece = 50000;

using Ranges = std::vector<std::tuple<unsigned int, unsigned int, std::string,
                                      DataComponentInterpretation::DataComponentInterpretation>>;

/// Makes a patch for each cell, with the element's own nodes at their deformed places.
class DeformedCells {
public:
  explicit DeformedCells(const Solution& solution)
      : solution(solution), units(solution.scene.units), space(solution.space()),
        element(dynamic_cast<const FE_Q<2>&>(space.dof_handler().get_fe())),
        numbering(element.get_poly_space_numbering_inverse()),
        values(space.mapping(), element, element.get_unit_support_points(),
               update_quadrature_points | update_values | update_gradients),
        u(element.n_dofs_per_cell()), gradients(element.n_dofs_per_cell()),
        n_rows(field_names(solution).size() + 2) {}

  Patch patch(const DoFHandler<2>::active_cell_iterator& cell, unsigned int index) {
    values.reinit(cell);
    values.get_function_values(solution.displacement, u);
    values.get_function_gradients(solution.displacement, gradients);
    const double bound = solution.certificate
                             ? solution.certificate->cell_bounds[cell->active_cell_index()] *
                                   units.of(Quantity::energy_norm)
                             : 0;
    const double length = units.length, pressure = units.of(Quantity::pressure);
    Patch patch;
    patch.patch_index = index;
    patch.reference_cell = ReferenceCells::Quadrilateral;
    patch.n_subdivisions = element.degree;
    patch.points_are_available = true;
    patch.data.reinit(n_rows, u.size());
    for (unsigned int i = 0; i < u.size(); ++i) {
      const unsigned int node = numbering[i];
      const double r = values.quadrature_point(node)[0], z = values.quadrature_point(node)[1];
      const Point<2> outwards(std::cos(z), std::sin(z));
      unsigned int row = 0;
      const auto add = [&](double value) { patch.data(row++, i) = value; };
      const auto add_vector = [&](double length) {
        add(length * outwards[0]);
        add(length * outwards[1]);
      };
      add(u[node] * length);
      add(gradients[node][0] * pressure);
      add(r * length);
      add(z);
      add_vector(u[node] * length);
      if (solution.certificate)
        add(bound);
      add_vector((r + u[node]) * length);
    }
    for (const unsigned int vertex : cell->vertex_indices())
      patch.vertices[vertex] = cell->vertex(vertex);
    return patch;
  }

  /// The names of scalars and of components of vectors.
  static std::vector<std::string> field_names(const Solution& solution) {
    const Units& units = solution.scene.units;
    const std::string length = units.in_brackets(Quantity::length);
    std::vector<std::string> names = {"displacement" + length,
                                      "radial_stress" + units.in_brackets(Quantity::pressure),
                                      "radius" + length,
                                      "angle" + units.in_brackets(Quantity::angle),
                                      "x",
                                      "y"};
    if (solution.certificate)
      names.push_back("certified_error" + units.in_brackets(Quantity::energy_norm));
    return names;
  }

  /// The vectors among them.
  static Ranges vectors(const Solution& solution) {
    return {{4, 5, "displacement_vector" + solution.scene.units.in_brackets(Quantity::length),
             DataComponentInterpretation::component_is_part_of_vector}};
  }

private:
  const Solution& solution;
  const Units& units;
  const RingSpace& space;
  const FE_Q<2>& element;
  /// From the order of points in a patch, r running fastest, to the element's own order.
  const std::vector<unsigned int> numbering;
  FEValues<2> values;
  std::vector<double> u;
  std::vector<Tensor<1, 2>> gradients;
  const unsigned int n_rows; ///< fields, then the places of the points
};

DataOutBase::VtkFlags vtk_flags(const Solution& solution, CellKind cells) {
  DataOutBase::VtkFlags flags;
  flags.write_higher_order_cells = solution.result.mesh.degree > 1 && cells == CellKind::high_order;
  flags.print_date_and_time = false; // a run repeated gives the same file
  flags.compression_level = decltype(flags.compression_level)::best_speed;
  return flags;
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
    out << "<DataArray type=\"Float64\" Name=\"" << name << units.in_brackets(quantity)
        << "\" NumberOfTuples=\"1\" format=\"ascii\">" << value * units.of(quantity)
        << "</DataArray>\n";
  out << "</FieldData>\n";
}

} // namespace

void write_solution_pvtu(std::ostream& out, const Solution& solution, CellKind kind,
                         const std::vector<std::string>& pieces) {
  DataOutBase::write_pvtu_record(out, pieces, DeformedCells::field_names(solution),
                                 DeformedCells::vectors(solution), vtk_flags(solution, kind));
}

void write_solution_vtu(std::ostream& out, const Solution& solution, CellKind kind) {
  DeformedCells cells(solution);
  const DataOutBase::VtkFlags flags = vtk_flags(solution, kind);
  try {
    DataOutBase::write_vtu_header(out, flags);
    write_field_data(out, solution);
    std::vector<Patch> patches;
    const auto write_piece = [&] {
      DataOutBase::write_vtu_main(patches, DeformedCells::field_names(solution),
                                  DeformedCells::vectors(solution), flags, out);
      patches.clear();
    };
    for (const auto& cell : solution.space().dof_handler().active_cell_iterators())
      if (cell->is_locally_owned()) {
        if (patches.size() == cells_in_piece)
          write_piece();
        patches.push_back(cells.patch(cell, patches.size()));
      }
    write_piece();
    DataOutBase::write_vtu_footer(out);
  } catch (const StandardExceptions::ExcIO&) {
    // The caller checks the stream and names the file.
    if (!out.fail())
      throw;
  }
}

} // namespace rollwave
