#include "rollwave/solver/condensed_system.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/memory.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/solver/interface_solver.h"
#include "rollwave/solver/sparse_factor.h"

#include <deal.II/lac/exceptions.h>

#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace rollwave {

using namespace dealii;

/// The Cholesky factor of S_FF.
struct CondensedSystem::Factor {
  std::vector<bool> is_given;
  std::vector<unsigned int> free; ///< F
  LAPACKFullMatrix<double> lower; ///< L with L L^T = S_FF; not made where F is all inner unknowns
};

namespace {

/// Copies a lower triangle. deal.II's copies forget that it is one.
void copy_triangle(const LAPACKFullMatrix<double>& from, unsigned int n,
                   LAPACKFullMatrix<double>& to) {
  to.reinit(n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = j; i < n; ++i)
      to(i, j) = from(i, j);
  to.set_property(LAPACKSupport::lower_triangular);
}

/// @throws NotSolved where the matrix is not positive definite in floating-point arithmetic
void factorise_dense(LAPACKFullMatrix<double>& matrix) {
  matrix.set_property(LAPACKSupport::symmetric);
  try {
    matrix.compute_cholesky_factorization();
  } catch (const LACExceptions::ExcSingular&) {
    throw NotSolved("the matrix of the contact nodes is not positive definite in floating-point "
                    "arithmetic; use cells that are less stretched");
  }
}

/// The unknowns of one process all of which are contact nodes.
KeptUnknowns only_contact_nodes(unsigned int n) {
  KeptUnknowns unknowns;
  unknowns.n_inner = n;
  unknowns.contact_nodes.resize(n);
  std::iota(unknowns.contact_nodes.begin(), unknowns.contact_nodes.end(), 0);
  return unknowns;
}

} // namespace

CondensedSystem::CondensedSystem(const SparseFactor& factor, MPI_Comm communicator)
    : CondensedSystem(factor.kept(), factor.schur_factor(), factor.shift(), communicator) {}

CondensedSystem::CondensedSystem(const LAPACKFullMatrix<double>& factor)
    : CondensedSystem(only_contact_nodes(factor.m()), factor, {}, MPI_COMM_SELF) {}

CondensedSystem::CondensedSystem(KeptUnknowns kept, const LAPACKFullMatrix<double>& factor,
                                 const Vector<double>& shift, MPI_Comm communicator)
    : unknowns(std::move(kept)), processes(communicator), schur(unknowns.size()) {
  if (unknowns.size() > 0)
    factor.mTmult(schur, factor);
  for (unsigned int k = 0; k < shift.size(); ++k)
    schur(unknowns.n_inner + k, unknowns.n_inner + k) -= shift(k);
  copy_triangle(factor, unknowns.n_inner, inner_lower);
}

CondensedSystem::~CondensedSystem() = default;

std::unique_ptr<const CondensedSystem::Factor>
CondensedSystem::factorise(const std::vector<bool>& is_given) const {
  auto factor = std::make_unique<Factor>();
  factor->is_given = is_given;
  std::vector<unsigned int>& free = factor->free;
  for (unsigned int k = 0; k < unknowns.n_inner; ++k)
    if (!is_given[k])
      free.push_back(k);
  if (free.empty() || free.size() == unknowns.n_inner)
    return factor;
  LAPACKFullMatrix<double> block(free.size());
  for (unsigned int k = 0; k < free.size(); ++k)
    for (unsigned int l = 0; l < free.size(); ++l)
      block(k, l) = schur(free[k], free[l]);
  factorise_dense(block);
  copy_triangle(block, free.size(), factor->lower);
  return factor;
}

LAPACKFullMatrix<double> CondensedSystem::matrix_of_interface() const {
  const unsigned int first = unknowns.n_inner, n = unknowns.rows.size();
  const auto& [is_given, free, lower] = *last;
  LAPACKFullMatrix<double> matrix(n); // -T_p
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < n; ++i)
      matrix(i, j) = -schur(first + i, first + j);
  if (n > 0 && !free.empty()) {
    LAPACKFullMatrix<double> coupling(free.size(), n); // S_Fg, then L^-1 S_Fg
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int k = 0; k < free.size(); ++k)
        coupling(k, j) = schur(free[k], first + j);
    (lower.m() > 0 ? lower : inner_lower).solve(coupling);
    coupling.Tmmult(matrix, coupling, /*adding=*/true);
  }
  matrix *= -1;
  return matrix;
}

/// Sets u_F = S_FF^-1 (r_F - S_Fg u_g - S_Fp u_p), with p given.
void CondensedSystem::solve_inner(const Vector<double>& load, Vector<double>& u) const {
  const auto& [is_given, free, lower] = *last;
  if (free.empty())
    return;
  for (const unsigned int k : free)
    u(k) = 0;
  const Vector<double> left = residual(load, u);
  Vector<double> solution(free.size());
  for (unsigned int k = 0; k < free.size(); ++k)
    solution(k) = left(free[k]);
  const LAPACKFullMatrix<double>& factor = lower.m() > 0 ? lower : inner_lower;
  factor.solve(solution);
  factor.solve(solution, /*transposed=*/true);
  for (unsigned int k = 0; k < free.size(); ++k)
    u(free[k]) = solution(k);
}

void CondensedSystem::free_factors() {
  last.reset();
  interface.reset();
}

bool CondensedSystem::solve(const std::vector<bool>& is_given, const Vector<double>& load,
                            Vector<double>& u) {
  const bool has_interface = unknowns.own_rows.size() > 0; // the same on all processes
  // The matrix of the interface depends on what is given on any of them.
  const bool is_own_known = last && last->is_given == is_given,
             is_known = holds_on_all(processes, is_own_known);
  if (!is_known) {
    if (has_interface && !interface)
      interface = std::make_unique<InterfaceSolver>(unknowns.rows, unknowns.own_rows, processes);
    do_on_all(processes, [&] {
      if (is_own_known)
        return;
      last.reset(); // frees its memory first
      last = factorise(is_given);
    });
    if (has_interface)
      interface->set_matrix(matrix_of_interface(),
                            {is_given.begin() + unknowns.n_inner, is_given.end()});
  }
  for (unsigned int k = 0; k < u.size(); ++k)
    if (!is_given[k])
      u(k) = 0;
  solve_inner(load, u);
  if (has_interface) {
    const unsigned int first = unknowns.n_inner;
    const Vector<double> left = residual(load, u);
    Vector<double> rhs(unknowns.rows.size());
    for (unsigned int k = 0; k < rhs.size(); ++k)
      rhs(k) = is_given[first + k] ? 0 : left(first + k);
    const Vector<double> solution = interface->solve(rhs);
    for (unsigned int k = 0; k < rhs.size(); ++k)
      if (!is_given[first + k])
        u(first + k) = solution(k);
    solve_inner(load, u);
  }
  return !is_known;
}

Vector<double> CondensedSystem::residual(const Vector<double>& load,
                                         const Vector<double>& u) const {
  Vector<double> left(u.size());
  if (u.size() > 0)
    schur.vmult(left, u);
  left *= -1;
  if (load.size() > 0)
    left += load;
  return left;
}

double dense_bytes(double n_kept, double n_interface) {
  constexpr double n_matrices = 4;              // L, S, a block of S and its factor
  constexpr double n_matrices_of_trilinos = 30; // T_p, T, its copies and its factor, as measured
  return sizeof(double) *
         (n_matrices * n_kept * n_kept + n_matrices_of_trilinos * n_interface * n_interface);
}

void require_dense_memory(double n_nodes, MPI_Comm communicator) {
  require_memory(dense_bytes(n_nodes, 0),
                 "the dense problem of " + std::to_string(std::lround(n_nodes)) + " contact nodes",
                 communicator);
}

} // namespace rollwave
