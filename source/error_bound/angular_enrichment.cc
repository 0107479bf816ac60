#include "rollwave/error_bound/angular_enrichment.h"

#include "rollwave/base/mpi_processes.h"
#include "rollwave/mesh/line_elements.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

extern "C" void dpbsv_(const char* triangle, const int* n, const int* width, const int* n_rhs,
                       double* band, const int* stride, double* b, const int* ldb, int* info);

namespace rollwave {

using namespace dealii;

namespace {

/// A cell of a column with its faces towards the hub and the surface.
struct ColumnCell {
  using Face = std::pair<types::global_dof_index, types::global_dof_index>; ///< of its vertices
  Face lower, upper;
  double length, r_begin, r_end;
  unsigned int number;   ///< of an own active cell
  int edge;              ///< of RingSpace::surface_faces(), -1 inside
  bool is_cut;           ///< another process has the next cell, which may be of the column
  std::vector<double> g; ///< its load, that is the derivatives of D(tau) by it, until it is known

  template <class Archive>
  void serialize(Archive& archive, unsigned int) {
    archive& lower& upper& length& r_begin& r_end& number& edge& is_cut& g;
  }
};

using Column = std::vector<ColumnCell*>;

/// What is nearest to @p wanted among the m with lambda + m P >= 0 for sure: coefficients over
/// Bernstein's polynomials B_k are positive, those of P are (-1)^(p + k) binomial(p, k) (2 p +
/// 1)^(1/2), those of lambda lie on a line. There are such m for all that admissible_pressures()
/// returns.
double nearest_mode(const EdgePressure& pressure, unsigned int degree, double wanted) {
  double nearest = wanted, binomial = 1;
  for (unsigned int k = 0; k <= degree; ++k) {
    const double of_mode = ((degree + k) % 2 ? -1 : 1) * binomial * std::sqrt(2 * degree + 1.);
    const double limit = pressure(1. * k / degree) / -of_mode;
    nearest = of_mode < 0 ? std::min(nearest, limit) : std::max(nearest, limit);
    binomial *= 1. * (degree - k) / (k + 1);
  }
  return nearest;
}

/// Whether another process has what is beyond a face.
bool is_foreign_beyond(const DoFHandler<2>::active_cell_iterator& cell, unsigned int face) {
  const auto beyond = neighbours(cell, face);
  return !beyond.empty() && !beyond.front()->is_locally_owned();
}

/// The own cells with their loads.
std::vector<ColumnCell> make_cells(const RingSpace& space, const Scene& scene,
                                   RadialShapesOfMesh& shapes, const FieldVector& potential,
                                   const std::vector<EdgePressure>& pressures,
                                   const ForceIntegral* force) {
  const unsigned int degree = space.dof_handler().get_fe().degree, n = degree + 1;
  const QGauss<1> gauss(degree + 2);
  const auto legendre = angular_mode(degree), beta = legendre.primitive();
  const auto lagrange = lobatto_lagrange(degree);
  std::vector<double> bubble_of(n); // int beta L_j dt
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int q = 0; q < gauss.size(); ++q) {
      const double t = gauss.point(q)[0];
      bubble_of[j] += gauss.weight(q) * beta.value(t) * lagrange[j].value(t);
    }
  LexicographicDofs dofs(space.dof_handler());
  std::vector<double> psi_bubble(n), force_on_line(n);
  std::vector<ColumnCell> cells;
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    const double length = high[1] - low[1];
    const RadialShapes& radial = shapes.on(low[0], high[0]);
    std::vector<double> load(n);
    const auto& of_cell = dofs.of(cell);
    for (unsigned int i = 0; i < n; ++i) {
      psi_bubble[i] = 0;
      for (unsigned int j = 0; j < n; ++j)
        psi_bubble[i] += bubble_of[j] * potential(of_cell[i + n * j]);
    }
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int k = 0; k < n; ++k)
        load[i] -= length * length * radial.products.stiffness(i, k) * psi_bubble[k];
    for (unsigned int p = 0; force && p < force->rule().size(); ++p) {
      radial.integrate(force->on_line(cell->active_cell_index(), p), radial.weight_over_r,
                       &RadialShape::potential, force_on_line);
      const double weight =
          length * force->rule().weight(p) * legendre.value(force->rule().point(p)[0]);
      for (unsigned int i = 0; i < n; ++i)
        load[i] += weight * force_on_line[i];
    }
    const auto edge = space.surface_face(cell);
    if (edge && pressures[*edge].mean > 0)
      for (unsigned int q = 0; q < gauss.size(); ++q) {
        const double t = gauss.point(q)[0], z = space.surface_faces()[*edge].begin + t * length;
        load[degree] -= length * gauss.weight(q) * legendre.value(t) * scene.road(z);
      }
    cells.push_back({{cell->vertex_dof_index(0, 0), cell->vertex_dof_index(2, 0)},
                     {cell->vertex_dof_index(1, 0), cell->vertex_dof_index(3, 0)},
                     length,
                     low[0],
                     high[0],
                     cell->active_cell_index(),
                     edge ? int(*edge) : -1,
                     is_foreign_beyond(cell, 0) || is_foreign_beyond(cell, 1),
                     std::move(load)});
  }
  return cells;
}

/// The columns that cells form, from the inside out.
std::vector<Column> columns_of(std::vector<ColumnCell>& cells) {
  // By a vertex that one cell alone has at this corner.
  std::unordered_map<types::global_dof_index, ColumnCell*> above(cells.size());
  for (ColumnCell& cell : cells)
    above[cell.lower.first] = &cell;
  const auto next_of = [&](ColumnCell& cell) {
    const auto next = above.find(cell.upper.first);
    return next != above.end() && next->second->lower == cell.upper ? next->second : nullptr;
  };
  std::vector<bool> is_next(cells.size());
  for (ColumnCell& cell : cells)
    if (ColumnCell* const next = next_of(cell))
      is_next[next - cells.data()] = true;
  std::vector<Column> columns;
  for (ColumnCell& cell : cells)
    if (!is_next[&cell - cells.data()]) {
      columns.emplace_back();
      for (ColumnCell* next = &cell; next; next = next_of(*next))
        columns.back().push_back(next);
    }
  return columns;
}

/// Adds what other processes have of columns that several share.
void add_cells_of_others(MPI_Comm communicator, std::vector<ColumnCell>& cells) {
  std::vector<ColumnCell> shared;
  for (const Column& column : columns_of(cells))
    if (column.front()->is_cut || column.back()->is_cut)
      for (const ColumnCell* const cell : column)
        shared.push_back(*cell);
  const auto of_all = Utilities::MPI::all_gather(communicator, shared);
  for (unsigned int process = 0; process < of_all.size(); ++process)
    if (process != process_number(communicator))
      cells.insert(cells.end(), of_all[process].begin(), of_all[process].end());
}

/// The banded system of the nodes of a column, the least of
///
///     1/2 (int (h_z beta g_s)^2 ds dz + int (P g)^2 / r dr dz) - loads,
///
/// with two right-hand sides: the loads, and a load of 1 on the outermost node.
struct ColumnSystem {
  static constexpr int n_rhs = 2;
  const int width, rows;
  std::vector<double> band; ///< LAPACK's storage of the lower triangle, width + 1 entries a column
  std::vector<double> g;

  ColumnSystem(RadialShapesOfMesh& shapes, const Column& column)
      : width(column.front()->g.size() - 1), rows(column.size() * width + 1),
        band(rows * (width + 1)), g(n_rhs * rows) {
    const double length = column.front()->length;
    const double beta_square = 1. / (2. * (2 * width + 3) * (2 * width - 1)); // int beta^2 dt
    for (unsigned int c = 0; c < column.size(); ++c) {
      const ShapeProducts& products = shapes.on(column[c]->r_begin, column[c]->r_end).products;
      for (int i = 0; i <= width; ++i) {
        const int row = c * width + i;
        g[row] += column[c]->g[i];
        for (int k = i; k <= width; ++k)
          band[row * (width + 1) + k - i] +=
              length *
              (length * length * beta_square * products.stiffness(i, k) + products.mass(i, k));
      }
    }
    g[2 * rows - 1] = 1;
  }

  void fix_innermost() {
    std::fill_n(band.begin(), width + 1, 0.);
    band[0] = 1;
    g[0] = 0;
  }

  void solve() {
    // By as much as rounding may make a matrix indefinite that is hardly definite.
    constexpr double round_off = 1e-14;
    const int stride = width + 1;
    for (int i = 0; i < rows; ++i)
      band[i * stride] *= 1 + round_off;
    int info = 0;
    dpbsv_("L", &rows, &width, &n_rhs, band.data(), &stride, g.data(), &rows, &info);
    AssertThrow(info == 0, ExcMessage("a banded matrix is not positive definite"));
  }
};

/// Puts the g of the cells of a column in the place of their loads.
void solve_column(const Scene& scene, RadialShapesOfMesh& shapes,
                  const std::vector<EdgePressure>& pressures, const Column& column) {
  ColumnSystem system(shapes, column);
  if (column.front()->r_begin != scene.inner_radius)
    system.fix_innermost();
  system.solve();
  // Of a convex function the least with a bound of one value has that value at the bound, and the
  // rest as is best then.
  std::vector<double>& g = system.g;
  const int rows = system.rows, edge = column.back()->edge;
  const double b = scene.outer_radius;
  const double outermost =
      edge < 0 ? 0 : b * nearest_mode(pressures[edge], system.width, g[rows - 1] / b);
  const double factor = (outermost - g[rows - 1]) / g[2 * rows - 1];
  for (int i = 0; i < rows; ++i)
    g[i] += factor * g[rows + i];
  g[rows - 1] = outermost;
  for (unsigned int c = 0; c < column.size(); ++c)
    std::copy_n(&g[c * system.width], column[c]->g.size(), column[c]->g.begin());
}

} // namespace

Polynomials::Polynomial<double> angular_mode(unsigned int degree) {
  return Polynomials::Legendre(degree);
}

std::vector<double> angular_enrichment(const RingSpace& space, const Scene& scene,
                                       RadialShapesOfMesh& shapes, const FieldVector& potential,
                                       const std::vector<EdgePressure>& pressures,
                                       const ForceIntegral* force) {
  std::vector<ColumnCell> cells = make_cells(space, scene, shapes, potential, pressures, force);
  const std::size_t n_own = cells.size();
  if (!is_alone(space.communicator()))
    add_cells_of_others(space.communicator(), cells);
  for (const Column& column : columns_of(cells))
    solve_column(scene, shapes, pressures, column);
  const unsigned int n = space.dof_handler().get_fe().degree + 1;
  std::vector<double> values(n * space.dof_handler().get_triangulation().n_active_cells());
  for (std::size_t i = 0; i < n_own; ++i)
    std::copy(cells[i].g.begin(), cells[i].g.end(), values.begin() + n * cells[i].number);
  return values;
}

} // namespace rollwave
