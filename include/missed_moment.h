#ifndef ROLLWAVE_MISSED_MOMENT_H
#define ROLLWAVE_MISSED_MOMENT_H

#include "force_lines.h"
#include "interval_map.h"
#include "radial_shapes.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <memory>

namespace rollwave {

/**
 * What a certificate misses of G = int_r^b rho f_0 drho (ForceInterpolant): a bound of ||G - G_h||
 * in the norm of int w^2 / r dr dz over the ring, where on each cell G_h is the polynomial that
 * equals G at the points of the rules, those of the RadialShapes along r and those of its
 * ForceLines along z, or G itself along z where these are exact. G_h does not fit together on cells
 * of different lengths, and so belongs to no flux in equilibrium.
 *
 * What is missed along z is that of the ForceLines; what is missed along r is taken at the points
 * of the rule on both halves of its intervals, or, where a cell has but one polynomial along r,
 * bounded by its coefficients. Both are added.
 */
class MissedMoment {
public:
  explicit MissedMoment(RadialShapesOfMesh& shapes);
  ~MissedMoment();

  /// A cell with these corners; @p lines and @p radial are those of its intervals.
  void add_cell(const dealii::Point<2>& low, const dealii::Point<2>& high, const ForceLines& lines,
                const RadialShapes& radial);

  /// The bound for the cells of all processes.
  double bound(MPI_Comm communicator) const;

private:
  class RadialRules;

  RadialShapesOfMesh& shapes;
  IntervalMap<std::unique_ptr<RadialRules>> radial_rules;
  double along_z = 0, along_r = 0; ///< squares
};

} // namespace rollwave

#endif
