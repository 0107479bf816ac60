#include "rollwave/solver/sparse_factor.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/memory.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/run_statistics.h"

#include <deal.II/base/mpi.h>

#include <functional>
#include <new>
#include <string>
#include <utility>

namespace rollwave {

using namespace dealii;

SystemMatrix::SystemMatrix(const RingSpace& space, const AffineConstraints<double>& constraints,
                           const std::vector<SurfaceNode>& contact_nodes)
    : space(space), constraints(constraints), n_contact_nodes(contact_nodes.size()),
      order(space, constraints, contact_nodes),
      combinations(space.dof_handler().get_fe().n_dofs_per_cell()) {
  const std::size_t n = combinations.size();
  triplets.reserve(n * (n + 1) / 2 * space.dof_handler().get_triangulation().n_active_cells());
}

void SystemMatrix::add(const std::vector<types::global_dof_index>& dofs,
                       const FullMatrix<double>& cell_matrix) {
  const auto unknown_of = [&](auto dof) { return order.unknown_of_dof[space.local_index(dof)]; };
  for (unsigned int i = 0; i < dofs.size(); ++i) {
    combinations[i].clear();
    if (const int unknown = unknown_of(dofs[i]); unknown >= 0)
      combinations[i].emplace_back(unknown, 1.);
    else
      for (const auto& [dof, weight] : *constraints.get_constraint_entries(dofs[i]))
        combinations[i].emplace_back(unknown_of(dof), weight);
  }
  for (unsigned int i = 0; i < dofs.size(); ++i)
    for (unsigned int j = 0; j < dofs.size(); ++j)
      for (const auto& [row, row_weight] : combinations[i])
        for (const auto& [column, column_weight] : combinations[j])
          if (row >= column)
            triplets.add(row, column, row_weight * column_weight * cell_matrix(i, j));
}

namespace {

/// Does some work on all processes. Where it fails on one, all of them throw.
/// @throws NotSolved, NotEnoughMemory
void do_on_all(MPI_Comm communicator, const std::function<void()>& work) {
  std::string shortage, failure;
  try {
    work();
  } catch (const std::bad_alloc&) {
    shortage = "the factor needs more memory than there is";
  } catch (const NotEnoughMemory& error) {
    shortage = error.reason;
  } catch (const NotSolved& error) {
    failure = error.what();
  }
  if (shortage = first_text(communicator, shortage); !shortage.empty())
    throw NotEnoughMemory(shortage);
  if (failure = first_text(communicator, failure); !failure.empty())
    throw NotSolved(failure);
}

/// Doubles the diagonal of the last unknowns, and returns what it has added. The cells of a process
/// may lie away from the hub, and then their Schur complement is singular. With this shift it has a
/// factor. To subtract the shift again costs no more digits than the elimination does.
Vector<double> shift_diagonal(LowerTriplets& triplets, int n_unknowns, int n_last) {
  Vector<double> shift(n_last);
  const int first = n_unknowns - n_last;
  for (std::size_t k = 0; k < triplets.values.size(); ++k)
    if (triplets.rows[k] == triplets.columns[k] && triplets.rows[k] >= first)
      shift(triplets.rows[k] - first) += triplets.values[k];
  for (int k = 0; k < n_last; ++k)
    triplets.add(first + k, first + k, shift(k));
  return shift;
}

/// The lower triangle of S_p of this process, by the numbers of the unknowns that all keep.
LowerTriplets schur_complement(const EliminationOrder& order, const CholmodFactor& own,
                               const Vector<double>& shift) {
  const unsigned int m = order.kept.size();
  LAPACKFullMatrix<double> schur(m);
  if (m > 0) {
    const LAPACKFullMatrix<double> lower = own.schur_factor();
    lower.mTmult(schur, lower);
  }
  LowerTriplets triplets;
  triplets.reserve(m * (m + 1) / 2);
  for (unsigned int j = 0; j < m; ++j)
    for (unsigned int i = j; i < m; ++i)
      triplets.add(order.kept[i], order.kept[j], schur(i, j) - (i == j ? shift(i) : 0));
  return triplets;
}

/// The values of all processes in the order of their ranks. Every process gets them.
template <typename T>
std::vector<T> concatenate(MPI_Comm communicator, const std::vector<T>& own) {
  const std::vector<int> sizes = Utilities::MPI::all_gather(communicator, int(own.size()));
  std::vector<int> begins = {0};
  for (const int size : sizes)
    begins.push_back(begins.back() + size);
  std::vector<T> all(begins.back());
  const MPI_Datatype type = Utilities::MPI::mpi_type_id_for_type<T>;
  MPI_Allgatherv(own.data(), own.size(), type, all.data(), sizes.data(), begins.data(), type,
                 communicator);
  return all;
}

/// The sum of the Schur complements of all processes, factorised.
CholmodFactor join_factors(const EliminationOrder& order, const CholmodFactor& own,
                           const Vector<double>& shift, int n_contact_nodes,
                           MPI_Comm communicator) {
  const LowerTriplets triplets = schur_complement(order, own, shift);
  const std::string purpose = "the problem of " + std::to_string(order.n_kept_by_all) +
                              " unknowns in contact or between processes";
  constexpr double bytes_of_entry = 2 * (2 * sizeof(int) + sizeof(double)); // CHOLMOD has a copy
  require_memory(bytes_of_entry * Utilities::MPI::sum<double>(triplets.values.size(), communicator),
                 purpose, communicator);
  CholmodFactor joined(order.n_kept_by_all, n_contact_nodes);
  joined.set_matrix({concatenate(communicator, triplets.rows),
                     concatenate(communicator, triplets.columns),
                     concatenate(communicator, triplets.values)});
  require_memory(sizeof(double) * joined.n_factor_entries(), purpose, communicator);
  joined.factorise();
  return joined;
}

} // namespace

std::unique_ptr<const SparseFactor> SystemMatrix::factorise(RunStatistics& statistics) {
  const MPI_Comm communicator = space.communicator();
  const bool is_alone = is_serial(communicator);
  const int n = order.n_unknowns, n_kept = order.kept.size();
  const Vector<double> shift =
      is_alone ? Vector<double>(n_kept) : shift_diagonal(triplets, n, n_kept);
  CholmodFactor own(n, n_kept);
  // The triplets' memory is free after it.
  do_on_all(communicator, [&] { own.set_matrix(std::exchange(triplets, {})); });
  ++statistics.orderings;
  require_memory(sizeof(double) * own.n_factor_entries(),
                 "the factor for " + std::to_string(n) + " unknowns", communicator);
  do_on_all(communicator, [&] { own.factorise(); });
  ++statistics.factorisations;
  std::optional<CholmodFactor> joined;
  if (!is_alone)
    joined.emplace(join_factors(order, own, shift, n_contact_nodes, communicator));
  return std::make_unique<SparseFactor>(space, std::move(order), std::move(own), shift,
                                        std::move(joined));
}

SparseFactor::SparseFactor(const RingSpace& space, EliminationOrder order, CholmodFactor own,
                           Vector<double> shift, std::optional<CholmodFactor> joined)
    : space(space), order(std::move(order)), own(std::move(own)), shift(std::move(shift)),
      joined(std::move(joined)) {}

FieldVector SparseFactor::solve(const FieldVector* rhs, const Vector<double>& contact_values,
                                RunStatistics& statistics) const {
  ++statistics.sparse_solves;
  const std::vector<double> own_rhs =
      rhs ? gather(*rhs, rhs->locally_owned_size()) : std::vector<double>();
  Vector<double> kept = contact_values;
  if (joined) {
    const std::vector<double> of_all =
        joined->solve(rhs ? join(own.condense(own_rhs)) : std::vector<double>(), contact_values);
    kept.reinit(order.kept.size());
    for (unsigned int k = 0; k < order.kept.size(); ++k)
      kept(k) = of_all[order.kept[k]];
  }
  const std::vector<double> x = own.solve(own_rhs, kept);
  FieldVector field = space.make_field();
  for (unsigned int i = 0; i < field.locally_owned_size(); ++i)
    if (order.unknown_of_dof[i] >= 0)
      field.local_element(i) = x[order.unknown_of_dof[i]];
  return field;
}

Vector<double> SparseFactor::condense(const FieldVector& rhs, RunStatistics& statistics) const {
  ++statistics.sparse_solves;
  const Vector<double> condensed = own.condense(gather(rhs, rhs.locally_owned_size()));
  return joined ? joined->condense(join(condensed)) : condensed;
}

FieldVector SparseFactor::apply(const FieldVector& x) const {
  FieldVector with_ghosts = x;
  with_ghosts.update_ghost_values();
  const std::vector<double> values = gather(with_ghosts, space.n_local());
  std::vector<double> products = own.multiply(values);
  for (unsigned int k = 0, i = order.n_unknowns - shift.size(); k < shift.size(); ++k, ++i)
    products[i] -= shift(k) * values[i];
  FieldVector field = space.make_field();
  for (unsigned int i = 0; i < space.n_local(); ++i)
    if (order.unknown_of_dof[i] >= 0)
      field.local_element(i) = products[order.unknown_of_dof[i]];
  field.compress(VectorOperation::add);
  return field;
}

LAPACKFullMatrix<double> SparseFactor::schur_factor() const {
  return (joined ? *joined : own).schur_factor();
}

std::vector<double> SparseFactor::gather(const FieldVector& field, unsigned int n_local) const {
  std::vector<double> values(order.n_unknowns);
  for (unsigned int i = 0; i < n_local; ++i)
    if (order.unknown_of_dof[i] >= 0)
      values[order.unknown_of_dof[i]] = field.local_element(i);
  return values;
}

std::vector<double> SparseFactor::join(const Vector<double>& condensed) const {
  std::vector<double> sum(order.n_kept_by_all);
  for (unsigned int k = 0; k < order.kept.size(); ++k)
    sum[order.kept[k]] = condensed(k);
  Utilities::MPI::sum(sum, space.communicator(), sum);
  return sum;
}

} // namespace rollwave
