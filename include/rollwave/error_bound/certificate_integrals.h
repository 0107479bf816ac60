#pragma once

#include "rollwave/error_bound/admissible_displacement.h"
#include "rollwave/error_bound/admissible_pressure.h"
#include "rollwave/error_bound/force_integral.h"
#include "rollwave/error_bound/load_bounds.h"

#include <array>
#include <vector>

namespace rollwave {

struct Scene;

/// The fields of a Certificate. v = displacement + c xi, where c is the correction of the trace,
/// and xi is linear from 0 to 1 across the row of cells at the surface.
struct AdmissibleFields {
  const FieldVector& discrete;     ///< u_h
  const FieldVector& displacement; ///< u_h, with the contact nodes on the road or before it
  const AdmissibleTrace& trace;
  const std::vector<EdgePressure>& pressures; ///< lambda
  const FieldVector& stress_function;         ///< psi
  const ForceIntegral* force;                 ///< nullptr without force
  const LoadFunctions& load_functions;
};

/// Integrals over dr, or sums of them. They have a higher precision, so that sums over very many
/// cells are more accurate than the bounds of J are apart.
struct CertificateIntegrals {
  long double bound_squared = 0; ///< eta^2
  long double gap_work = 0;      ///< the road's term alone, 2 b int lambda (phi - v) dz
  long double norm_squared = 0;
  long double work_of_force = 0;
  long double moved_squared = 0;    ///< a(v - u_h, v - u_h)
  long double discrete_squared = 0; ///< eta_0^2, the integral over cells of eta^2 for u_h
  std::array<LoadIntegrals, 2> loads = {};

  std::array<long double*, 12> all() {
    return {{&bound_squared, &gap_work, &norm_squared, &work_of_force, &moved_squared,
             &discrete_squared, &loads[0].trace, &loads[0].pressure, &loads[0].work_of_force,
             &loads[1].trace, &loads[1].pressure, &loads[1].work_of_force}};
  }

  void add(CertificateIntegrals other, double weight) {
    const auto sums = all(), terms = other.all();
    for (unsigned int i = 0; i < sums.size(); ++i)
      *sums[i] += weight * *terms[i];
  }
};

/// The integrals of a Certificate over the cells of all processes.
/// @param cell_bounds becomes Certificate::cell_bounds of the own cells
CertificateIntegrals integrate_certificate(const RingSpace& space, const Scene& scene,
                                           const AdmissibleFields& fields,
                                           const RadialShapesOfMesh& shapes,
                                           std::vector<double>& cell_bounds);

} // namespace rollwave
