#include "rollwave/solver/elimination_order.h"

#include <deal.II/base/mpi.h>

#include <set>

namespace rollwave {

using namespace dealii;

namespace {

using Dofs = std::vector<types::global_dof_index>;

/// For each local index, whether values on the cells of this process depend on this unknown.
std::vector<bool> find_unknowns_of_cells(const RingSpace& space,
                                         const AffineConstraints<double>& constraints) {
  std::vector<bool> is_of_cells(space.n_local());
  for (const auto dof : space.elimination_order()) {
    const auto* const entries = constraints.get_constraint_entries(dof);
    if (!entries)
      is_of_cells[space.local_index(dof)] = true;
    else
      for (const auto& [unknown, weight] : *entries)
        is_of_cells[space.local_index(unknown)] = true;
  }
  return is_of_cells;
}

/// The unknowns on which cells of several processes depend, in the same order on all processes.
Dofs find_interface(const RingSpace& space, const std::vector<bool>& is_of_cells) {
  FieldVector n_processes = space.make_field();
  for (unsigned int i = 0; i < is_of_cells.size(); ++i)
    n_processes.local_element(i) = is_of_cells[i];
  n_processes.compress(VectorOperation::add);
  Dofs own, interface;
  for (const auto dof : space.dof_handler().locally_owned_dofs())
    if (n_processes(dof) > 1)
      own.push_back(dof);
  for (const Dofs& dofs : Utilities::MPI::all_gather(space.communicator(), own))
    interface.insert(interface.end(), dofs.begin(), dofs.end());
  return interface;
}

} // namespace

EliminationOrder::EliminationOrder(const RingSpace& space,
                                   const AffineConstraints<double>& constraints,
                                   const std::vector<SurfaceNode>& contact_nodes)
    : unknown_of_dof(space.n_local(), -1) {
  const std::vector<bool> is_of_cells = find_unknowns_of_cells(space, constraints);
  std::set<types::global_dof_index> contact_dofs;
  for (const SurfaceNode& node : contact_nodes)
    contact_dofs.insert(node.dof);
  Dofs kept_by_all;
  for (const auto dof : find_interface(space, is_of_cells))
    if (contact_dofs.count(dof) == 0)
      kept_by_all.push_back(dof);
  for (const SurfaceNode& node : contact_nodes)
    kept_by_all.push_back(node.dof);
  n_kept_by_all = kept_by_all.size();

  constexpr int none = -1, last = -2;
  for (int k = 0; k < n_kept_by_all; ++k)
    if (const auto dof = kept_by_all[k];
        space.relevant_dofs().is_element(dof) && is_of_cells[space.local_index(dof)]) {
      unknown_of_dof[space.local_index(dof)] = last;
      kept.push_back(k);
    }
  for (const auto dof : space.elimination_order())
    if (int& unknown = unknown_of_dof[space.local_index(dof)];
        unknown == none && !constraints.is_constrained(dof))
      unknown = n_unknowns++;
  for (const int k : kept)
    unknown_of_dof[space.local_index(kept_by_all[k])] = n_unknowns++;
}

} // namespace rollwave
