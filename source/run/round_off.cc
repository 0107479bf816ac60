#include "rollwave/run/round_off.h"

#include "rollwave/scene/scene.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace rollwave {

using namespace dealii;

double equilibrium_round_off(const RingSpace& space, const Scene& scene, const FieldVector& u) {
  const DoFHandler<2>& handler = space.dof_handler();
  std::vector<types::global_dof_index> dofs(handler.get_fe().n_dofs_per_cell());
  double squared = 0;
  for (const auto& cell : handler.active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    const double height = high[0] - low[0], length = high[1] - low[1];
    const double entry =
        high[0] * (length / height + std::max(scene.alpha(low[0]), 0.) * height / length);
    cell->get_dof_indices(dofs);
    double largest = 0;
    for (const auto dof : dofs)
      largest = std::max(largest, std::abs(u(dof)));
    squared += dofs.size() * std::pow(entry * largest, 2);
  }
  constexpr double of_solution = 4; // with the errors that rounding causes in the solution
  return of_solution * std::numeric_limits<double>::epsilon() *
         std::sqrt(Utilities::MPI::sum(squared, space.communicator()));
}

} // namespace rollwave
