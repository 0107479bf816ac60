#ifndef ROLLWAVE_ADAPT_CELL_LINES_H
#define ROLLWAVE_ADAPT_CELL_LINES_H

#include "rollwave/mesh/ring_space.h"

#include <array>
#include <map>
#include <utility>

namespace rollwave {

/// The lines between cells, over the seam as well. A line that is shared by a coarser and two finer
/// cells counts as the two lines of the finer ones.
class CellLines {
public:
  explicit CellLines(const RingSpace& space);

  /// The numbers of the lines that make up a face, one or two.
  struct Parts {
    unsigned int count;
    std::array<int, 2> lines;
  };

  Parts parts(const dealii::DoFHandler<2>::active_cell_iterator& cell, unsigned int f) const;

private:
  bool has_hanging_nodes;
  /// Those of cells at either side of the seam, by the radii of their ends.
  std::array<std::map<std::pair<double, double>, int>, 2> seam;
};

} // namespace rollwave

#endif
