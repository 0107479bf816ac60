#include "rollwave/solver/amg_cg.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/memory.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

void clear(const IndexSet& dofs, FieldVector& field) {
  for (const auto dof : dofs)
    if (field.in_local_range(dof))
      field(dof) = 0;
}

/// An operator whose results are zero where degrees of freedom are pinned.
template <typename Operator>
struct Unpinned {
  const Operator& whole;
  const IndexSet& pinned;

  void vmult(FieldVector& result, const FieldVector& field) const {
    whole.vmult(result, field);
    clear(pinned, result);
  }
};

} // namespace

void AmgCg::set_matrix(const AffineConstraints<double>& constraints, const CellMatrices& matrices,
                       RunStatistics& /*statistics*/) {
  preconditioner.reset();
  const IndexSet& owned = space.dof_handler().locally_owned_dofs();
  TrilinosWrappers::SparsityPattern pattern(owned, owned, space.relevant_dofs(),
                                            space.communicator());
  DoFTools::make_sparsity_pattern(space.dof_handler(), pattern, constraints,
                                  /*keep_constrained_dofs=*/false);
  pattern.compress();
  // Measured: 59 bytes with linear elements, 41 with quadratic ones.
  constexpr double bytes_per_entry = 60;
  require_memory(bytes_per_entry * pattern.trilinos_sparsity_pattern().NumMyNonzeros(),
                 "the system matrix with its multigrid hierarchy", space.communicator());
  stiffness.reinit(pattern);
  matrices([&](const auto& dofs, const FullMatrix<double>& cell_matrix) {
    constraints.distribute_local_to_global(cell_matrix, dofs, stiffness);
  });
  stiffness.compress(VectorOperation::add);
}

void AmgCg::pin(const IndexSet& dofs) {
  if (dofs != pinned)
    preconditioner.reset();
  pinned = dofs;
}

FieldVector AmgCg::solve(const FieldVector& rhs, RunStatistics& statistics) {
  constexpr double accuracy = 1e-11;
  FieldVector u = space.make_field();
  const double size = rhs.l2_norm();
  improve(
      u, rhs, [size](const FieldVector&) { return size; }, accuracy, statistics);
  return u;
}

const BoomerAmg& AmgCg::multigrid(RunStatistics& statistics) {
  if (!preconditioner) {
    const RunStatistics::Phase phase(statistics, "preconditioner");
    preconditioner.emplace(stiffness, pinned, space.communicator());
    ++statistics.preconditioners;
  }
  return *preconditioner;
}

double AmgCg::residual_norm(const FieldVector& u, const FieldVector& rhs) const {
  FieldVector residual = space.make_field();
  stiffness.vmult(residual, u);
  residual -= rhs;
  clear(pinned, residual);
  return residual.l2_norm();
}

double AmgCg::improve(FieldVector& u, const FieldVector& rhs, const Scale& scale, double accuracy,
                      RunStatistics& statistics) {
  FieldVector unpinned_rhs = rhs;
  clear(pinned, unpinned_rhs);
  double given = unpinned_rhs.linfty_norm();
  for (const auto dof : pinned)
    if (u.in_local_range(dof))
      given = std::max(given, std::abs(u(dof)));
  if (Utilities::MPI::max(given, space.communicator()) == 0)
    u = 0;
  // The scale may change with u. Besides, over many iterations the residual that conjugate
  // gradients update drifts from the true one. A second start mends both, down to round-off.
  for (double before = std::numeric_limits<double>::max();;) {
    const double norm = residual_norm(u, unpinned_rhs), size = norm > 0 ? scale(u) : 1;
    const double residual = norm / size;
    if (residual <= accuracy || !(residual < before / 2)) // which holds for NaN too
      return residual;
    before = residual;
    iterate(u, unpinned_rhs, accuracy * size, statistics);
  }
}

void AmgCg::iterate(FieldVector& u, const FieldVector& rhs, double wanted,
                    RunStatistics& statistics) {
  constexpr unsigned int most_iterations = 5000;
  SolverControl control(most_iterations, wanted, /*log_history=*/false, /*log_result=*/false);
  try {
    SolverCG<FieldVector>(control).solve(
        Unpinned<TrilinosWrappers::SparseMatrix>{stiffness, pinned}, u, rhs,
        Unpinned<BoomerAmg>{multigrid(statistics), pinned});
  } catch (const SolverControl::NoConvergence&) {
    std::ostringstream message;
    message
        << "conjugate gradients have lowered the residual from " << control.initial_value()
        << " to " << control.last_value() << " in " << control.last_step() << " steps, wanted "
        << wanted
        << "; change Mesh/Radial cells or Mesh/Angular cells to cells that are less stretched, or, "
           "where memory suffices, set Solver/Kind to direct";
    throw NotSolved(message.str());
  }
  statistics.linear_iterations += control.last_step();
}

} // namespace rollwave
