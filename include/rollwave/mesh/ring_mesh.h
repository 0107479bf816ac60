#pragma once

#include <deal.II/grid/tria.h>

#include <memory>
#include <tuple>

namespace rollwave {

struct Scene;

/// Boundary ids of the rectangle (r, z) in [a, b] x [pi/2, 5 pi/2].
enum BoundaryId : unsigned int {
  hub_id = 0,        ///< r = a, where u = 0
  surface_id = 1,    ///< r = b, which meets the road
  seam_begin_id = 2, ///< z = pi/2, opposite to the road
  seam_end_id = 3    ///< z = 5 pi/2, the same points as z = pi/2
};

/// The highest degree of elements.
constexpr unsigned int highest_degree = 8;

/// The first mesh, of section `Mesh`.
struct MeshOptions {
  unsigned int degree = 2;
  unsigned int radial_cells = 16;
  unsigned int angular_cells = 200;
  unsigned int global_refinements = 0;
  unsigned int most_unknowns = 5000000;

  auto members() const {
    return std::tie(degree, radial_cells, angular_cells, global_refinements, most_unknowns);
  }
  bool operator==(const MeshOptions& other) const { return members() == other.members(); }
};

/// The number of unknowns of the first mesh; nodes on the hub are not unknowns.
double count_unknowns(const MeshOptions& mesh);

/// The options with as many cells as @p scene needs: from a small hub outwards radii grow at most
/// fourfold from vertex to vertex, and around a given zone that is narrower than a cell there are
/// four columns.
MeshOptions with_enough_cells(const Scene& scene, MeshOptions mesh);

/// @throws BadValue when the first mesh would have more than `Mesh/Most unknowns` unknowns.
void check_mesh_size(const MeshOptions& mesh);

/**
 * The mesh of `Mesh/Radial cells` times `Mesh/Angular cells` equal rectangles in (r, z), or more by
 * with_enough_cells(), refined `Mesh/Global refinements` times, periodic over the seam. Heights
 * grow geometrically near a small hub. If `Road/Contact zone` is given, its ends are vertices, and
 * cells inside and outside of it differ in length: a zone that ended inside of cells would cut the
 * contact short at another place on every mesh. Where the zone is narrower than half a cell, cells
 * at its ends are cut in four until they are as narrow.
 *
 * On several processes each has a part of the refined mesh, and the coarse one as a whole.
 *
 * @throws BadValue as check_mesh_size(), NotEnoughMemory.
 */
std::unique_ptr<dealii::Triangulation<2>>
make_ring_mesh(const Scene& scene, const MeshOptions& options, MPI_Comm communicator);

} // namespace rollwave
