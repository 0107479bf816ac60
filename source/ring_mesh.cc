#include "ring_mesh.h"

#include "errors.h"
#include "parameters.h"
#include "scene.h"

#include <deal.II/base/numbers.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <cmath>

namespace rollwave {

using namespace dealii;

std::unique_ptr<Triangulation<2>> make_ring_mesh(const Scene& scene, const Parameters& parameters) {
  const auto& mesh = parameters.mesh;
  const double unknowns = std::pow(std::ldexp(mesh.degree, mesh.global_refinements), 2) *
                          mesh.radial_cells * mesh.angular_cells;
  if (unknowns > mesh.most_unknowns)
    throw BadInput(refusal(parameters.settings, "Mesh", "Most unknowns",
                           "the mesh would have " + std::to_string(std::llround(unknowns)) +
                               " unknowns; allow more, or ask for fewer cells, refinements or a "
                               "lower degree"));

  auto triangulation =
      std::make_unique<Triangulation<2>>(Triangulation<2>::limit_level_difference_at_vertices);
  GridGenerator::subdivided_hyper_rectangle(*triangulation, {mesh.radial_cells, mesh.angular_cells},
                                            Point<2>(scene.inner_radius, numbers::PI / 2),
                                            Point<2>(scene.outer_radius, 5 * numbers::PI / 2),
                                            /*colorize=*/true);
  std::vector<GridTools::PeriodicFacePair<Triangulation<2>::cell_iterator>> seam;
  GridTools::collect_periodic_faces(*triangulation, seam_begin_id, seam_end_id, /*direction=*/1,
                                    seam);
  triangulation->add_periodicity(seam);
  triangulation->refine_global(mesh.global_refinements);
  return triangulation;
}

} // namespace rollwave
