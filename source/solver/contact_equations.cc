#include "rollwave/solver/contact_equations.h"

#include <algorithm>

namespace rollwave {

using namespace dealii;

template <typename Values>
Values ContactEquations::on_all(const Values& values) const {
  Values all(system.size());
  std::copy(values.begin(), values.end(), all.begin() + first);
  return all;
}

Vector<double> ContactEquations::on_run(const Vector<double>& values) const {
  return Vector<double>(values.begin() + first, values.begin() + first + n);
}

void ContactEquations::solve(const std::vector<bool>& pinned, ContactState& state,
                             RunStatistics& statistics) const {
  ContactState all = {on_all(state.displacement), on_all(state.force)};
  system.solve(on_all(pinned), g, all, statistics);
  state = {on_run(all.displacement), on_run(all.force)};
}

Vector<double> ContactEquations::apply_compliance(const Vector<double>& force) const {
  return on_run(system.apply_compliance(on_all(force)));
}

ContactState ContactEquations::derivative(const std::vector<bool>& pinned,
                                          const Vector<double>& displacement,
                                          RunStatistics& statistics) const {
  ContactState change = {on_all(displacement), Vector<double>(system.size())};
  system.solve(on_all(pinned), {}, change, statistics);
  return {on_run(change.displacement), on_run(change.force)};
}

Vector<double> ContactEquations::complete(const Vector<double>& displacement,
                                          RunStatistics& statistics) const {
  ContactState all = {on_all(displacement), Vector<double>(system.size())};
  system.solve(on_all(std::vector<bool>(n, true)), g, all, statistics);
  return all.displacement;
}

} // namespace rollwave
