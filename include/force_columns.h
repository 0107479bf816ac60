#ifndef ROLLWAVE_FORCE_COLUMNS_H
#define ROLLWAVE_FORCE_COLUMNS_H

#include "force_integrals.h"
#include "force_jumps.h"
#include "force_lines.h"
#include "interval_map.h"

#include <deal.II/base/quadrature_lib.h>

#include <vector>

namespace rollwave {

struct Scene;

/// The lines z = const and the radial intervals at which the cells of a mesh need a force, many of
/// which they have in common: each is made when first asked for.
class ForceColumns {
public:
  /// @param gauss for a cell's angular interval [0, 1]
  /// @param extents those of the cells
  /// @param jumps where the lines' rules have to be exact
  ForceColumns(const Scene& scene, const ForceInterpolant& force, const dealii::QGauss<1>& gauss,
               const RadialExtents& extents, const ForceJumps& jumps);

  /// Those of the angular interval [begin, end].
  const ForceLines& on(double begin, double end);

  /// The same, made before.
  const ForceLines& made_on(double begin, double end) const { return lines.made(begin, end); }

  /// Any other, beyond the radius @p begin.
  ForceColumn at(double z, double begin) const { return force.column(z, begin); }

  /// On the radial interval [begin, end], whose shapes are @p radial.
  ForceLoads& loads(double begin, double end, const RadialShapes& radial);

  /// Whether the force is a number, the same on all lines.
  bool has_equal_lines() const { return force.is_exact(); }

private:
  const ForceInterpolant& force;
  const RadialExtents& extents;
  const ForceJumps& jumps;
  const std::vector<FinerRule> gauss; ///< of the cells, and with more points
  const double negligible;            ///< root mean square over z of what is missed of G
  IntervalMap<ForceLines> lines;
  IntervalMap<ForceLoads> known_loads;
};

} // namespace rollwave

#endif
