#include "rollwave/mesh/ring_mesh.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/memory.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/scene/scene.h"

#include <boost/math/tools/roots.hpp>
#include <deal.II/base/numbers.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace rollwave {

using namespace dealii;

namespace {

constexpr auto smoothing = Triangulation<2>::limit_level_difference_at_vertices;
constexpr double seam_angle = numbers::PI / 2;

/// Appends @p n places at equal distances after @p begin, the last one at @p end.
void append_equal(std::vector<double>& places, double begin, double end, int n) {
  for (int i = 1; i < n; ++i)
    places.push_back(begin + (end - begin) * i / n);
  places.push_back(end);
}

/// Two columns of cells that meet in the middle of a given zone. The zone ends where their cells
/// have been halved @p n_halvings times.
struct NarrowZone {
  double width; ///< of each column
  int n_halvings;
};

/// The two columns for a zone that is less than half a column wide; nullopt for other zones. Cells
/// as wide as such a zone would be needles, and would stay needles when they are cut in four.
/// @param n columns
std::optional<NarrowZone> find_narrow_zone(const Scene& scene, int n) {
  const double column = 2 * numbers::PI / n, zone = scene.zone_end - scene.zone_begin;
  if (!scene.has_given_zone || zone > column / 2 || n < 4)
    return {};
  constexpr int most_halvings = 20; // which leave some levels to refinement
  NarrowZone narrow = {zone / 2, 0};
  while (narrow.n_halvings < most_halvings && 2 * narrow.width < column) {
    narrow.width *= 2;
    ++narrow.n_halvings;
  }
  return narrow;
}

/// The angles of the vertices: at equal distances, or nearly so where the user gives a zone of
/// contact, whose ends must be vertices of this mesh or of one with a NarrowZone.
std::vector<double> angles_of(const Scene& scene, int n) {
  const double end = seam_angle + 2 * numbers::PI;
  std::vector<double> angles = {seam_angle};
  if (!scene.has_given_zone) {
    append_equal(angles, seam_angle, end, n);
    return angles;
  }
  double begin = scene.zone_begin, stop = scene.zone_end;
  int n_zone = std::clamp<int>(std::lround(n * (stop - begin) / (2 * numbers::PI)), 1, n - 2);
  if (const auto narrow = find_narrow_zone(scene, n)) {
    const double middle = (begin + stop) / 2;
    begin = middle - narrow->width;
    stop = middle + narrow->width;
    n_zone = 2;
  }
  // Both sides share the remaining columns, so that mirrored zones have mirrored meshes.
  const double before = begin - seam_angle, after = end - stop;
  const int n_before =
      std::clamp<int>(std::lround((n - n_zone) * before / (before + after)), 1, n - n_zone - 1);
  append_equal(angles, seam_angle, begin, n_before);
  append_equal(angles, begin, stop, n_zone);
  append_equal(angles, stop, end, n - n_zone - n_before);
  return angles;
}

/// True if n cells of equal height would be taller next to the hub than its radius.
bool has_graded_radii(double inner_radius, double outer_radius, int n) {
  return (outer_radius - inner_radius) / n > inner_radius && n >= 3;
}

/// By how much the last of the cells that grow by @p ratio exceeds the others, equal ones.
double excess_of_growth(double inner_radius, double outer_radius, int n, double ratio,
                        int n_growing) {
  const double r = inner_radius * std::pow(ratio, n_growing);
  return r * (1 - 1 / ratio) - (outer_radius - r) / (n - n_growing);
}

/// True if radii grow at most fourfold from vertex to vertex, by radii_of().
bool has_gentle_radii(double inner_radius, double outer_radius, int n) {
  constexpr double most = 4;
  return has_graded_radii(inner_radius, outer_radius, n)
             ? excess_of_growth(inner_radius, outer_radius, n, most, n / 2) >= 0
             : (outer_radius - inner_radius) / n <= (most - 1) * inner_radius;
}

/// The radii of the vertices: at equal distances, unless has_graded_radii(). Since u is much like
/// ln(r/a) there, heights then grow with the radius first, r_i = a q^i, and are equal from where
/// that would make them taller. q is 2 where the cells suffice, else half of the cells grow.
std::vector<double> radii_of(double inner_radius, double outer_radius, int n) {
  const double a = inner_radius, b = outer_radius;
  std::vector<double> radii = {a};
  if (!has_graded_radii(a, b, n)) {
    append_equal(radii, a, b, n);
    return radii;
  }
  const auto excess = [&](double q, int n_growing) {
    return excess_of_growth(a, b, n, q, n_growing);
  };
  int n_growing = 1;
  while (n_growing < n - 1 && excess(2, n_growing) < 0)
    ++n_growing;
  double q = 2;
  if (excess(q, n_growing) < 0) {
    n_growing = n / 2;
    std::uintmax_t most_evaluations = 100;
    q = boost::math::tools::toms748_solve([&](double ratio) { return excess(ratio, n_growing); },
                                          2., std::pow(b / a, 1. / n_growing),
                                          boost::math::tools::eps_tolerance<double>(40),
                                          most_evaluations)
            .first;
  }
  for (int i = 1; i <= n_growing; ++i)
    radii.push_back(a * std::pow(q, i));
  append_equal(radii, radii.back(), b, n - n_growing);
  return radii;
}

/// Makes z = pi/2 and z = 5 pi/2 one.
void join_seam(Triangulation<2>& mesh) {
  std::vector<GridTools::PeriodicFacePair<Triangulation<2>::cell_iterator>> seam;
  GridTools::collect_periodic_faces(mesh, seam_begin_id, seam_end_id, /*direction=*/1, seam);
  mesh.add_periodicity(seam);
}

/// The rectangles between these places on one process.
std::unique_ptr<Triangulation<2>> make_grid(const std::vector<double>& radii,
                                            const std::vector<double>& angles) {
  auto grid = std::make_unique<Triangulation<2>>(smoothing);
  const std::vector<unsigned int> n_cells = {static_cast<unsigned int>(radii.size() - 1),
                                             static_cast<unsigned int>(angles.size() - 1)};
  // In units of cells first: heights may be far smaller than lengths in z, and the vertices must be
  // exact, in particular those of the surface.
  GridGenerator::subdivided_hyper_rectangle(*grid, n_cells, Point<2>(),
                                            Point<2>(n_cells[0], n_cells[1]), /*colorize=*/true);
  GridTools::transform(
      [&](const Point<2>& cells) {
        return Point<2>(radii[std::lround(cells[0])], angles[std::lround(cells[1])]);
      },
      *grid);
  return grid;
}

/// All digits where they are exact.
std::string count_text(double count) {
  std::ostringstream text;
  text << std::setprecision(count < 1e15 ? 15 : 3) << count;
  return text.str();
}

} // namespace

double count_unknowns(const MeshOptions& mesh) {
  return std::pow(std::ldexp(mesh.degree, mesh.global_refinements), 2) * mesh.radial_cells *
         mesh.angular_cells;
}

MeshOptions with_enough_cells(const Scene& scene, MeshOptions mesh) {
  while (!has_gentle_radii(scene.inner_radius, scene.outer_radius, mesh.radial_cells))
    ++mesh.radial_cells;
  constexpr unsigned int least_columns = 4;
  if (scene.has_given_zone && mesh.angular_cells < least_columns &&
      scene.zone_end - scene.zone_begin < 2 * numbers::PI / least_columns)
    mesh.angular_cells = least_columns;
  return mesh;
}

void check_mesh_size(const MeshOptions& mesh) {
  const double unknowns = count_unknowns(mesh);
  if (unknowns <= mesh.most_unknowns)
    return;
  MeshOptions unrefined = mesh;
  unrefined.global_refinements = 0;
  const bool is_refined_too_often = count_unknowns(unrefined) <= mesh.most_unknowns;
  throw BadValue("Mesh", is_refined_too_often ? "Global refinements" : "Most unknowns",
                 "the mesh would have " + count_text(unknowns) +
                     " unknowns, and Mesh/Most unknowns is " + std::to_string(mesh.most_unknowns) +
                     "; allow more, or ask for fewer cells, refinements or a lower degree");
}

namespace {

/// Cells of the coarse mesh, and how often all of them are cut in four.
struct CoarseMesh {
  unsigned int radial_cells, angular_cells, n_refinements;
};

/// The same cells from fewer coarse ones where all have one size: each process holds the coarse
/// mesh as a whole.
CoarseMesh coarsen(const Scene& scene, const MeshOptions& mesh) {
  CoarseMesh coarse = {mesh.radial_cells, mesh.angular_cells, mesh.global_refinements};
  auto& [n_radial, n_angular, n_refinements] = coarse;
  const auto is_equal = [&scene](unsigned int n) {
    return !has_graded_radii(scene.inner_radius, scene.outer_radius, n);
  };
  if (scene.has_given_zone || !is_equal(n_radial))
    return coarse;
  constexpr double few = 10000; // which cost nothing
  while (1. * n_radial * n_angular > few && n_radial % 2 == 0 && n_angular % 2 == 0 &&
         is_equal(n_radial / 2)) {
    n_radial /= 2;
    n_angular /= 2;
    ++n_refinements;
  }
  return coarse;
}

/// Cuts cells at the surface until the ends of a narrow zone are vertices.
void cut_to_zone(Triangulation<2>& mesh, const Scene& scene, const NarrowZone& narrow) {
  const auto holds_an_end = [](const auto& cell, double end) {
    return cell->vertex(0)[1] < end - angular_round_off &&
           end + angular_round_off < cell->vertex(3)[1];
  };
  for (int halving = 0; halving < narrow.n_halvings; ++halving) {
    for (const auto& cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary(surface_id) &&
          (holds_an_end(cell, scene.zone_begin) || holds_an_end(cell, scene.zone_end)))
        cell->set_refine_flag();
    mesh.execute_coarsening_and_refinement();
  }
}

} // namespace

std::unique_ptr<Triangulation<2>> make_ring_mesh(const Scene& scene, const MeshOptions& options,
                                                 MPI_Comm communicator) {
  const MeshOptions mesh = with_enough_cells(scene, options);
  check_mesh_size(mesh);
  const CoarseMesh coarse = coarsen(scene, mesh);

  // Measured; on several processes a sixth more.
  constexpr double bytes_per_cell = 300;
  const double n_coarse = 1. * coarse.radial_cells * coarse.angular_cells,
               n_cells = std::ldexp(n_coarse, 2 * coarse.n_refinements);
  require_memory(bytes_per_cell * (n_coarse + n_cells / count_processes(communicator)), "the mesh",
                 communicator);

  auto grid = make_grid(radii_of(scene.inner_radius, scene.outer_radius, coarse.radial_cells),
                        angles_of(scene, coarse.angular_cells));
  const auto refine = [&](Triangulation<2>& triangulation) {
    join_seam(triangulation);
    triangulation.refine_global(coarse.n_refinements);
    if (const auto narrow = find_narrow_zone(scene, coarse.angular_cells))
      cut_to_zone(triangulation, scene, *narrow);
  };
  if (is_serial(communicator)) {
    refine(*grid);
    return grid;
  }
  // Cells change their process when a refinement is complete, and not before.
  using Distributed = parallel::distributed::Triangulation<2>;
  auto shared = std::make_unique<Distributed>(communicator, smoothing,
                                              Distributed::no_automatic_repartitioning);
  shared->copy_triangulation(*grid);
  refine(*shared);
  constexpr double even_shares = 100; // coarse cells on each process share the refined ones evenly
  if (n_coarse < even_shares * count_processes(communicator))
    shared->repartition();
  return shared;
}

} // namespace rollwave
