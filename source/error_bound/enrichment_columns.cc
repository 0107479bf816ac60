#include "rollwave/error_bound/enrichment_columns.h"

#include "rollwave/error_bound/angular_enrichment.h"
#include "rollwave/mesh/lexicographic_dofs.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <deal.II/lac/solver_cg.h>
#include <utility>

namespace rollwave {

using namespace dealii;

void ColumnForm::begin_column(unsigned int place) {
  matrix.grow(1);
  places.push_back(place);
}

void ColumnForm::add_cell(const ShapeProducts& radial, double length, double bubble_square,
                          const std::vector<unsigned int>& cell_places) {
  const unsigned int first = size() - 1;
  matrix.grow(degree);
  places.insert(places.end(), cell_places.begin() + 1, cell_places.end());
  for (unsigned int i = 0; i <= degree; ++i)
    for (unsigned int k = i; k <= degree; ++k)
      matrix(first + i, k - i) +=
          length * (length * length * bubble_square * radial.stiffness(i, k) + radial.mass(i, k));
}

void ColumnForm::fix(unsigned int row) {
  for (BandedMatrix* const each : {&matrix, &inverse})
    if (each->size() > 0)
      each->clear(row);
}

void ColumnForm::factorise() {
  is_whole = Utilities::MPI::sum(cuts.size(), zero.get_mpi_communicator()) == 0;
  if (is_whole)
    std::swap(inverse, matrix); // of which only the factors are needed
  else {
    inverse = matrix;
    std::vector<double> diagonal(size());
    for (unsigned int row = 0; row < size(); ++row)
      diagonal[row] = matrix(row, 0);
    const std::vector<double> whole_diagonal = rows_of(add_up(diagonal));
    for (const unsigned int row : cuts) {
      inverse.clear(row);
      inverse(row, 0) = 2 * whole_diagonal[row]; // the other process adds as much
    }
  }
  inverse.factorise();
}

FieldVector ColumnForm::add_up(const std::vector<double>& rows) const {
  FieldVector sum = zero;
  for (unsigned int row = 0; row < rows.size(); ++row)
    sum.local_element(places[row]) += rows[row];
  sum.compress(VectorOperation::add);
  return sum;
}

std::vector<double> ColumnForm::rows_of(const FieldVector& field) const {
  field.update_ghost_values();
  std::vector<double> rows;
  rows.reserve(places.size());
  for (const unsigned int place : places)
    rows.push_back(field.local_element(place));
  field.zero_out_ghost_values();
  return rows;
}

void ColumnForm::vmult(FieldVector& result, const FieldVector& g) const {
  result = add_up(matrix.multiply(rows_of(g)));
}

FieldVector ColumnForm::precondition(const FieldVector& g) const {
  return add_up(inverse.solve(rows_of(g)));
}

FieldVector ColumnForm::solve(const FieldVector& load) const {
  if (is_whole)
    return precondition(load);
  // As deal.II's solvers ask for it
  struct Preconditioner {
    const ColumnForm& form;
    void vmult(FieldVector& result, const FieldVector& g) const { result = form.precondition(g); }
  };
  FieldVector g = zero;
  IterationNumberControl control(100, 1e-8 * load.l2_norm());
  SolverCG<FieldVector>(control).solve(*this, g, load, Preconditioner{*this});
  return g;
}

FieldVector ColumnForm::follow(std::vector<double> change,
                               const std::vector<unsigned int>& rows) const {
  if (is_whole)
    return add_up(inverse.follow(std::move(change)));
  FieldVector whole_change = add_up(change), load = zero;
  vmult(load, whole_change);
  load *= -1;
  std::vector<double> at_rows(size());
  ColumnForm with_fixed_rows = *this;
  const std::vector<double> load_rows = rows_of(load);
  for (const unsigned int row : rows) {
    at_rows[row] = load_rows[row];
    with_fixed_rows.fix(row);
  }
  load -= add_up(at_rows);
  whole_change += with_fixed_rows.solve(load);
  return whole_change;
}

namespace {

using ColumnCell = DoFHandler<2>::active_cell_iterator;

/// Whether the neighbour of a cell over its face @p f towards the hub or the surface is as long.
bool has_equal_neighbour(const ColumnCell& cell, unsigned int f) {
  if (cell->at_boundary(f))
    return false;
  const auto neighbour = cell->neighbor(f);
  return neighbour->level() == cell->level() && neighbour->is_active();
}

/// Whether a process has the neighbour over the face @p f too, and it is as long.
bool has_own_neighbour(const ColumnCell& cell, unsigned int f) {
  return has_equal_neighbour(cell, f) && cell->neighbor(f)->is_locally_owned();
}

/// int beta^2 dt
double bubble_square(unsigned int degree) {
  const auto bubble = AngularEnrichment::mode(degree).primitive();
  const QGauss<1> gauss(degree + 2);
  double square = 0;
  for (unsigned int q = 0; q < gauss.size(); ++q)
    square += gauss.weight(q) * std::pow(bubble.value(gauss.point(q)[0]), 2);
  return square;
}

} // namespace

unsigned int bubble_carrier(unsigned int i, unsigned int n) {
  return n > 2 ? i + n : i;
}

EnrichmentColumns::EnrichmentColumns(const RingSpace& space, RadialShapesOfMesh& shapes)
    : form(space, space.dof_handler().get_fe().degree),
      first_rows(space.dof_handler().get_triangulation().n_active_cells()) {
  const unsigned int degree = space.dof_handler().get_fe().degree, n = degree + 1;
  const double square = bubble_square(degree);
  const FieldVector field = space.make_field();
  LexicographicDofs dofs(space.dof_handler());
  std::vector<unsigned int> places(n);
  for (ColumnCell cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned() || has_own_neighbour(cell, 0))
      continue;
    const bool is_cut_below = has_equal_neighbour(cell, 0);
    const bool is_fixed_below = !cell->at_boundary(0) && !is_cut_below;
    const unsigned int first_row = form.size();
    for (bool is_first = true;; is_first = false) {
      const auto& of_cell = dofs.of(cell);
      for (unsigned int i = 0; i < n; ++i)
        places[i] = field.get_partitioner()->global_to_local(of_cell[bubble_carrier(i, n)]);
      if (is_first)
        form.begin_column(places[0]);
      const Point<2> low = cell->vertex(0), high = cell->vertex(3);
      first_rows[cell->active_cell_index()] = form.size() - 1;
      form.add_cell(shapes.on(low[0], high[0]).products, high[1] - low[1], square, places);
      if (!has_own_neighbour(cell, 1))
        break;
      cell = cell->neighbor(1);
    }
    const unsigned int last_row = form.size() - 1;
    const bool is_cut_above = has_equal_neighbour(cell, 1);
    if (is_fixed_below)
      fixed_rows.push_back(first_row);
    if (is_cut_below)
      form.cut(first_row);
    if (const auto edge = space.surface_face(cell))
      surface_rows.push_back({last_row, *edge});
    else if (is_cut_above)
      form.cut(last_row);
    else
      fixed_rows.push_back(last_row);
  }
  for (const unsigned int row : fixed_rows)
    form.fix(row);
  form.factorise();
}

} // namespace rollwave
