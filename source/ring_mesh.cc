#include "ring_mesh.h"

#include "errors.h"
#include "memory.h"
#include "parameters.h"
#include "scene.h"

#include <deal.II/base/numbers.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>
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

/// All digits where they are exact.
std::string count_text(double count) {
  std::ostringstream text;
  text << std::setprecision(count < 1e15 ? 15 : 3) << count;
  return text.str();
}

} // namespace

std::unique_ptr<Triangulation<2>> make_ring_mesh(const Scene& scene, const Parameters& parameters) {
  const auto& mesh = parameters.mesh;
  const double unknowns = std::pow(std::ldexp(mesh.degree, mesh.global_refinements), 2) *
                          mesh.radial_cells * mesh.angular_cells;
  if (unknowns > mesh.most_unknowns)
    throw BadInput(refusal(parameters.settings, "Mesh", "Most unknowns",
                           "the mesh would have " + count_text(unknowns) +
                               " unknowns; allow more, or ask for fewer cells, refinements or a "
                               "lower degree"));

  // What the cells alone occupy at least, whatever is solved on them.
  require_memory(200. * unknowns / (mesh.degree * mesh.degree), "the mesh");

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
