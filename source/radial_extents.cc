#include "radial_extents.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace rollwave {

using namespace dealii;

RadialExtents::RadialExtents(const RingSpace& space) {
  const auto add = [this](double begin, double end, const RadialExtent& radii) {
    RadialExtent& extent = known.at(begin, end, [&] { return radii; });
    extent.begin = std::min(extent.begin, radii.begin);
    extent.end = std::max(extent.end, radii.end);
  };
  for (const auto& cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned()) {
      const Point<2> low = cell->vertex(0), high = cell->vertex(3);
      add(low[1], high[1], {low[0], high[0]});
    }
  std::vector<std::array<double, 4>> own;
  for (const auto& [interval, radii] : known.entries())
    own.push_back({{interval.first, interval.second, radii.begin, radii.end}});
  for (const auto& some : Utilities::MPI::all_gather(space.communicator(), own))
    for (const auto& [begin, end, low, high] : some)
      add(begin, end, {low, high});
}

RadialExtent RadialExtents::of(double begin, double end) const {
  const RadialExtent* const extent = known.find(begin, end);
  return extent ? *extent : RadialExtent();
}

std::vector<CellColumn> RadialExtents::around(double z) const {
  std::vector<CellColumn> columns;
  for (const auto& [interval, radii] : known.entries())
    for (const double turn : {0., 2 * numbers::PI})
      if (interval.first < turn + z && turn + z < interval.second)
        columns.push_back({interval.first - turn, interval.second - turn, radii});
  std::sort(columns.begin(), columns.end(), [](const CellColumn& left, const CellColumn& right) {
    return std::pair(left.begin, left.end) < std::pair(right.begin, right.end);
  });
  return columns;
}

} // namespace rollwave
