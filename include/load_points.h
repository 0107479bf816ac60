#ifndef ROLLWAVE_LOAD_POINTS_H
#define ROLLWAVE_LOAD_POINTS_H

#include "force_panels.h"
#include "interval_map.h"
#include "radial_extents.h"
#include "ring_space.h"

#include <deal.II/base/quadrature_lib.h>

#include <vector>

namespace rollwave {

/// m = rho (f - f_0) at the points of the load on a panel, weighted by area. Only where these are
/// closer to each other than the panel's own, in r or in z.
struct MissedAtLoadPoints {
  unsigned int n_points = 0;
  double mean = 0, mean_square = 0;
};

/// r f at the points at which the load takes it, by columns of cells.
class LoadPoints {
public:
  /// @param moments r f, cell by cell (Load); stays where it is
  /// @param extents those of the space
  LoadPoints(const RingSpace& space, const std::vector<double>& moments,
             const RadialExtents& extents);

  /// For each panel from number @p first on, none where it is not a part. The same on all
  /// processes.
  std::vector<MissedAtLoadPoints> missed(const ForcePanels& panels, unsigned int first);

private:
  /// Legendre polynomials at a radius, on the panel met last.
  struct Legendre {
    double r;
    double begin = 0, end = 0; ///< of the panel; 0 before the first
    ForcePiece::Coefficients values = {};

    void turn_to(const ForcePiece& piece);
  };

  struct RadialInterval {
    double begin, length;
    std::vector<Legendre> points;
  };

  struct Cell {
    RadialInterval* radial;
    const double* moments;
  };

  struct Column {
    RadialExtent extent;
    std::vector<Cell> cells;
  };

  const MPI_Comm communicator;
  const dealii::QGauss<1> gauss;
  IntervalMap<RadialInterval> radial_intervals;
  IntervalMap<Column> columns;
};

} // namespace rollwave

#endif
