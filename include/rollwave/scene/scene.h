#pragma once

#include "rollwave/scene/body_force.h"
#include "rollwave/scene/loads.h"
#include "rollwave/scene/road.h"
#include "rollwave/scene/units.h"

#include <deal.II/base/numbers.h>

#include <optional>
#include <string>
#include <tuple>
#include <utility>

namespace rollwave {

/// Section `Cylinder`; all options are in the user's units.
struct CylinderOptions {
  double inner_radius = 0.5;
  double outer_radius = 1;
  double angular_velocity = 0.5;
  std::string radial_force = "0";

  auto members() const {
    return std::tie(inner_radius, outer_radius, angular_velocity, radial_force);
  }
  bool operator==(const CylinderOptions& other) const { return members() == other.members(); }
};

/// Section `Road`.
struct RoadOptions {
  double distance = 0.8;
  std::optional<double> load; ///< a force
  std::optional<double> nip;  ///< the length of contact
  LoadKind load_kind = LoadKind::vertical;
  double curvature = 0;
  std::optional<std::pair<double, double>> contact_zone; ///< angles; nullopt: automatic

  auto members() const { return std::tie(distance, load, nip, load_kind, curvature, contact_zone); }
  /// False if the distance is a result.
  bool has_distance() const { return !load && !nip; }

  /// True if the shear modulus is a result.
  bool calibrates() const { return load && nip; }

  bool operator==(const RoadOptions& other) const { return members() == other.members(); }
};

/// Angles that are closer are the same: those of a mesh carry round-off of a few units in the last
/// place.
constexpr double angular_round_off = 1e-13;

/// True if the angle @p z lies in the zone, except for round-off.
inline bool lies_in_zone(double z, const std::pair<double, double>& zone) {
  return zone.first - angular_round_off <= z && z <= zone.second + angular_round_off;
}

/**
 * An elastic ring rolling steadily over a road, after D. Ross and M. Bercovier, "Traveling waves in
 * a cylinder rolling on a flat surface", M2AN 25 (1991) 129-149.
 *
 * The unknown is the radial displacement u(r, z) on Omega = (a, b) x [0, 2 pi), periodic in the
 * angle z, which rests with the axle. With alpha(r) = 1/r^2 - omega^2 it obeys
 *
 *     -alpha u_zz - (1/r) (r u_r)_r = f            in Omega
 *     u = 0                                        on r = a
 *     u_r = 0                                      on r = b off the contact zone
 *     u <= phi,  u_r <= 0,  (u - phi) u_r = 0      on r = b in the contact zone [z0, z1]
 *
 * and is the minimiser of J(v) = a(v, v)/2 - (f, v) over the v <= phi on the contact zone with
 * v = 0 on r = a, where, r dr dz being the area element in polar coordinates,
 *
 *     a(u, v) = int r (alpha u_z v_z + u_r v_r) dr dz,    (f, v) = int r f v dr dz.
 *
 * The contact pressure is lambda = -u_r(b, z) >= 0. The bilinear form is elliptic for omega < 1/b;
 * at omega = 1/b alpha vanishes on r = b and the problem is degenerate there.
 *
 * The unit of length is the power of two with 1 <= b < 2, so that no number overflows. Scaling a
 * scene by a power of two changes no digit. The shear modulus, the wave speed and the width are 1
 * as well. All results are in these units; Scene::units converts them to the user's.
 */
struct Scene {
  double inner_radius;     ///< a, a length
  double outer_radius;     ///< b, a length
  double angular_velocity; ///< omega, one over a length (the wave speed is 1)

  BodyForce force;
  Obstacle phi; ///< of the road

  double zone_begin; ///< z0, an angle; the zone may begin at any angle
  double zone_end;   ///< z1 in (z0, z0 + 2 pi]; the zone may be the whole circle

  /// [z0, z1]
  std::pair<double, double> zone() const { return {zone_begin, zone_end}; }

  bool is_in_zone(double z) const { return lies_in_zone(z, zone()); }

  Units units = {}; ///< of the scene, in the user's

  Road road = {}; ///< its distance is a first guess if load or nip are given

  /// The load that is given instead of the distance, a length.
  struct Load {
    double value;
    LoadKind kind;
  };
  std::optional<Load> load = {};

  /// The length of contact that is given instead of the distance, a length. If the load is given as
  /// well, the shear modulus is a result: see calibrated().
  std::optional<double> nip = {};

  /// False if the distance is a result.
  bool has_distance() const { return !load && !nip; }

  double least_distance = 0;   ///< lower limit of the distance
  bool has_given_zone = false; ///< true if the user gave the zone

  /// alpha(r) = 1/r^2 - omega^2, factored so that it stays accurate near omega = 1/r.
  double alpha(double r) const { return (1 / r - angular_velocity) * (1 / r + angular_velocity); }
};

/// The critical speed (mu/rho)^(1/2)/b in the user's units.
double critical_speed(const CylinderOptions& cylinder, const MaterialOptions& material);

/// The refusal of a force that is not finite at a point, r in the scene's units.
std::string force_not_finite_at(const Scene& scene, double r, double z);

/// The scene with its road moved to the distance @p c below the axle, a length. The zone stays.
Scene with_distance(Scene scene, double c);

/// The scene with @p ratio times its shear modulus and density, so that the wave speed stays. In
/// the units of the scene only the given load changes, since it is relative to the shear modulus.
Scene calibrated(Scene scene, double ratio);

/**
 * The scene that options describe, in its units.
 *
 * @param angular_cells of the first mesh, for the margin of an automatic zone
 * A speed that is the critical one rounded to six digits or more is taken as the critical one.
 *
 * @throws BadValue unless 1e-150 b <= a < b, 0 <= omega <= critical speed, a < c, c < 2 b with an
 * automatic zone, -1/kappa > b and c for kappa < 0, kappa b <= 1e10, pi < z0 < z1 < 2 pi and the
 * force can be parsed and is finite.
 */
Scene scaled_scene(const CylinderOptions& cylinder, const RoadOptions& road,
                   const MaterialOptions& material, unsigned int angular_cells);

} // namespace rollwave
