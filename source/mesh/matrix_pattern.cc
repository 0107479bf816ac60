#include "rollwave/mesh/matrix_pattern.h"

#include "rollwave/base/mpi_processes.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

namespace rollwave {

using namespace dealii;

std::unique_ptr<TrilinosWrappers::SparsityPattern>
make_matrix_pattern(const DoFHandler<2>& handler, const AffineConstraints<double>& constraints,
                    const IndexSet& relevant) {
  const IndexSet& owned = handler.locally_owned_dofs();
  const MPI_Comm communicator = handler.get_communicator();
  DynamicSparsityPattern entries(handler.n_dofs(), handler.n_dofs(), relevant);
  DoFTools::make_sparsity_pattern(handler, entries, constraints, /*keep_constrained_dofs=*/false);
  if (!is_alone(communicator))
    SparsityTools::distribute_sparsity_pattern(entries, owned, communicator, relevant);
  auto pattern = std::make_unique<TrilinosWrappers::SparsityPattern>();
  pattern->reinit(owned, owned, entries, communicator);
  return pattern;
}

} // namespace rollwave
