#ifndef ROLLWAVE_RADIAL_EXTENTS_H
#define ROLLWAVE_RADIAL_EXTENTS_H

#include "interval_map.h"
#include "ring_space.h"

#include <limits>
#include <vector>

namespace rollwave {

struct RadialExtent {
  double begin = 0, end = std::numeric_limits<double>::infinity();
};

/// Cells that have an angular interval in common.
struct CellColumn {
  double begin, end; ///< of the interval
  RadialExtent radii;
};

/// The radii between which the cells lie that have an angular interval in common, the same on all
/// processes.
class RadialExtents {
public:
  /// Of no cells.
  RadialExtents() = default;

  explicit RadialExtents(const RingSpace& space);

  /// Of the cells with the angular interval [begin, end]; all radii where there are none.
  RadialExtent of(double begin, double end) const;

  /// Those that have the angle z within, whichever turn they belong to, in order.
  std::vector<CellColumn> around(double z) const;

private:
  IntervalMap<RadialExtent> known;
};

} // namespace rollwave

#endif
