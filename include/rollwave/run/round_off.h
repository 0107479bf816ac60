#pragma once

#include "rollwave/mesh/ring_space.h"

namespace rollwave {

struct Scene;

/// About | |K| |u| |_2 times the unit round-off: the residual f - K u - N cannot be smaller, since
/// the entries of u are rounded. On a cell of the height h and the length l the entries of K are
/// about r l/h + r alpha h/l.
double equilibrium_round_off(const RingSpace& space, const Scene& scene, const FieldVector& u);

} // namespace rollwave
