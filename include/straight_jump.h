#ifndef ROLLWAVE_STRAIGHT_JUMP_H
#define ROLLWAVE_STRAIGHT_JUMP_H

#include <deal.II/base/point.h>

#include <optional>

namespace rollwave {

struct Scene;

/// The point of an interval at this share of it, but not so close to an end that a jump there,
/// placed with a rounding error, may be on the wrong side.
double point_within(double begin, double end, double share);

/// Where f jumps along r (direction 0) or z (1) on a rectangle with these corners, at the same
/// place on at least two of five lines in this direction: the first number beyond. Of jumps that
/// differ by no more than a tenth the one nearest to the middle; nullopt where f does not jump, nor
/// by as much as it changes on a twelfth of the rectangle.
std::optional<double> straight_jump(const Scene& scene, const dealii::Point<2>& low,
                                    const dealii::Point<2>& high, unsigned int direction);

/// Whether f jumps on any of these lines from one place to another, which are as good as one.
/// @param size that of f, of which a jump is more than a millionth
bool jumps_between(const Scene& scene, const dealii::Point<2>& low, const dealii::Point<2>& high,
                   unsigned int direction, double before, double beyond, double size);

} // namespace rollwave

#endif
