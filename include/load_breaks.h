#ifndef ROLLWAVE_LOAD_BREAKS_H
#define ROLLWAVE_LOAD_BREAKS_H

#include <mpi.h>

#include <vector>

namespace rollwave {

struct Scene;

/// Where f jumps on lines r = const and z = const, in order, as far as a mesh sees it.
struct LoadBreaks {
  std::vector<double> radii, angles; ///< the latter in [0, 2 pi)

  bool empty() const { return radii.empty() && angles.empty(); }

  /// The ends of the parts into which they cut an interval.
  std::vector<double> radial_ends(double begin, double end) const;
  std::vector<double> angular_ends(double begin, double end) const;
};

/// Looks for straight_jump() on rectangles that have about a dozen cells in each direction. The
/// same on all processes.
/// @param n_cells those of the mesh
LoadBreaks find_load_breaks(const Scene& scene, unsigned int n_cells, MPI_Comm communicator);

} // namespace rollwave

#endif
