#include "rollwave/adapt/cell_lines.h"

#include <iterator>

namespace rollwave {

using namespace dealii;

CellLines::CellLines(const RingSpace& space)
    : has_hanging_nodes(space.dof_handler().get_triangulation().has_hanging_nodes()) {
  for (const auto& cell : space.dof_handler().active_cell_iterators())
    for (const unsigned int f : {2U, 3U})
      if (!cell->is_artificial() && cell->at_boundary(f))
        seam[f - 2][{cell->face(f)->vertex(0)[0], cell->face(f)->vertex(1)[0]}] =
            cell->face(f)->index();
}

CellLines::Parts CellLines::parts(const DoFHandler<2>::active_cell_iterator& cell,
                                  unsigned int f) const {
  // Quicker than what follows, which would say the same: the lines of every cell are asked for.
  if (!has_hanging_nodes && (f < 2 || cell->neighbor_index(f) >= 0))
    return {1, {{static_cast<int>(cell->face_index(f)), -1}}};
  const auto face = cell->face(f);
  if (has_hanging_nodes && face->has_children())
    return {2, {{face->child_index(0), face->child_index(1)}}};
  if (f >= 2 && cell->neighbor_index(f) < 0) {
    const double begin = face->vertex(0)[0], end = face->vertex(1)[0];
    const auto& other = seam[3 - f];
    if (const auto same = other.find({begin, end}); same != other.end())
      return {1, {{f == 2 ? face->index() : same->second, -1}}};
    // A process may know but one of them, and has then no cell beside this face.
    const auto lower = other.lower_bound({begin, begin});
    const auto upper = lower == other.end() ? lower : std::next(lower);
    if (upper != other.end() && lower->first.first == begin && lower->first.second < end &&
        upper->first.first == lower->first.second)
      return {2, {{lower->second, upper->second}}};
  }
  return {1, {{face->index(), -1}}};
}

} // namespace rollwave
