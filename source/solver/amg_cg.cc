#include "rollwave/solver/amg_cg.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/memory.h"
#include "rollwave/scene/scene.h"

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

/**
 * Along an axis of stretched elements couplings are strong, and multigrid shall coarsen along that
 * axis only. Where it is that of z, s = alpha (h_r / h_z)^2 >> 1, neighbours across the corner of
 * linear elements couple half as strongly as those in z on the surface, and a quarter inside, which
 * a threshold above a half leaves out. On other cells it would leave out too much.
 */
double strong_threshold(const RingSpace& space, const Scene& scene) {
  double most = 0;
  for (const auto& cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned()) {
      const Point<2> low = cell->vertex(0), high = cell->vertex(3);
      const double height = high[0] - low[0], length = high[1] - low[1];
      most = std::max(most, scene.alpha(cell->center()[0]) * std::pow(height / length, 2));
    }
  return Utilities::MPI::max(most, space.communicator()) > 10 ? 0.55 : 0.35;
}

} // namespace

void AmgCg::set_matrix(const Scene& scene, const AffineConstraints<double>& constraints,
                       const RadialProducts& radial, Work& /*work*/) {
  preconditioner.reset();
  threshold = strong_threshold(space, scene);
  const TrilinosWrappers::SparsityPattern& pattern = space.matrix_pattern(constraints);
  // Measured: 59 bytes with linear elements, 41 with quadratic ones.
  constexpr double bytes_per_entry = 60;
  require_memory(bytes_per_entry * pattern.trilinos_sparsity_pattern().NumMyNonzeros(),
                 "the system matrix with its multigrid hierarchy", space.communicator());
  stiffness.reinit(pattern);
  add_cell_matrices(space, radial, [&](const auto& dofs, const FullMatrix<double>& cell_matrix) {
    constraints.distribute_local_to_global(cell_matrix, dofs, stiffness);
  });
  stiffness.compress(VectorOperation::add);
}

// Rather than by deal.II's iterators, which take a time for each row that grows with the matrix.
void AmgCg::visit_row(
    types::global_dof_index row,
    const std::function<void(types::global_dof_index column, double value)>& visit) const {
  const Epetra_CrsMatrix& matrix = stiffness.trilinos_matrix();
  int n = 0;
  double* values = nullptr;
  int* local_columns = nullptr;
  matrix.ExtractMyRowView(matrix.RowMap().LID(static_cast<int>(row)), n, values, local_columns);
  for (int k = 0; k < n; ++k)
    visit(matrix.ColMap().GID(local_columns[k]), values[k]);
}

FieldVector AmgCg::solve(const FieldVector& rhs, Work& work) {
  constexpr double accuracy = 1e-11;
  FieldVector u = space.make_field();
  const double size = rhs.l2_norm();
  improve(
      u, rhs, [size](const FieldVector&) { return size; }, accuracy, work);
  return u;
}

const BoomerAmg& AmgCg::multigrid(Work& work) {
  if (!preconditioner) {
    const Work::Phase phase(work, "preconditioner");
    // The hierarchy before and the assembly leave free memory in pieces.
    release_freed_memory();
    preconditioner.emplace(stiffness, space.communicator(), threshold);
    ++work.preconditioners;
  }
  return *preconditioner;
}

double AmgCg::relative_residual(const FieldVector& u, const FieldVector& rhs,
                                const Scale& scale) const {
  FieldVector residual = space.make_field();
  stiffness.vmult(residual, u);
  residual -= rhs;
  const double norm = residual.l2_norm();
  return norm == 0 ? 0 : norm / scale(u);
}

double AmgCg::improve(FieldVector& u, const FieldVector& rhs, const Scale& scale, double accuracy,
                      Work& work) {
  if (rhs.all_zero())
    u = 0;
  double residual = relative_residual(u, rhs, scale);
  // Over many iterations the residual that conjugate gradients update drifts from the true one; a
  // second start mends that, down to round-off.
  for (double before = std::numeric_limits<double>::max();
       residual > accuracy && residual < before / 2;) {
    before = residual;
    iterate(u, rhs, scale, accuracy, work);
    residual = relative_residual(u, rhs, scale);
  }
  return residual;
}

void AmgCg::iterate(FieldVector& u, const FieldVector& rhs, const Scale& scale, double accuracy,
                    Work& work) {
  // The control accepts every residual, so that the end is up to the slot, which sees the field.
  SolverControl control(std::numeric_limits<unsigned int>::max(),
                        std::numeric_limits<double>::max(), /*log_history=*/false,
                        /*log_result=*/false);
  SolverCG<FieldVector> solver(control);
  constexpr unsigned int most_iterations = 5000;
  solver.connect([&](unsigned int iteration, double residual, const FieldVector& iterate) {
    if (residual <= accuracy * scale(iterate))
      return SolverControl::success;
    return iteration < most_iterations ? SolverControl::iterate : SolverControl::failure;
  });
  try {
    solver.solve(stiffness, u, rhs, multigrid(work));
  } catch (const SolverControl::NoConvergence&) {
    std::ostringstream message;
    message
        << "conjugate gradients have reached the relative residual "
        << relative_residual(u, rhs, scale) << " in " << control.last_step() << " steps, wanted "
        << accuracy
        << "; change Mesh/Radial cells or Mesh/Angular cells to cells that are less stretched, or, "
           "where memory suffices, set Solver/Kind to direct";
    throw NotSolved(message.str());
  }
  work.linear_iterations += control.last_step();
}

} // namespace rollwave
