#pragma once

#include "rollwave/base/note.h"
#include "rollwave/base/run_statistics.h"
#include "rollwave/contact/contact_patch.h"
#include "rollwave/contact/load_control.h"
#include "rollwave/error_bound/error_bound.h"
#include "rollwave/scene/units.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace rollwave {

/// The size of a mesh and of its problem.
struct MeshFigures {
  unsigned int degree;
  unsigned int n_cells;
  unsigned int n_unknowns; ///< unknowns: hub, seam and hanging nodes are not counted
  unsigned int n_contact_nodes;
  double h_min; ///< smallest cell diameter in (r, b z), a length
  double h_max; ///< largest cell diameter in (r, b z), a length
};

/// Energies of the discrete displacement, for a unit of width.
struct Energy {
  double value;        ///< J(u_h)
  double norm_squared; ///< a(u_h, u_h)
};

/// One mesh of an adaptive run.
struct CycleFigures {
  unsigned int n_cells;
  unsigned int n_unknowns;
  unsigned int contact_steps;
  double road_distance;                       ///< c, a length
  double vertical_load;                       ///< see Loads
  std::optional<double> indicated = {};       ///< sqrt(sum eta_K^2), where the mesh was refined
  std::optional<double> certified = {};       ///< CertifiedError::relative
  std::optional<double> load_half_width = {}; ///< of the guaranteed interval of vertical_load
};

/// How well the optimality conditions hold, each relative to its own data; all zero is perfect.
struct Residuals {
  double equilibrium;       ///< |f - K u - N|_2 / max(|f|_2, |N|_2)
  double penetration;       ///< max (u_i - phi_i)^+ / max |u_i| on contact nodes
  double negative_pressure; ///< max (-lambda_i)^+ / max |lambda_i|
  double complementarity;   ///< sum |N_i (phi_i - u_i)| / sum |N_i phi_i|
  double allowed;           ///< wanted_residual or, where that is more, what rounding u leaves

  /// The largest of the four.
  double largest() const {
    return std::max({equilibrium, penetration, negative_pressure, complementarity});
  }
};

/// Errors against the exact solution.
struct TrueErrors {
  double energy_norm;          ///< sqrt(a(u - u_h, u - u_h))
  double relative_energy_norm; ///< over that of u
  bool is_resolved;            ///< true if the exact solution is accurate enough for it
  double l2_norm;              ///< (int r (u - u_h)^2 dr dz)^(1/2)
  /// (int r (e^2/b^2 + e_r^2 + e_z^2/r^2) dr dz)^(1/2) of e = u - u_h; not at the critical speed,
  /// where the energy does not bound it.
  std::optional<double> h1_norm;
  double pressure;                      ///< |lambda - lambda_h| in the norm of [.,.]_h
  double force;                         ///< |F - F_h|
  double energy;                        ///< |J(u) - J(u_h)|
  double half_width;                    ///< |w - w_h|
  std::optional<double> exact_distance; ///< where a load is given

  /// CertifiedError::energy_norm over energy_norm, where both are known.
  std::optional<double> effectivity;

  /// The order of the energy norm in h ~ unknowns^(-1/2) that theory expects. On uniform meshes:
  /// 1/2 where the zone cuts the contact short, otherwise the lesser of the degree and 3/2. On
  /// adaptive ones: the degree, or 3 if it is less and the zone cuts the contact short at the
  /// critical speed.
  double expected_order;
};

/// The numbers of one contact node; gap = phi - u.
struct ContactRow {
  double angle;
  double road_length; ///< along the road from its lowest point, see Road::arc_length()
  double displacement;
  double phi;
  double gap;
  double pressure;
  double weight; ///< an area: pressures times it add up to the force
};

/// A point of the deformed surface r = b.
struct SurfacePoint {
  double angle;
  double displacement;
  double pressure; ///< at the node, 0 outside of the zone
};

/// The results on one mesh, in the units of the scene.
struct MeshResult {
  ContactResultants contact = {};
  Energy energy = {}; ///< of u_h
  Residuals residuals = {};
  std::vector<DistanceStep> distance_history = {}; ///< where a load or nip is given
  std::vector<ContactStep> history = {};
  std::optional<StepLength> step_length = {}; ///< of Uzawa's method

  /// The calibrated shear modulus, which is that of the scene, over the given one; where load and
  /// nip are both given and met.
  std::optional<double> modulus_ratio = {};
  std::vector<Note> notes = {};
};

/// All results of one solved scene, those of its last mesh and further ones; result_quantities()
/// lists the numbers.
struct Result : MeshResult {
  MeshFigures mesh = {};
  double road_distance = 0; ///< c, a length
  double deflection = 0;    ///< b - c, a length: how deep the undeformed ring would lie in the road
  double relative_deflection = 0; ///< over the thickness b - a
  std::optional<CertifiedError> certified = {};
  std::optional<TrueErrors> errors = {}; ///< where a comparison was asked for
  std::vector<CycleFigures> cycles = {}; ///< one for each mesh
  bool is_interrupted = false;           ///< by the user: a shortfall says after what
  std::vector<ContactRow> contact_rows = {};
  std::vector<SurfacePoint> surface = {};
  RunStatistics statistics = {};
  std::optional<double> peak_memory_mib = {}; ///< the largest of all processes
};

} // namespace rollwave
