#include "rollwave/run/remarks.h"

#include "rollwave/adapt/marking.h"
#include "rollwave/base/text.h"
#include "rollwave/mesh/ring_mesh.h"
#include "rollwave/mesh/surface_trace.h"

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>

namespace rollwave {

namespace {

/// How deep the surface lies in the road outside of the zone, where the road does not hold it.
double depth_outside(const Scene& scene, const Result& result) {
  double depth = 0;
  for (const SurfacePoint& point : result.surface)
    if (!scene.is_in_zone(point.angle) && scene.road.is_visible(from_lowest_point(point.angle)))
      depth = std::max(depth, point.displacement - scene.phi(point.angle));
  return depth;
}

/// True if u_h is beyond the road anywhere in the zone, between nodes as well.
bool passes_road(const Scene& scene, const SurfaceTrace& trace) {
  for (unsigned int i = 0; i < trace.edges().size(); ++i) {
    const SurfaceEdge& edge = trace.edges()[i];
    const double length = edge.end - edge.begin;
    const auto gap = [&](double t) {
      return scene.phi(edge.begin + t * length) - trace.value(i, t);
    };
    const double begin = std::max(0., (scene.zone_begin - edge.begin) / length),
                 end = std::min(1., (scene.zone_end - edge.begin) / length);
    constexpr int bits = 26; // of the place; the least gap has twice as many
    if (begin < end && boost::math::tools::brent_find_minima(gap, begin, end, bits).second < 0)
      return true;
  }
  return false;
}

/// On contact that ends where the zone does, other than at the tangent of a drum or around the
/// whole circle, where tangent_angle() is pi.
std::string remark_on_zone_ends(const Scene& scene, const Result& result) {
  const auto& ends = result.contact.ends;
  const double tangent = scene.road.tangent_angle();
  const auto is_cut = [&](double end, double zone_end) {
    return end == zone_end && std::abs(from_lowest_point(zone_end)) < (1 - 1e-9) * tangent;
  };
  if (!ends || !(is_cut(ends->first, scene.zone_begin) || is_cut(ends->second, scene.zone_end)))
    return {};
  return scene.has_given_zone
             ? "the zone cuts the contact short: the pressure is unbounded at its end, where "
               "peak_pressure grows with each refinement"
             : "contact reaches the end of the automatic zone, where phi = b; give a wider "
               "Road/Contact zone if it may go on";
}

/// On a surface that lies in the road outside of a zone that the user has given.
std::string remark_on_depth_outside(const Scene& scene, const Result& result) {
  const double depth = depth_outside(scene, result) / scene.outer_radius;
  if (!scene.has_given_zone || !(depth > 1e-9))
    return {};
  return "outside of the zone, where contact is not considered, the surface penetrates the road "
         "by " +
         rounded(depth, 2) + " b; give a wider Road/Contact zone";
}

/// On a relative bound of 1 or more.
std::string remark_on_certificate(const RunOptions& options, const Result& result) {
  if (!result.certified || result.certified->relative < 1)
    return {};
  if (std::isinf(result.certified->force_data))
    return "there is no bound: the force is singular (not square-integrable)";
  return "the certified relative error is 1 or more, so that no digit is certified" +
         std::string(options.mesh.wanted_relative_error > 0
                         ? ""
                         : "; refine, or set Mesh/Wanted relative error");
}

/// On a bound of which the force expression is the larger part.
std::string remark_on_force(const Result& result) {
  if (!result.certified || !std::isfinite(result.certified->energy_norm))
    return {};
  const double share = result.certified->force_data / result.certified->energy_norm;
  if (!(share > 0.5))
    return {};
  return "the force expression makes up " + rounded(100 * share, 2) +
         " % of the bound; put its jumps on edges of cells, or refine the mesh";
}

/// On a first mesh with more cells than the user has given.
std::string remark_on_first_mesh(const RunOptions& options, const Scene& scene) {
  const auto& mesh = options.mesh;
  const MeshOptions enough = with_enough_cells(scene, mesh);
  if (enough.radial_cells > mesh.radial_cells)
    return "the first mesh has " + std::to_string(enough.radial_cells) +
           " radial cells, which a hub this small needs, not " + std::to_string(mesh.radial_cells);
  if (enough.angular_cells > mesh.angular_cells)
    return "the first mesh has " + std::to_string(enough.angular_cells) +
           " angular cells, which a zone this narrow needs, not " +
           std::to_string(mesh.angular_cells);
  return {};
}

/// On contact that the mesh is too coarse for.
std::string remark_on_resolution(const MeshSolution& solution, const Result& result) {
  const unsigned int n_nodes = result.contact.active_nodes;
  std::string what;
  if (n_nodes == 0) {
    if (passes_road(solution.scene, {solution.boundary.space(), solution.displacement}))
      what = "the surface penetrates the road between nodes";
  } else if (n_nodes <= 2 * result.mesh.degree) // two cells with all of their nodes have one more
    what = "contact is held by " + std::to_string(n_nodes) + (n_nodes == 1 ? " node" : " nodes");
  if (what.empty())
    return {};
  return what + ", so that force, ends and pressure are not resolved; raise Mesh/Angular cells, "
                "or set Mesh/Wanted relative error";
}

/// On displacements that are large for a linear model.
std::string remark_on_displacement(const Scene& scene, const Result& result) {
  double largest = 0;
  for (const SurfacePoint& point : result.surface)
    largest = std::max(largest, std::abs(point.displacement));
  constexpr double most = 0.25; // of the thickness; the paper's scenes have up to a half
  const double share = largest / (scene.outer_radius - scene.inner_radius);
  if (!(share >= most))
    return {};
  return "the displacement is " + rounded(100 * share, 2) +
         " % of the ring's thickness, which stretches the linear model: it is meant for small ones";
}

/// On a speed above the critical one that is taken as the critical one, other than by round-off.
std::string remark_on_speed(const RunOptions& options) {
  const double omega = options.cylinder.angular_velocity,
               critical = critical_speed(options.cylinder, options.material);
  const std::string given = rounded(omega, 12), taken = rounded(critical, 12);
  return omega > critical && given != taken
             ? "the angular velocity " + given + " is taken as the critical speed " + taken
             : "";
}

/// On a drum that may be the radius in the place of the curvature.
std::string remark_on_curvature(const Scene& scene) {
  if (!(scene.road.curvature * scene.outer_radius > 10))
    return {};
  return "the drum's radius is " + rounded(scene.units.length / scene.road.curvature, 3) +
         ", less than a tenth of the cylinder's; Road/Curvature is one over the radius";
}

/// On the error, wanted but not reached.
std::string shortfall_of_error(const RunOptions& options, const Mesh& mesh, const Result& result) {
  const double wanted = options.mesh.wanted_relative_error;
  if (!(wanted > 0) || !result.certified || result.certified->relative <= wanted)
    return {};
  const std::string missed = "the certified relative error is " +
                             rounded_up(result.certified->relative, 6) + ", wanted " +
                             rounded(wanted, 6);
  if (result.is_interrupted)
    return missed;
  const bool is_limited =
      result.cycles.size() > most_cycles(options.mesh) ||
      !has_room_to_refine(*mesh.triangulation, options.mesh, most_cells(options));
  if (is_limited)
    return missed +
           "; raise Mesh/Most unknowns or Mesh/Adaptive cycles, or Mesh/Wanted relative error";
  return missed +
         (is_at_finest_level(*mesh.triangulation) ? "; the smallest cells cannot be cut again"
                                                  : "; further refinement does not lower it") +
         ": raise Mesh/Radial cells and Mesh/Angular cells, or Mesh/Wanted relative error";
}

/// On conditions of contact and equilibrium that do not hold to Residuals::allowed.
std::string shortfall_of_residuals(const RunOptions& options, const Residuals& residuals) {
  if (residuals.largest() <= residuals.allowed ||
      options.contact.method != ContactMethod::active_set)
    return {};
  return "the conditions of contact and equilibrium hold to " + rounded(residuals.largest(), 6) +
         " only, wanted " + rounded(residuals.allowed, 6) +
         ": use fewer unknowns, cells that are less stretched, or a larger hub";
}

} // namespace

std::vector<Note> notes_on(const RunOptions& options, const Mesh& mesh,
                           const MeshSolution& solution, const Result& result) {
  const Scene& scene = solution.scene;
  std::vector<Note> notes;
  for (const std::string& remark :
       {remark_on_zone_ends(scene, result), remark_on_depth_outside(scene, result),
        remark_on_certificate(options, result), remark_on_force(result),
        remark_on_first_mesh(options, scene), remark_on_resolution(solution, result),
        remark_on_displacement(scene, result), remark_on_speed(options),
        remark_on_curvature(scene)})
    if (!remark.empty())
      notes.push_back({Note::Kind::remark, remark});
  if (const std::string missed = shortfall_of_error(options, mesh, result); !missed.empty())
    notes.push_back({Note::Kind::shortfall, missed});
  else if (const std::string inexact = shortfall_of_residuals(options, result.residuals);
           !inexact.empty() && shortfall_text(result.notes).empty())
    notes.push_back({Note::Kind::shortfall, inexact});
  return notes;
}

} // namespace rollwave
