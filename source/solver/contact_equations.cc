#include "rollwave/solver/contact_equations.h"

#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/run_statistics.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <utility>

namespace rollwave {

using namespace dealii;

std::optional<unsigned int> ContactEquations::node(unsigned int kept) const {
  const int number = system.kept().contact_nodes[kept] - static_cast<int>(first);
  return 0 <= number && number < static_cast<int>(n) ? std::optional<unsigned int>(number)
                                                     : std::nullopt;
}

bool ContactEquations::solve(const std::vector<bool>& pinned, Vector<double> load,
                             ContactState& state) const {
  const KeptUnknowns& kept = system.kept();
  std::vector<bool> is_given(kept.size());
  Vector<double> u(kept.size());
  if (load.size() == 0)
    load.reinit(kept.size());
  for (unsigned int k = 0; k < kept.size(); ++k)
    if (const auto i = node(k)) {
      is_given[k] = pinned[*i];
      if (pinned[*i])
        u(k) = state.displacement(*i);
      else if (kept.is_own(k))
        load(k) -= state.force(*i);
    }
  const bool is_other_set = system.solve(is_given, load, u);

  const Vector<double> reactions = system.residual(load, u);
  Vector<double> found(n); // N_i or u_i
  for (unsigned int k = 0; k < kept.size(); ++k)
    if (const auto i = node(k))
      found(*i) = pinned[*i] ? reactions(k) : kept.is_own(k) ? u(k) : 0;
  if (!is_serial(system.communicator()))
    Utilities::MPI::sum(found, system.communicator(), found);
  for (unsigned int i = 0; i < n; ++i)
    (pinned[i] ? state.force : state.displacement)(i) = found(i);
  state.kept = std::move(u);
  const auto n_pinned = std::count(pinned.begin(), pinned.end(), true);
  return is_other_set && 0 < n_pinned && n_pinned < n;
}

void ContactEquations::solve(const std::vector<bool>& pinned, ContactState& state,
                             RunStatistics& statistics) const {
  statistics.dense_factorisations += solve(pinned, g, state);
}

Vector<double> ContactEquations::apply_compliance(const Vector<double>& force) const {
  ContactState state = {Vector<double>(n), force};
  state.force *= -1;
  solve(std::vector<bool>(n, false), Vector<double>(), state);
  return state.displacement;
}

ContactState ContactEquations::derivative(const std::vector<bool>& pinned,
                                          const Vector<double>& displacement,
                                          RunStatistics& statistics) const {
  ContactState change = {displacement, Vector<double>(n)};
  statistics.dense_factorisations += solve(pinned, Vector<double>(), change);
  return change;
}

} // namespace rollwave
