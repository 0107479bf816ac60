#include "rollwave/solver/elimination_order.h"

#include "rollwave/base/mpi_processes.h"

#include <deal.II/base/mpi.h>

#include <cmath>
#include <map>

namespace rollwave {

using namespace dealii;

namespace {

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

/// Numbers the unknowns on which cells of several processes depend: those of each process one after
/// the other. Sets KeptUnknowns::own_rows.
/// @return for the interface of this process the local index of each number
std::map<types::global_dof_index, unsigned int>
number_interface(const RingSpace& space, const std::vector<bool>& is_of_cells, IndexSet& own_rows) {
  FieldVector number = space.make_field(); // of processes, then in the interface from 1 on
  const unsigned int n_owned = number.locally_owned_size();
  for (unsigned int i = 0; i < is_of_cells.size(); ++i)
    number.local_element(i) = is_of_cells[i];
  number.compress(VectorOperation::add);
  types::global_dof_index n_own = 0;
  for (unsigned int i = 0; i < n_owned; ++i)
    number.local_element(i) = number.local_element(i) > 1 ? ++n_own : 0;
  own_rows = Utilities::MPI::create_ascending_partitioning(
      space.communicator(), n_own)[process_number(space.communicator())];
  const auto first = n_own > 0 ? own_rows.nth_index_in_set(0) : 0;
  for (unsigned int i = 0; i < n_owned; ++i)
    if (number.local_element(i) > 0)
      number.local_element(i) += first;
  number.update_ghost_values();
  std::map<types::global_dof_index, unsigned int> indices;
  for (unsigned int i = 0; i < is_of_cells.size(); ++i)
    if (is_of_cells[i] && number.local_element(i) > 0)
      indices[std::lround(number.local_element(i)) - 1] = i;
  return indices;
}

} // namespace

EliminationOrder::EliminationOrder(const RingSpace& space,
                                   const AffineConstraints<double>& constraints,
                                   const std::vector<SurfaceNode>& contact_nodes)
    : unknown_of_dof(space.n_local(), -1) {
  const std::vector<bool> is_of_cells = find_unknowns_of_cells(space, constraints);
  std::map<types::global_dof_index, unsigned int> interface; // local indices by numbers
  if (!is_serial(space.communicator()))
    interface = number_interface(space, is_of_cells, kept.own_rows);

  std::vector<unsigned int> last; // local indices
  std::vector<int> contact_node(space.n_local(), -1);
  constexpr int none = -1, is_last = -2;
  for (const auto& [row, i] : interface)
    unknown_of_dof[i] = is_last;
  for (unsigned int node = 0; node < contact_nodes.size(); ++node) {
    if (!space.relevant_dofs().is_element(contact_nodes[node].dof))
      continue;
    const unsigned int i = space.local_index(contact_nodes[node].dof);
    contact_node[i] = node;
    if (is_of_cells[i] && unknown_of_dof[i] == none) {
      unknown_of_dof[i] = is_last;
      last.push_back(i);
    }
  }
  kept.n_inner = last.size();
  for (const auto& [row, i] : interface) {
    last.push_back(i);
    kept.rows.push_back(row);
  }
  for (const auto dof : space.elimination_order())
    if (int& unknown = unknown_of_dof[space.local_index(dof)];
        unknown == none && !constraints.is_constrained(dof))
      unknown = n_unknowns++;
  for (const unsigned int i : last) {
    unknown_of_dof[i] = n_unknowns++;
    kept.contact_nodes.push_back(contact_node[i]);
  }
}

} // namespace rollwave
