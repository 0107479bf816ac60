#ifndef ROLLWAVE_RING_MESH_H
#define ROLLWAVE_RING_MESH_H

#include <deal.II/grid/tria.h>

#include <memory>

namespace rollwave {

struct Parameters;
struct Scene;

/// The unknowns of the first mesh, but for the few that the hub takes away.
double count_unknowns(const Parameters& parameters);

/// @throws BadInput when the first mesh would have more than `Mesh/Most unknowns` unknowns.
void check_mesh_size(const Parameters& parameters);

/**
 * The mesh of `Mesh/Radial cells` times `Mesh/Angular cells` rectangles in (r, z), equal but that
 * their heights grow geometrically near a small hub, refined `Mesh/Global refinements` times,
 * periodic over the seam. Where `Road/Contact zone` is given, its ends are vertices, and the cells
 * within and outside of it differ in length as they must: a zone that ended inside of cells would
 * cut the contact short at another place on every mesh.
 *
 * On several processes each has a part of it. Which class it is of is up to what will be done with
 * it: p4est's if it may be refined, a make_strip_mesh() if not.
 *
 * @throws BadInput as check_mesh_size(), NotEnoughMemory.
 */
std::unique_ptr<dealii::Triangulation<2>>
make_ring_mesh(const Scene& scene, const Parameters& parameters, MPI_Comm communicator);

} // namespace rollwave

#endif
