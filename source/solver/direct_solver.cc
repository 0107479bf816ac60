#include "rollwave/solver/direct_solver.h"

#include "rollwave/scene/scene.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <utility>

namespace rollwave {

using namespace dealii;

void DirectSolver::factorise(const Scene& scene) {
  angular_velocity.reset(); // until the factor is there
  is_reduced = false;
  factor.reinit(0);
  schur.reinit(0);
  {
    const RunStatistics::Phase phase(*statistics, "ordering");
    cholesky.number_unknowns(space.constraints());
  }
  {
    LowerTriplets triplets;
    {
      const RunStatistics::Phase phase(*statistics, "assembly");
      triplets = cholesky.assemble(space.constraints(), stiffness_matrices(space, scene));
      ++statistics->stiffness_assemblies;
    }
    const RunStatistics::Phase phase(*statistics, "ordering");
    cholesky.analyse(triplets, *statistics);
  }
  const RunStatistics::Phase phase(*statistics, "factorisation");
  cholesky.factorise(*statistics);
  const unsigned int m = candidates.size();
  factor.reinit(m);
  factor = cholesky.factor().trailing_factor(m);
  schur.reinit(m);
  factor.mTmult(schur, factor);
  factor.set_property(LAPACKSupport::lower_triangular);
  angular_velocity = scene.angular_velocity;
}

void DirectSolver::set_problem(const Scene& scene, const ContactBoundary& boundary,
                               const std::optional<FieldVector>& load, RunStatistics& statistics) {
  const auto first = candidates.contact_number(boundary.first_surface_node());
  AssertThrow(first && *first + boundary.size() <= candidates.size(), ExcInternalError());
  this->boundary = boundary;
  this->statistics = &statistics;
  if (angular_velocity != scene.angular_velocity)
    factorise(scene);

  const RunStatistics::Phase phase(statistics, "contact");
  if (is_reduced && load.has_value() == this->load.has_value() &&
      (!load || std::equal(load->begin(), load->end(), this->load->begin())))
    return;
  this->load = load;
  const unsigned int m = schur.m();
  contact_load.reinit(m);
  reduced_load.clear();
  if (load) {
    reduced_load = cholesky.factor().forward(cholesky.gather(*load));
    ++statistics.forward_substitutions;
    factor.vmult(contact_load, Vector<double>(reduced_load.end() - m, reduced_load.end()));
  }
  is_reduced = true;
}

template <typename Values>
Values DirectSolver::on_candidates(const Values& contact_values) const {
  Values values(schur.m());
  std::copy(contact_values.begin(), contact_values.end(), values.begin() + first_contact());
  return values;
}

Vector<double> DirectSolver::on_contact(const Vector<double>& values) const {
  const auto first = values.begin() + first_contact();
  return Vector<double>(first, first + boundary.size());
}

Vector<double> DirectSolver::apply_compliance(const Vector<double>& force, double /*accuracy*/) {
  Vector<double> displacement = on_candidates(force);
  divide_by_schur(displacement);
  return on_contact(displacement);
}

void DirectSolver::divide_by_schur(Vector<double>& force) const {
  factor.solve(force);
  factor.solve(force, /*transposed=*/true);
}

/// Sets u_i of the candidates that are not pinned and N_i of those that are.
/// @param contact_load g
/// @return true if some nodes are pinned and some are free, which needs a factorisation
bool DirectSolver::solve_dense(const std::vector<bool>& pinned, const Vector<double>& contact_load,
                               Vector<double>& displacement, Vector<double>& force) const {
  std::vector<unsigned int> free;
  for (unsigned int i = 0; i < pinned.size(); ++i)
    if (!pinned[i]) {
      free.push_back(i);
      displacement(i) = 0;
    }
  const auto force_left = [&] { // g - S u
    Vector<double> left(pinned.size());
    schur.vmult(left, displacement);
    left.sadd(-1, contact_load);
    return left;
  };
  const Vector<double> left = force_left();
  Vector<double> solution(free.size());
  for (unsigned int k = 0; k < free.size(); ++k)
    solution(k) = left(free[k]) - force(free[k]);
  const bool is_mixed = !free.empty() && free.size() < pinned.size();
  if (is_mixed) {
    LAPACKFullMatrix<double> block(free.size());
    for (unsigned int k = 0; k < free.size(); ++k)
      for (unsigned int l = 0; l < free.size(); ++l)
        block(k, l) = schur(free[k], free[l]);
    block.set_property(LAPACKSupport::symmetric);
    block.compute_cholesky_factorization();
    block.solve(solution);
  } else if (!free.empty())
    divide_by_schur(solution);
  for (unsigned int k = 0; k < free.size(); ++k)
    displacement(free[k]) = solution(k);
  const Vector<double> reactions = force_left();
  for (unsigned int i = 0; i < pinned.size(); ++i)
    if (pinned[i])
      force(i) = reactions(i);
  return is_mixed;
}

double DirectSolver::solve(const std::vector<bool>& pinned, ContactState& state,
                           double /*accuracy*/) {
  Vector<double> displacement = on_candidates(state.displacement),
                 force = on_candidates(state.force);
  statistics->dense_factorisations +=
      solve_dense(on_candidates(pinned), contact_load, displacement, force);
  state.displacement = on_contact(displacement);
  state.force = on_contact(force);
  return 0;
}

ContactState DirectSolver::derivative(const std::vector<bool>& pinned,
                                      const Vector<double>& displacement, double /*accuracy*/) {
  const Vector<double> no_load(schur.m());
  Vector<double> moved = on_candidates(displacement), force(schur.m());
  statistics->dense_factorisations += solve_dense(on_candidates(pinned), no_load, moved, force);
  return {on_contact(moved), on_contact(force)};
}

FieldVector DirectSolver::displacement_field(const ContactState& state) {
  const RunStatistics::Phase phase(*statistics, "back-substitution");
  std::vector<double> rhs = reduced_load;
  rhs.resize(space.n_unknowns());
  // The candidates that are no contact nodes are free.
  Vector<double> displacement = on_candidates(state.displacement), force(schur.m());
  solve_dense(on_candidates(std::vector<bool>(state.displacement.size(), true)), contact_load,
              displacement, force);
  // With this right-hand side the last rows of L^T x = rhs give the prescribed displacement.
  Vector<double> trailing(schur.m());
  factor.Tvmult(trailing, displacement);
  std::copy(trailing.begin(), trailing.end(), rhs.end() - trailing.size());
  ++statistics->back_substitutions;
  FieldVector field = cholesky.scatter(cholesky.factor().backward(std::move(rhs)));
  space.constraints().distribute(field);
  return field;
}

FieldVector DirectSolver::apply(const FieldVector& field) const {
  return cholesky.scatter(cholesky.factor().multiply(cholesky.gather(field)));
}

} // namespace rollwave
