#include "rollwave/error_bound/column_form.h"

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

} // namespace rollwave
