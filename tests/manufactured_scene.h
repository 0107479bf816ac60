#pragma once

#include "rollwave/exact/exact_solution.h"
#include "rollwave/scene/scene.h"

namespace rollwave {

struct ManufacturedScene {
  Scene scene;
  /// Loads other than F, peak pressure and accuracies are not computed and are 0.
  ExactSolution exact;
};

/**
 * A scene made to have the given pressure, for any ring, any speed, and an interval of contact
 * anywhere. The displacement of the surface follows from the compliances of BesselModes,
 *
 *     u(b, z) = -sum_k c_k lambda_k e^(i k z),   a(u, u) = 2 pi b sum_k c_k |lambda_k|^2,
 *
 * and the road is phi = u in contact and phi = u + gap_factor d^(3/2) b at the distance d from it.
 * The zone of possible contact is the interval of contact with @p zone_margin on both sides; with
 * no margin the pressure may be singular at the ends. Sums run over k < @p n_modes; what is left
 * out of u is of the order n_modes^-(1 + s) (n_modes^-s for a singular pressure).
 */
ManufacturedScene manufacture_scene(double inner_radius, double outer_radius,
                                    double angular_velocity, const GegenbauerPressure& pressure,
                                    double end_exponent, double gap_factor, double zone_margin,
                                    unsigned int n_modes);

} // namespace rollwave
