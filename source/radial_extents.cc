#include "radial_extents.h"

#include <algorithm>

namespace rollwave {

using namespace dealii;

RadialExtents::RadialExtents(const RingSpace& space) {
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    RadialExtent& extent = known.at(low[1], high[1], [&] { return RadialExtent{low[0], high[0]}; });
    extent.begin = std::min(extent.begin, low[0]);
    extent.end = std::max(extent.end, high[0]);
  }
}

RadialExtent RadialExtents::of(double begin, double end) const {
  const RadialExtent* const extent = known.find(begin, end);
  return extent ? *extent : RadialExtent();
}

} // namespace rollwave
