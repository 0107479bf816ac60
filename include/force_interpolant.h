#ifndef ROLLWAVE_FORCE_INTERPOLANT_H
#define ROLLWAVE_FORCE_INTERPOLANT_H

#include "ring_space.h"

#include <deal.II/lac/full_matrix.h>

#include <array>
#include <vector>

namespace rollwave {

struct Scene;

/// f_0 on a line z = const, from one radius to another.
struct ForcePiece {
  static constexpr unsigned int n_coefficients = 8;

  double begin, end;                               ///< radii
  std::array<double, n_coefficients> coefficients; ///< of rho f_0, by Legendre polynomials in r
  double outside;                                  ///< G(end, z)
};

/// f_0 on a line z = const, from the hub outwards.
using ForceColumn = std::vector<ForcePiece>;

/**
 * A piecewise polynomial f_0 in place of the force f, with an integral
 *
 *     G(r, z) = int_r^b rho f_0(rho, z) drho
 *
 * that is known everywhere: on each of a number of panels, which cover the ring, rho f_0 is the
 * polynomial of degree 7 in each direction that equals rho f at Gauss' points.
 *
 * Panels are halved until each has a small share of the mesh's cells, then the worst first until
 * f_0 is f but for round-off, as many as the mesh pays for.
 */
class ForceInterpolant {
public:
  /// The same on all processes of the space. The scene must have a force.
  /// @throws BadInput where f is not finite
  ForceInterpolant(const RingSpace& space, const Scene& scene);

  ForceColumn column(double z) const;

  /// Whether f_0 is f itself.
  bool is_exact() const { return exact; }

  /// ||f - f_0|| in the norm of int r w^2 dr dz, taken on twice as many points in each direction.
  double error() const;

private:
  struct Panel {
    dealii::Point<2> low, high;
    unsigned int first_half = 0;             ///< among the panels, the second follows; 0: is whole
    unsigned int direction = 0;              ///< in which it was halved
    dealii::FullMatrix<double> coefficients; ///< of rho f_0, in r and z
    double error_squared = 0, norm_squared = 0;
  };

  /// Halves the panels that have more than their share of the cells.
  void halve_where_fine(const dealii::Triangulation<2>& triangulation);

  void halve(unsigned int panel, unsigned int direction);
  void collect(unsigned int panel, double z, ForceColumn& column) const;

  static void interpolate(const Scene& scene, Panel& panel);

  const bool exact;
  std::vector<Panel> panels; ///< the ring first, halves after their whole
};

} // namespace rollwave

#endif
