#ifndef ROLLWAVE_FORCE_JUMPS_H
#define ROLLWAVE_FORCE_JUMPS_H

#include "force_interpolant.h"

#include <utility>
#include <vector>

namespace rollwave {

struct Scene;

/// f_0 on both sides of an angle in [0, 2 pi) where f jumps along z, and G = int_r^b rho f_0 drho
/// with it.
struct ForceJump {
  double z;
  ForceColumn before, after;
  double share; ///< of the jump of G that PotentialKinks take
};

/// Where f jumps on lines z = const.
class ForceJumps {
public:
  /// Nowhere.
  ForceJumps() = default;

  /// Kinks that take none of a jump g(r) of G leave t (1 - t) h_z int g^2 / r dr of it on a cell, t
  /// being its place there, and kinks that take all of it add (t (1 - t))^2 h_z^3 int g_s^2 ds / 3:
  /// they take the share with the least sum over the cells, which is small where these are long
  /// beside the height on which f jumps.
  ForceJumps(const ForceInterpolant& force, const Scene& scene, const RadialExtents& extents);

  /// The jumps in ]begin, end[ and where they are, perhaps in a later period.
  std::vector<std::pair<double, const ForceJump*>> within(double begin, double end) const;

private:
  std::vector<ForceJump> jumps; ///< by z
};

} // namespace rollwave

#endif
