#ifndef ROLLWAVE_MESH_STRIP_MESH_H
#define ROLLWAVE_MESH_STRIP_MESH_H

#include <deal.II/grid/tria.h>

#include <memory>
#include <vector>

namespace rollwave {

/**
 * The grid of all rectangles between these @p radii and these @p angles for several processes,
 * which have a strip of as many columns along z each, and see the columns beside it. It is not
 * periodic yet, and cannot be refined. Rows and columns are numbered one after another, columns
 * last: assembly and multigrid run faster through memory than in the order of p4est's cells.
 */
std::unique_ptr<dealii::Triangulation<2>> make_strip_mesh(const std::vector<double>& radii,
                                                          const std::vector<double>& angles,
                                                          MPI_Comm communicator);

} // namespace rollwave

#endif
