#ifndef ROLLWAVE_CONTACT_ENDS_H
#define ROLLWAVE_CONTACT_ENDS_H

#include "contact_solver.h"

namespace rollwave {

/**
 * Moves the ends of contact to where they belong, judged by a solution with the ends elsewhere.
 * @p active is the set of that solution, @p next the set after nodes of the wrong sign changed.
 *
 * Let the surface answer like the fractional Laplacian of order s, and x be the distance from an
 * end of the active set into contact. If the end lies e too far out, the pressure there is
 *
 *     lambda ~ x^(1-s) - (1-s) e x^(-s):
 *
 * it is negative up to x = (1-s) e, and its integral from the end up to x = (2-s) e. A third of the
 * first and two thirds of the second make (5/3 - s) e, between 2/3 e and 4/3 e for
 * s from 1/3 (critical speed) over 1/2 (below it) to 1 (cells so long in r that the surface is a
 * membrane). If the end lies e too far in, the gap is negative outside up to (1+s) e, and two
 * thirds of that lie between 8/9 e and 4/3 e. So the error of an end shrinks to a third or less.
 *
 * Where there is no contact yet, the surface penetrates a stretch of the road, of which contact is
 * what remains when it is pushed back: nearly all in rings that are thin beside it, half where
 * contact is short and the hub small. Three quarters are within a quarter of either.
 */
void move_ends(const ContactProblem& problem, const ContactSolution& solution,
               std::vector<bool>& next);

} // namespace rollwave

#endif
