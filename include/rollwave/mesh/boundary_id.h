#ifndef ROLLWAVE_MESH_BOUNDARY_ID_H
#define ROLLWAVE_MESH_BOUNDARY_ID_H

namespace rollwave {

/// Boundary ids of the rectangle (r, z) in [a, b] x [pi/2, 5 pi/2].
enum BoundaryId : unsigned int {
  hub_id = 0,          ///< r = a, where u = 0
  surface_id = 1,      ///< r = b, which meets the road
  seam_begin_id = 2,   ///< z = pi/2, opposite to the road
  seam_end_id = 3,     ///< z = 5 pi/2, the same points as z = pi/2
  unpaired_seam_id = 4 ///< either, on a process that does not see the other side
};

} // namespace rollwave

#endif
