#pragma once

#include "rollwave/base/note.h"
#include "rollwave/exact/exact_solution.h"
#include "rollwave/run/simulation.h"

#include <vector>

namespace rollwave {

/**
 * The errors of a discrete solution against the exact one. The energy norm needs no quadrature of
 * gradients: with the exact pressure lambda,
 *
 *     a(u - u_h, u - u_h) = a(u, u) - 2 a(u, u_h) + a(u_h, u_h),
 *     a(u, u_h) = (f, u_h) - b int lambda u_h dz.
 *
 * Cancellation hides relative errors below about 5e-6, or 3e-5 if the zone cuts the contact short
 * and the exact pressure is singular. An exact pressure that is not resolved may hide larger ones;
 * then a(u - v, u - v) is clearly more than 2 (J(v) - J(u)). The pressures are compared at the
 * nodes by the rule [.,.]_h, without nodes at which the exact one is singular.
 *
 * The L2 norm is taken by Gauss' rule, u being summed up from its modes at the points. So is the
 * part of the H^1 norm that the energy norm lacks: since 1/r^2 = alpha + omega^2,
 *
 *     int r (e_r^2 + e_z^2/r^2) dr dz = a(e, e) + omega^2 int r e_z^2 dr dz.
 *
 * @p exact must be that of the scene that @p solution solves.
 */
TrueErrors measure_true_errors(const Solution& solution, const ExactSolution& exact);

/// A shortfall for each guarantee of a result that the exact solution contradicts by more than its
/// own accuracy: the bound of the error in the energy norm, where the result has its true errors,
/// and the intervals of J, F and the vertical load. None is expected.
std::vector<Note> contradicted_guarantees(const Result& result, const ExactSolution& exact,
                                          const Units& units);

} // namespace rollwave
