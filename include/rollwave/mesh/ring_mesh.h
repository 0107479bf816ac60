#pragma once

#include <deal.II/grid/tria.h>

#include <memory>

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
};

/// The unknowns of the first mesh, including the few on the hub.
double count_unknowns(const MeshOptions& mesh);

/// @throws BadValue when the first mesh would have more than `Mesh/Most unknowns` unknowns.
void check_mesh_size(const MeshOptions& mesh);

/**
 * The mesh of `Mesh/Radial cells` times `Mesh/Angular cells` rectangles in (r, z), equal but that
 * their heights grow geometrically near a small hub, refined `Mesh/Global refinements` times,
 * periodic over the seam. Where `Road/Contact zone` is given, its ends are vertices, and the cells
 * within and outside of it differ in length as they must: a zone that ended inside of cells would
 * cut the contact short at another place on every mesh.
 *
 * On several processes each has a part of it. Which class it is of is up to what will be done with
 * it: p4est's if it @p may_be_refined; if not, columns of cells along z, numbered one after
 * another, through which assembly and multigrid run faster than through p4est's parts.
 *
 * @throws BadValue as check_mesh_size(), NotEnoughMemory.
 */
std::unique_ptr<dealii::Triangulation<2>> make_ring_mesh(const Scene& scene,
                                                         const MeshOptions& mesh,
                                                         bool may_be_refined,
                                                         MPI_Comm communicator);

} // namespace rollwave
