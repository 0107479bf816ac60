#ifndef ROLLWAVE_REFERENCE_H
#define ROLLWAVE_REFERENCE_H

#include "certificate.h"
#include "exact_solution.h"
#include "result.h"
#include "ring_space.h"

#include <functional>
#include <string>
#include <vector>

namespace rollwave {

/// A continuous function w on r = b in pieces that are smooth, by increasing angle; the angles are
/// those of SurfaceFace.
struct SurfacePiece {
  double begin;
  double end;
  std::function<double(double z)> value;
};
using SurfaceFunction = std::vector<SurfacePiece>;

/// What errors are measured against: the solution u of a scene, known much better than the one in
/// question.
struct Reference {
  std::string name; ///< what it is, as in "against NAME"
  double own_error; ///< in the energy norm: what is certified, or the floor that cancellation sets
  double force;
  double energy;
  double norm_squared;
  double half_width;

  /// b int lambda w dz
  std::function<double(const SurfaceFunction& w)> contact_work;

  /// (f, w) of a field, where the load's quadrature is not exact; else empty.
  std::function<double(const RingSpace& space, const FieldVector& field)> work_of_force;

  /// lambda(z), or nullopt where it is infinite
  std::function<std::optional<double>(double z)> pressure;

  /// The L2 norm of u - u_h; empty where u is not known inside.
  std::function<double(const RingSpace& space, const FieldVector& field)> l2_distance;

  /// The order in h of the energy norm of the error on uniform meshes, for elements of a degree.
  std::function<double(unsigned int degree)> expected_order;
};

/// The semi-analytic solution, with integrals of lambda by Gauss' rules that know its ends.
Reference exact_reference(const ExactSolution& exact);

/**
 * A discrete solution @p result on @p space with its certificate, by its contact forces N_i:
 * b int lambda w dz = sum_i N_i w(z_i), and a(u, u) = -2 (J(u) + b int lambda phi dz). Errors are
 * known to within its own, certified error, about which @p name should tell. The work of a force
 * that is no number is that of the certificate's f_0 everywhere: what that leaves out of f then
 * acts on errors alone, not on the displacement.
 */
Reference discrete_reference(const Scene& scene, const RingSpace& space, const Result& result,
                             const Certificate& certificate, const std::string& name);

} // namespace rollwave

#endif
