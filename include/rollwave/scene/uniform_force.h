#pragma once

namespace rollwave {

/// ln(b/a), accurate in thin rings as well.
double log_of_ratio(double outer_radius, double inner_radius);

/**
 * The displacement under the force density 1 without contact, an area,
 *
 *     u_1(r) = -(r^2 - a^2)/4 + (b^2/2) ln(r/a),
 *
 * in a form in which nothing cancels, however thin the ring is.
 */
double contact_free_unit_displacement(double inner_radius, double outer_radius, double r);

/// int_a^b r u_1(r) dr = int_a^b (b^2 - r^2)^2 / (4 r) dr: the work of that force for each radian,
/// a length to the fourth.
double contact_free_unit_work(double inner_radius, double outer_radius);

} // namespace rollwave
