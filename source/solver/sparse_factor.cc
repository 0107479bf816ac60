#include "rollwave/solver/sparse_factor.h"

#include "rollwave/base/run_statistics.h"

#include <utility>

namespace rollwave {

using namespace dealii;

SparseFactor::SparseFactor(const RingSpace& space, EliminationOrder order, CholmodFactor own,
                           Vector<double> shift)
    : space(space), order(std::move(order)), own(std::move(own)), added(std::move(shift)) {}

Vector<double> SparseFactor::condense(const FieldVector& rhs, RunStatistics& statistics) const {
  if (kept().size() == 0)
    return {};
  ++statistics.sparse_solves;
  return own.condense(gather(rhs, rhs.locally_owned_size()));
}

FieldVector SparseFactor::expand(const FieldVector* rhs, const Vector<double>& kept,
                                 RunStatistics& statistics) const {
  ++statistics.sparse_solves;
  const std::vector<double> x =
      own.solve(rhs ? gather(*rhs, rhs->locally_owned_size()) : std::vector<double>(), kept);
  FieldVector field = space.make_field();
  for (unsigned int i = 0; i < field.locally_owned_size(); ++i)
    if (order.unknown_of_dof[i] >= 0)
      field.local_element(i) = x[order.unknown_of_dof[i]];
  return field;
}

FieldVector SparseFactor::apply(const FieldVector& x) const {
  FieldVector with_ghosts = x;
  with_ghosts.update_ghost_values();
  const std::vector<double> values = gather(with_ghosts, space.n_local());
  std::vector<double> products = own.multiply(values);
  for (unsigned int k = 0, i = order.n_unknowns - added.size(); k < added.size(); ++k, ++i)
    products[i] -= added(k) * values[i];
  FieldVector field = space.make_field();
  for (unsigned int i = 0; i < space.n_local(); ++i)
    if (order.unknown_of_dof[i] >= 0)
      field.local_element(i) = products[order.unknown_of_dof[i]];
  field.compress(VectorOperation::add);
  return field;
}

std::vector<double> SparseFactor::gather(const FieldVector& field, unsigned int n_local) const {
  std::vector<double> values(order.n_unknowns);
  for (unsigned int i = 0; i < n_local; ++i)
    if (order.unknown_of_dof[i] >= 0)
      values[order.unknown_of_dof[i]] = field.local_element(i);
  return values;
}

} // namespace rollwave
