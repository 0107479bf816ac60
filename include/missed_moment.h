#ifndef ROLLWAVE_MISSED_MOMENT_H
#define ROLLWAVE_MISSED_MOMENT_H

#include "force_columns.h"
#include "radial_shapes.h"
#include "ring_space.h"

#include <deal.II/base/quadrature_lib.h>

namespace rollwave {

struct Scene;

/**
 * What a certificate misses of G = int_r^b rho f_0 drho (ForceInterpolant): a bound of ||G - G_h||
 * in the norm of int w^2 / r dr dz over the ring, where on each cell G_h is the polynomial that
 * equals G at the points of the rules, @p gauss along z and those of @p shapes along r. G_h does
 * not fit together on cells of different lengths, and so belongs to no flux in equilibrium.
 *
 * What is missed along z and what is missed along r are each taken at the points of the rule on
 * both halves of its intervals, and added. In their place are bounds by the coefficients of f_0
 * along r where a cell has but one polynomial, and along z where they add up to less than @p
 * negligible.
 *
 * @param columns with lines at the points of @p gauss
 */
double missed_moment(const RingSpace& space, const Scene& scene, const ForceInterpolant& force,
                     RadialShapesOfMesh& shapes, ForceColumns& columns,
                     const dealii::QGauss<1>& gauss, double negligible);

} // namespace rollwave

#endif
