#ifndef ROLLWAVE_MISSED_MOMENT_H
#define ROLLWAVE_MISSED_MOMENT_H

#include "force_columns.h"
#include "interpolation.h"
#include "interval_map.h"
#include "radial_shapes.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>
#include <deal.II/base/quadrature_lib.h>

#include <memory>
#include <vector>

namespace rollwave {

struct Scene;

/**
 * What a certificate misses of G = int_r^b rho f_0 drho (ForceInterpolant): a bound of ||G - G_h||
 * in the norm of int w^2 / r dr dz over the ring, where on each cell G_h is the polynomial that
 * equals G at the points of the rules, Gauss' one along z and those of the RadialShapes along r.
 * G_h does not fit together on cells of different lengths, and so belongs to no flux in
 * equilibrium.
 *
 * What is missed along z, where G may jump, is integrated exactly between the ends of panels, and
 * what is missed along r is taken at the points of the rule on both halves of its intervals. Both
 * are added. In their place are bounds by the coefficients of f_0 along r where a cell has but one
 * polynomial, and along z where no panel ends and they add up to less than
 * ForceInterpolant::negligible().
 */
class MissedMoment {
public:
  /// @param columns with lines at the points of @p gauss
  MissedMoment(const Scene& scene, const ForceInterpolant& force, RadialShapesOfMesh& shapes,
               ForceColumns& columns, const dealii::QGauss<1>& gauss);
  ~MissedMoment();

  /// A cell with these corners; @p lines and @p radial are those of its intervals.
  void add_cell(const dealii::Point<2>& low, const dealii::Point<2>& high,
                const std::vector<ForceColumn>& lines, const RadialShapes& radial);

  /// The bound for the cells of all processes.
  double bound(MPI_Comm communicator) const;

private:
  class RadialRules;

  /// Lines between the ends of panels in an angular interval, if they have to be looked at.
  struct FineLines {
    double mean_square = 0; ///< of what is missed of G, for any radius, if there are no lines
    std::vector<ForceColumn> columns;
    std::vector<double> weights;
    dealii::FullMatrix<double> from_rule; ///< interpolation from the points of the rule

    /// The mean over z of the integral of w^2 / r dr of what is missed of G on a cell along z.
    double missed_square(const std::vector<ForceColumn>& lines, const RadialShapes& radial,
                         ForceAtRadii& at_radii) const;
  };

  FineLines find_fine_lines(double begin, double end) const;

  const ForceInterpolant& force;
  RadialShapesOfMesh& shapes;
  ForceColumns& columns;
  const HalvedRule angular;
  const double negligible_mean_square;
  IntervalMap<FineLines> fine_lines;
  IntervalMap<std::unique_ptr<RadialRules>> radial_rules;
  double along_z = 0, along_r = 0; ///< squares
};

} // namespace rollwave

#endif
