#include "angular_bubbles.h"

#include "banded_matrix.h"
#include "scene.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/solver_cg.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

using Cell = DoFHandler<2>::active_cell_iterator;

/// Whether the neighbour of a cell over its face @p f towards the hub or the surface is as long.
bool has_equal_neighbour(const Cell& cell, unsigned int f) {
  if (cell->at_boundary(f))
    return false;
  const auto neighbour = cell->neighbor(f);
  return neighbour->level() == cell->level() && neighbour->is_active();
}

/// Whether a process has the neighbour over the face @p f too, and it is as long.
bool has_own_neighbour(const Cell& cell, unsigned int f) {
  return has_equal_neighbour(cell, f) && cell->neighbor(f)->is_locally_owned();
}

/// The number on a cell, the radial index running fastest, of the node that carries g at the radial
/// node @p i: neighbours over a radial line have it in common, neighbours in z do not.
unsigned int carrier(unsigned int i, unsigned int n) {
  return n > 2 ? i + n : i;
}

/// What is nearest to @p wanted among the m with lambda + m P >= 0 for sure: coefficients over
/// Bernstein's polynomials B_k are positive, those of P are (-1)^(p + k) binomial(p, k) (2 p +
/// 1)^(1/2), those of lambda lie on a line. There are such m for all that edge_pressures() returns.
double nearest_mode(const EdgePressure& pressure, unsigned int degree, double wanted) {
  double nearest = wanted, binomial = 1;
  for (unsigned int k = 0; k <= degree; ++k) {
    const double of_mode = (degree + k) % 2 ? -binomial * std::sqrt(2 * degree + 1.)
                                            : binomial * std::sqrt(2 * degree + 1.);
    const double limit = pressure(1. * k / degree) / -of_mode;
    nearest = of_mode < 0 ? std::min(nearest, limit) : std::max(nearest, limit);
    binomial *= 1. * (degree - k) / (k + 1);
  }
  return nearest;
}

/// Integrals over t of the polynomials of a degree, by Gauss' rule.
struct AngularIntegrals {
  explicit AngularIntegrals(unsigned int degree) : gauss(degree + 2), bubble_of(degree + 1) {
    const auto mode = AngularBubbles::mode(degree), bubble = mode.primitive();
    const auto lagrange = lobatto_lagrange(degree);
    for (unsigned int q = 0; q < gauss.size(); ++q) {
      const double t = gauss.point(q)[0], weight = gauss.weight(q);
      weighted_mode.push_back(weight * mode.value(t));
      bubble_square += weight * bubble.value(t) * bubble.value(t);
      for (unsigned int j = 0; j <= degree; ++j)
        bubble_of[j] += weight * bubble.value(t) * lagrange[j].value(t);
    }
  }

  QGauss<1> gauss;
  std::vector<double> weighted_mode; ///< P at the points, times their weights
  double bubble_square = 0;          ///< int beta^2 dt
  std::vector<double> bubble_of;     ///< int beta L_j dt
};

/**
 * The quadratic form int (h_z beta g_s)^2 ds dz + int (P g)^2 / r dr dz on the columns of cells
 * that a process has. A column goes from the hub outwards as far as cells of one length follow each
 * other; the values of g in it are rows of a banded matrix, one column after another.
 */
class ColumnForm {
public:
  /// @param zero a field that is zero
  ColumnForm(FieldVector zero, unsigned int degree)
      : zero(std::move(zero)), degree(degree), matrix(degree), inverse(degree) {}

  /// @param place of a value of g among a field's own and ghost values
  void begin_column(unsigned int place) {
    matrix.grow(1);
    places.push_back(place);
  }

  /// The next cell of the column, with the places of its degree + 1 values of g.
  void add_cell(const ShapeProducts& radial, double length, double bubble_square,
                const std::vector<unsigned int>& cell_places) {
    const unsigned int first = last_row();
    matrix.grow(degree);
    places.insert(places.end(), cell_places.begin() + 1, cell_places.end());
    for (unsigned int i = 0; i <= degree; ++i)
      for (unsigned int k = i; k <= degree; ++k)
        matrix(first + i, k - i) +=
            length * (length * length * bubble_square * radial.stiffness(i, k) + radial.mass(i, k));
  }

  unsigned int last_row() const { return places.size() - 1; }

  /// Keeps g = 0 in a row; after factorise() in the last one of a column.
  void fix(unsigned int row) {
    matrix.clear(row);
    if (inverse.size() > 0)
      inverse.clear(row);
  }

  /// Another process has the rest of the column.
  void cut(unsigned int row) { cuts.push_back(row); }

  /// At each place the sum of what the rows of all processes have for it.
  FieldVector add_up(const std::vector<double>& rows) const {
    FieldVector sum = zero;
    for (unsigned int row = 0; row < rows.size(); ++row)
      sum.local_element(places[row]) += rows[row];
    sum.compress(VectorOperation::add);
    return sum;
  }

  /// Prepares precondition(), when all columns are there.
  void factorise() {
    inverse = matrix;
    is_whole = Utilities::MPI::sum(cuts.size(), zero.get_mpi_communicator()) == 0;
    if (!is_whole) {
      std::vector<double> diagonal(places.size());
      for (unsigned int row = 0; row < places.size(); ++row)
        diagonal[row] = matrix(row, 0);
      const std::vector<double> whole_diagonal = rows_of(add_up(diagonal));
      for (const unsigned int row : cuts) {
        inverse.clear(row);
        inverse(row, 0) = 2 * whole_diagonal[row]; // the other process adds as much
      }
    }
    inverse.factorise();
  }

  /// The minimiser for a load, to 1e-8 of it where columns are cut.
  FieldVector solve(const FieldVector& load) const;

  void vmult(FieldVector& result, const FieldVector& g) const {
    result = add_up(matrix.multiply(rows_of(g)));
  }

  /// The inverse of the form without what ties rows at cuts to others: the inverse itself where a
  /// process has whole columns.
  void precondition(FieldVector& result, const FieldVector& g) const {
    result = add_up(inverse.solve(rows_of(g)));
  }

  /// What a field has for each row.
  std::vector<double> rows_of(const FieldVector& field) const {
    field.update_ghost_values();
    std::vector<double> rows;
    rows.reserve(places.size());
    for (const unsigned int place : places)
      rows.push_back(field.local_element(place));
    field.zero_out_ghost_values();
    return rows;
  }

private:
  const FieldVector zero;
  const unsigned int degree;
  std::vector<unsigned int> places; ///< of the rows
  std::vector<unsigned int> cuts;
  bool is_whole = true; ///< no process has cuts
  BandedMatrix matrix, inverse;
};

/// As deal.II's solvers ask for it.
struct ColumnPreconditioner {
  const ColumnForm& form;
  void vmult(FieldVector& result, const FieldVector& g) const { form.precondition(result, g); }
};

FieldVector ColumnForm::solve(const FieldVector& load) const {
  FieldVector g = zero;
  if (is_whole)
    precondition(g, load);
  else {
    IterationNumberControl control(100, 1e-8 * load.l2_norm());
    SolverCG<FieldVector>(control).solve(*this, g, load, ColumnPreconditioner{*this});
  }
  return g;
}

/// Form and load of D(tau) as a function of g.
class ColumnAssembler {
public:
  ColumnAssembler(const RingSpace& space, const Scene& scene, RadialShapesOfMesh& shapes,
                  const FieldVector& potential, const std::vector<EdgePressure>& pressures,
                  ForceColumns* columns)
      : form(space.make_field(), space.dof_handler().get_fe().degree), space(space), scene(scene),
        shapes(shapes), potential(potential), pressures(pressures), columns(columns),
        degree(space.dof_handler().get_fe().degree), n(degree + 1), integrals(degree),
        numbering(dynamic_cast<const FE_Q<2>&>(space.dof_handler().get_fe())
                      .get_poly_space_numbering_inverse()),
        dofs(n * n), places(n), psi_bubble(n) {
    for (const auto& cell : space.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned() && !has_own_neighbour(cell, 0))
        add_column(cell);
    form.factorise();
  }

  FieldVector load() const { return form.add_up(load_of_row); }

  /// Where pressures can change.
  struct SurfaceRow {
    unsigned int row, edge;
  };

  ColumnForm form;
  std::vector<SurfaceRow> surface_rows;

private:
  /// The column that begins with a cell.
  void add_column(Cell cell) {
    find_places(cell);
    form.begin_column(places[0]);
    load_of_row.push_back(0);
    const unsigned int first_row = form.last_row();
    const bool is_cut_below = has_equal_neighbour(cell, 0);
    const bool is_fixed_below = !cell->at_boundary(0) && !is_cut_below;
    for (;;) {
      add_cell(cell);
      if (!has_own_neighbour(cell, 1))
        break;
      cell = cell->neighbor(1);
      find_places(cell);
    }
    const auto edge = space.surface_face(cell);
    const bool is_cut_above = has_equal_neighbour(cell, 1);
    const bool is_fixed_above = edge ? !(pressures[*edge].mean > 0) : !is_cut_above;
    if (is_fixed_below)
      fix(first_row);
    if (is_fixed_above)
      fix(form.last_row());
    else if (edge)
      surface_rows.push_back({form.last_row(), *edge});
    if (is_cut_below)
      form.cut(first_row);
    if (is_cut_above)
      form.cut(form.last_row());
  }

  void find_places(const Cell& cell) {
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < n; ++i)
      places[i] = potential.get_partitioner()->global_to_local(dofs[numbering[carrier(i, n)]]);
  }

  void fix(unsigned int row) {
    form.fix(row);
    load_of_row[row] = 0;
  }

  void add_cell(const Cell& cell) {
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    const double length = high[1] - low[1];
    const RadialShapes& radial = shapes.on(low[0], high[0]);
    const unsigned int first_row = form.last_row();
    form.add_cell(radial.products, length, integrals.bubble_square, places);
    load_of_row.resize(load_of_row.size() + degree);
    double* const load = &load_of_row[first_row];

    for (unsigned int i = 0; i < n; ++i) {
      psi_bubble[i] = 0;
      for (unsigned int j = 0; j < n; ++j)
        psi_bubble[i] += integrals.bubble_of[j] * potential(dofs[numbering[i + n * j]]);
    }
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int k = 0; k < n; ++k)
        load[i] -= length * length * radial.products.stiffness(i, k) * psi_bubble[k];
    if (columns) {
      ForceAtRadii& at_radii = columns->at_radii(low[0], high[0], radial.r);
      const auto& lines = columns->on(low[1], high[1]);
      for (unsigned int p = 0; p < integrals.gauss.size(); ++p) {
        at_radii.integrals(lines[p], moments);
        for (unsigned int q = 0; q < radial.r.size(); ++q) {
          const double factor =
              length * integrals.weighted_mode[p] * moments[q] / radial.r[q] * radial.weight[q];
          for (unsigned int i = 0; i < n; ++i)
            load[i] += factor * radial.shapes[q][i].potential;
        }
      }
    }
    if (const auto edge = space.surface_face(cell); edge && pressures[*edge].mean > 0) {
      const SurfaceFace& face = space.surface_faces()[*edge];
      for (unsigned int p = 0; p < integrals.gauss.size(); ++p)
        load[degree] -=
            length * integrals.weighted_mode[p] *
            scene.road(face.begin + integrals.gauss.point(p)[0] * (face.end - face.begin));
    }
  }

  const RingSpace& space;
  const Scene& scene;
  RadialShapesOfMesh& shapes;
  const FieldVector& potential;
  const std::vector<EdgePressure>& pressures;
  ForceColumns* const columns;
  const unsigned int degree, n;
  const AngularIntegrals integrals;
  const std::vector<unsigned int> numbering;
  std::vector<double> load_of_row;
  std::vector<types::global_dof_index> dofs; ///< of the cell looked at
  std::vector<unsigned int> places;          ///< of its values of g
  std::vector<double> psi_bubble;
  std::vector<double> moments; ///< G on a line
};

} // namespace

Polynomials::Polynomial<double> AngularBubbles::mode(unsigned int degree) {
  return Polynomials::Legendre(degree);
}

AngularBubbles::AngularBubbles(const RingSpace& space, const Scene& scene,
                               RadialShapesOfMesh& shapes, const FieldVector& potential,
                               const std::vector<EdgePressure>& pressures, ForceColumns* columns)
    : n(space.dof_handler().get_fe().degree + 1), field(space.make_field()) {
  ColumnAssembler assembler(space, scene, shapes, potential, pressures, columns);
  ColumnForm& form = assembler.form;
  const FieldVector load = assembler.load();
  field = form.solve(load);

  // Of a convex function of each column the least with a bound of one value has that value at the
  // bound, and the rest as is best then.
  std::vector<double> g = form.rows_of(field), excess(g.size());
  const double b = scene.outer_radius;
  for (const auto& [row, edge] : assembler.surface_rows)
    excess[row] = g[row] - b * nearest_mode(pressures[edge], n - 1, g[row] / b);
  field -= form.add_up(excess);
  FieldVector residual = space.make_field();
  form.vmult(residual, field);
  residual.sadd(-1, load);
  g = form.rows_of(residual);
  excess.assign(g.size(), 0);
  for (const auto& [row, edge] : assembler.surface_rows) {
    excess[row] = g[row];
    form.fix(row);
  }
  residual -= form.add_up(excess);
  field += form.solve(residual);
  field.update_ghost_values();
}

void AngularBubbles::values(const std::vector<types::global_dof_index>& dofs,
                            std::vector<double>& g) const {
  for (unsigned int i = 0; i < n; ++i)
    g[i] = field(dofs[carrier(i, n)]);
}

} // namespace rollwave
