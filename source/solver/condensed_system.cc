#include "rollwave/solver/condensed_system.h"

#include "rollwave/base/memory.h"
#include "rollwave/base/run_statistics.h"
#include "rollwave/solver/dense_cholesky.h"

#include <cmath>
#include <string>

namespace rollwave {

using namespace dealii;

CondensedSystem::CondensedSystem(const LAPACKFullMatrix<double>& schur_factor)
    : factor(schur_factor), schur(schur_factor.m()) {
  factor.mTmult(schur, factor);
  factor.set_property(LAPACKSupport::lower_triangular);
}

Vector<double> CondensedSystem::apply_compliance(Vector<double> force) const {
  factor.solve(force);
  factor.solve(force, /*transposed=*/true);
  return force;
}

void CondensedSystem::solve(const std::vector<bool>& pinned, const Vector<double>& g,
                            ContactState& state, RunStatistics& statistics) const {
  auto& [displacement, force] = state;
  std::vector<unsigned int> free;
  for (unsigned int i = 0; i < pinned.size(); ++i)
    if (!pinned[i]) {
      free.push_back(i);
      displacement(i) = 0;
    }
  const auto force_left = [&] { // g - S u
    Vector<double> left(pinned.size());
    schur.vmult(left, displacement);
    left *= -1;
    if (g.size() > 0)
      left += g;
    return left;
  };
  const Vector<double> left = force_left();
  Vector<double> solution(free.size());
  for (unsigned int k = 0; k < free.size(); ++k)
    solution(k) = left(free[k]) - force(free[k]);
  if (!free.empty() && free.size() < pinned.size()) {
    LAPACKFullMatrix<double> block(free.size());
    for (unsigned int k = 0; k < free.size(); ++k)
      for (unsigned int l = 0; l < free.size(); ++l)
        block(k, l) = schur(free[k], free[l]);
    factorise_dense(block);
    block.solve(solution);
    ++statistics.dense_factorisations;
  } else if (!free.empty())
    solution = apply_compliance(solution);
  for (unsigned int k = 0; k < free.size(); ++k)
    displacement(free[k]) = solution(k);
  const Vector<double> reactions = force_left();
  for (unsigned int i = 0; i < pinned.size(); ++i)
    if (pinned[i])
      force(i) = reactions(i);
}

void require_dense_memory(double n_nodes, MPI_Comm communicator) {
  constexpr double n_matrices = 3; // L, S, and a block of S
  require_memory(n_matrices * sizeof(double) * n_nodes * n_nodes,
                 "the dense problem of " + std::to_string(std::lround(n_nodes)) + " contact nodes",
                 communicator);
}

} // namespace rollwave
