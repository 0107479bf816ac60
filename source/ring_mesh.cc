#include "ring_mesh.h"

#include "errors.h"
#include "parameters.h"
#include "scene.h"

#include <deal.II/base/numbers.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rollwave {

using namespace dealii;

namespace {

constexpr double seam_angle = numbers::PI / 2;

/// The angular lengths of the cells: equal, or nearly so where the user gives a zone of contact,
/// whose ends shall be vertices.
std::vector<double> angular_steps(const Scene& scene, const Parameters& parameters) {
  const int n = parameters.mesh.angular_cells;
  if (!parameters.road.contact_zone)
    return std::vector<double>(n, 2 * numbers::PI / n);
  const double before = scene.zone_begin - seam_angle;
  const double zone = scene.zone_end - scene.zone_begin;
  const double after = 2 * numbers::PI - before - zone;
  const auto share = [n](double arc, int least, int most) {
    return std::clamp<int>(std::lround(n * arc / (2 * numbers::PI)), least, most);
  };
  const int n_zone = share(zone, 1, n - 2);
  const int n_before = share(before, 1, n - n_zone - 1);
  const int n_after = n - n_zone - n_before;
  std::vector<double> steps(n_before, before / n_before);
  steps.insert(steps.end(), n_zone, zone / n_zone);
  steps.insert(steps.end(), n_after, after / n_after);
  return steps;
}

} // namespace

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
  const std::vector<double> radial(mesh.radial_cells,
                                   (scene.outer_radius - scene.inner_radius) / mesh.radial_cells);
  GridGenerator::subdivided_hyper_rectangle(
      *triangulation, {radial, angular_steps(scene, parameters)},
      Point<2>(scene.inner_radius, seam_angle),
      Point<2>(scene.outer_radius, seam_angle + 2 * numbers::PI),
      /*colorize=*/true);
  std::vector<GridTools::PeriodicFacePair<Triangulation<2>::cell_iterator>> seam;
  GridTools::collect_periodic_faces(*triangulation, seam_begin_id, seam_end_id, /*direction=*/1,
                                    seam);
  triangulation->add_periodicity(seam);
  triangulation->refine_global(mesh.global_refinements);
  return triangulation;
}

} // namespace rollwave
