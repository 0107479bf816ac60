#ifndef ROLLWAVE_STRAIGHT_JUMP_H
#define ROLLWAVE_STRAIGHT_JUMP_H

#include "force_panel.h"

#include <optional>

namespace rollwave {

/// Where f jumps on a panel along r or z, at the same place on at least two of three lines in this
/// direction: the first number beyond. nullopt where it does not.
std::optional<double> straight_jump(const Scene& scene, const ForcePanel& panel,
                                    unsigned int direction);

/// Whether f jumps like that from one place to another, which are as good as one.
bool jumps_between(const Scene& scene, const ForcePanel& panel, unsigned int direction,
                   double before, double beyond);

} // namespace rollwave

#endif
