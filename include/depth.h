#ifndef ROLLWAVE_DEPTH_H
#define ROLLWAVE_DEPTH_H

namespace rollwave {

struct Scene;

/**
 * The coordinate s(r) = int_r^b rho alpha(rho) drho, in which the weight 1/(r alpha) of the dual
 * problem becomes 1 at every speed: the difference
 *
 *     s(@p inner) - s(@p outer) = int_inner^outer rho alpha(rho) drho >= 0
 *
 * for a <= inner <= outer <= b. Its relative accuracy is that of 1 - omega r, also for thin layers
 * at the surface and the critical speed, where the difference of two values of s would cancel.
 */
double depth_between(const Scene& scene, double inner, double outer);

} // namespace rollwave

#endif
