#ifndef ROLLWAVE_RUN_CERTIFICATE_SCHEDULE_H
#define ROLLWAVE_RUN_CERTIFICATE_SCHEDULE_H

#include "rollwave/run/result.h"

#include <algorithm>
#include <cmath>

namespace rollwave {

/**
 * Which meshes of an adaptive run are certified besides the last one, where an error is wanted:
 * those whose bound may be small enough, if it has about kept its ratio to the indicator since it
 * was computed last, and those with three times the unknowns of that mesh, or a third of its
 * indicator.
 */
class CertificateSchedule {
public:
  explicit CertificateSchedule(double wanted) : wanted(wanted) {}

  bool is_due(const Result& result) const {
    constexpr double margin = 1.3; // a mesh too many costs more than a certificate
    const double indicated = result.cycles.back().indicated,
                 bound = bound_over_indicator * indicated,
                 norm = std::sqrt(result.energy.norm_squared);
    return wanted > 0 &&
           (result.mesh.dofs >= 3. * last_unknowns || 3 * indicated <= last_indicated ||
            bound <= margin * wanted * std::max(norm - bound, 0.));
  }

  void note(const Result& result) {
    last_unknowns = result.mesh.dofs;
    last_indicated = result.cycles.back().indicated;
    bound_over_indicator = result.certified->energy_norm / last_indicated;
  }

private:
  const double wanted;
  double last_unknowns = 0, last_indicated = 0, bound_over_indicator = 0;
};

} // namespace rollwave

#endif
