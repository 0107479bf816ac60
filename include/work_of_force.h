#ifndef ROLLWAVE_WORK_OF_FORCE_H
#define ROLLWAVE_WORK_OF_FORCE_H

#include "force_interpolant.h"
#include "ring_space.h"

namespace rollwave {

/// (f_0, w) = int r f_0 w dr dz, exact for a @p field w on any mesh of the ring; an area. The same
/// on all processes.
double work_of_force(const ForceInterpolant& force, const RingSpace& space,
                     const FieldVector& field);

} // namespace rollwave

#endif
