#ifndef ROLLWAVE_POTENTIAL_KINKS_H
#define ROLLWAVE_POTENTIAL_KINKS_H

#include "force_jumps.h"

#include <deal.II/base/point.h>

#include <optional>
#include <vector>

namespace rollwave {

/**
 * What is added to a potential psi (DualPotential) on a cell within which G jumps along z, so that
 * the difference of G and psi_z does not: for each ForceJump, at t_e = (z_e - begin) / h_z,
 *
 *     g_e(r) h_z (max(t - t_e, 0) - (1 - t_e) t),   t = (z - begin) / h_z,
 *
 * g_e being the share of the jump of G at the radial nodes of the cell. It vanishes at both ends of
 * the angular interval and on r = b. On a part of that interval it differs from that of the part by
 * a linear function of z, so that values at nodes make psi continuous where lengths differ.
 */
class PotentialKinks {
public:
  /// Of the angular interval [begin, end] at the radii @p nodes, increasing.
  PotentialKinks(const ForceJumps& jumps, double begin, double end,
                 const std::vector<double>& nodes);

  /// Adds the values at t and the derivatives by z there, one for each node.
  void add_to(double t, double* values, double* derivatives) const;

private:
  struct Kink {
    double t;
    std::vector<double> jump; ///< g_e at the nodes
  };

  double length;
  std::vector<Kink> kinks;
};

/// Those of a cell with these corners, nullopt where G does not jump.
std::optional<PotentialKinks> kinks_of_cell(const ForceJumps& jumps, const dealii::Point<2>& low,
                                            const dealii::Point<2>& high, unsigned int degree);

} // namespace rollwave

#endif
