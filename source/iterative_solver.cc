#include "iterative_solver.h"

#include "assembly.h"
#include "errors.h"
#include "memory.h"
#include "scene.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/solver_cg.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

/**
 * The least coupling, over the diagonal entry, that multigrid coarsens along. For linear elements
 * with s = alpha (h_r / h_z)^2 neighbours couple by
 *
 *     |2 - s| / (4 + 4 s) in r,   |1 - 2 s| / (4 + 4 s) in z,   1/8 across the corner,
 *
 * so that 1/4 separates the strong direction from the weak one where cells are stretched. Where
 * they are not, it would leave no coupling at all.
 */
double coarsening_threshold(const RingSpace& space, const Scene& scene) {
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    const double s = scene.alpha(cell->center()[0]) *
                     std::pow(cell->extent_in_direction(0) / cell->extent_in_direction(1), 2);
    if (s > 0.25 && s < 4)
      return 0.05;
  }
  return 0.25;
}

} // namespace

IterativeSolver::IterativeSolver(const RingSpace& space)
    : space(space), pinned_dofs(space.dof_handler().n_dofs()), field(space.make_field()) {}

void IterativeSolver::turn_to(const Scene& scene, const std::optional<FieldVector>& load,
                              Work& work) {
  this->load = &load;
  this->work = &work;
  if (angular_velocity == scene.angular_velocity)
    return;
  const Work::Phase phase(work, "assembly");
  angular_velocity.reset();
  assemble(scene);
  angular_velocity = scene.angular_velocity;
  ++work.stiffness_assemblies;
}

void IterativeSolver::assemble(const Scene& scene) {
  preconditioner.reset();
  threshold = coarsening_threshold(space, scene);
  pinned_dofs.clear();
  const auto& handler = space.dof_handler();
  const auto& constraints = space.constraints();
  DynamicSparsityPattern pattern(handler.n_dofs());
  DoFTools::make_sparsity_pattern(handler, pattern, constraints, /*keep_constrained_dofs=*/false);
  // Measured: 59 bytes with linear elements, 41 with quadratic ones.
  constexpr double bytes_per_entry = 60;
  require_memory(bytes_per_entry * pattern.n_nonzero_elements(),
                 "the stiffness matrix with its multigrid hierarchy");
  matrix.reinit(handler.locally_owned_dofs(), pattern, field.get_mpi_communicator());
  assemble_stiffness(space, scene, [&](const auto& dofs, const FullMatrix<double>& cell_matrix) {
    constraints.distribute_local_to_global(cell_matrix, dofs, matrix);
  });
  matrix.compress(VectorOperation::add);

  contact_rows.clear();
  for (const SurfaceNode& node : space.contact_nodes()) {
    contact_rows.emplace_back();
    for (auto entry = pattern.begin(node.dof); entry != pattern.end(node.dof); ++entry)
      contact_rows.back().emplace_back(entry->column(), matrix.el(node.dof, entry->column()));
  }
}

void IterativeSolver::pin(const std::vector<bool>& pinned) {
  IndexSet dofs(pinned_dofs.size());
  for (unsigned int i = 0; i < pinned.size(); ++i)
    if (pinned[i])
      dofs.add_index(space.contact_nodes()[i].dof);
  dofs.compress();
  if (dofs == pinned_dofs)
    return;
  preconditioner.reset();
  pinned_dofs = dofs;
  for (unsigned int i = 0; i < contact_rows.size(); ++i) {
    const auto row = space.contact_nodes()[i].dof;
    for (const auto& [column, value] : contact_rows[i]) {
      const bool is_left = row == column || !(is_pinned(row) || is_pinned(column));
      matrix.set(row, column, is_left ? value : 0.);
      matrix.set(column, row, is_left ? value : 0.);
    }
  }
  matrix.compress(VectorOperation::insert);
}

double IterativeSolver::reaction(unsigned int node, const FieldVector& u) const {
  double force = *load ? (**load)(space.contact_nodes()[node].dof) : 0.;
  for (const auto& [column, value] : contact_rows[node])
    force -= value * u(column);
  return force;
}

const TrilinosWrappers::PreconditionAMG& IterativeSolver::multigrid() {
  if (!preconditioner) {
    const Work::Phase phase(*work, "preconditioner");
    TrilinosWrappers::PreconditionAMG::AdditionalData settings;
    settings.higher_order_elements = space.dof_handler().get_fe().degree > 1;
    settings.aggregation_threshold = threshold;
    // The hierarchy before and the assembly leave free memory in pieces.
    release_freed_memory();
    preconditioner.emplace();
    preconditioner->initialize(matrix, settings);
    ++work->preconditioners;
  }
  return *preconditioner;
}

double IterativeSolver::relative_residual(const FieldVector& u, const FieldVector& rhs,
                                          const Scale& scale) const {
  FieldVector residual = space.make_field();
  matrix.vmult(residual, u);
  residual -= rhs;
  const double norm = residual.l2_norm();
  return norm == 0 ? 0 : norm / scale(u);
}

double IterativeSolver::improve(FieldVector& u, const FieldVector& rhs, const Scale& scale,
                                double accuracy) {
  if (rhs.all_zero())
    u = 0;
  double residual = relative_residual(u, rhs, scale);
  // Over many iterations the residual that conjugate gradients update drifts from the true one; a
  // second start mends that, down to round-off.
  for (double before = std::numeric_limits<double>::max();
       residual > accuracy && residual < before / 2;) {
    before = residual;
    conjugate_gradients(u, rhs, scale, accuracy);
    residual = relative_residual(u, rhs, scale);
  }
  return residual;
}

void IterativeSolver::conjugate_gradients(FieldVector& u, const FieldVector& rhs,
                                          const Scale& scale, double accuracy) {
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
    solver.solve(matrix, u, rhs, multigrid());
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
  work->linear_iterations += control.last_step();
}

double IterativeSolver::solve(const std::vector<bool>& pinned, ContactState& state,
                              double accuracy) {
  const auto& nodes = space.contact_nodes();
  AssertDimension(pinned.size(), nodes.size());
  pin(pinned);

  FieldVector rhs = *load ? **load : space.make_field();
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (!pinned[i])
      rhs(nodes[i].dof) -= state.force(i);
    else {
      field(nodes[i].dof) = state.displacement(i);
      for (const auto& [column, value] : contact_rows[i])
        if (!is_pinned(column))
          rhs(column) -= value * state.displacement(i);
        else if (column == nodes[i].dof)
          rhs(column) = value * state.displacement(i);
    }

  const double load_norm = *load ? (*load)->l2_norm() : 0.;
  const auto scale = [&](const FieldVector& u) {
    double squared = 0;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      squared += std::pow(pinned[i] ? reaction(i, u) : state.force(i), 2);
    return std::max(load_norm, std::sqrt(squared));
  };
  const double residual = improve(field, rhs, scale, accuracy);

  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (pinned[i])
      state.force(i) = reaction(i, field);
    else
      state.displacement(i) = field(nodes[i].dof);
  return residual;
}

Vector<double> IterativeSolver::response(const Vector<double>& force, double accuracy) {
  const auto& nodes = space.contact_nodes();
  pin(std::vector<bool>(nodes.size(), false));
  FieldVector rhs = space.make_field(), u = space.make_field();
  for (unsigned int i = 0; i < nodes.size(); ++i)
    rhs(nodes[i].dof) = force(i);
  conjugate_gradients(
      u, rhs, [&](const FieldVector&) { return force.l2_norm(); }, accuracy);
  Vector<double> displacement(nodes.size());
  for (unsigned int i = 0; i < nodes.size(); ++i)
    displacement(i) = u(nodes[i].dof);
  return displacement;
}

FieldVector IterativeSolver::displacement_field(const ContactState& /*state*/) {
  FieldVector u = field;
  space.constraints().distribute(u);
  return u;
}

FieldVector IterativeSolver::apply(const FieldVector& u) const {
  FieldVector product = space.make_field();
  matrix.vmult(product, u);
  // What the matrix lacks: the couplings of pinned nodes.
  for (unsigned int i = 0; i < contact_rows.size(); ++i) {
    const auto row = space.contact_nodes()[i].dof;
    if (is_pinned(row))
      for (const auto& [column, value] : contact_rows[i])
        if (column != row) {
          product(row) += value * u(column);
          if (!is_pinned(column))
            product(column) += value * u(row);
        }
  }
  space.constraints().set_zero(product);
  return product;
}

} // namespace rollwave
