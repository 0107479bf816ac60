#include "missed_moment.h"

#include "radial_rule.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/polynomial.h>
#include <deal.II/lac/full_matrix.h>

#include <cmath>

namespace rollwave {

using namespace dealii;

namespace {

/// The values at the points of a finer rule of the polynomials that are given at those of another.
FullMatrix<double> interpolation(const Quadrature<1>& gauss, const Quadrature<1>& fine) {
  const auto lagrange = Polynomials::generate_complete_Lagrange_basis(gauss.get_points());
  FullMatrix<double> matrix(fine.size(), gauss.size());
  for (unsigned int q = 0; q < fine.size(); ++q)
    for (unsigned int i = 0; i < gauss.size(); ++i)
      matrix(q, i) = lagrange[i].value(fine.point(q)[0]);
  return matrix;
}

/// The finer points of a radial interval.
struct FinerRadii {
  FinerRadii(double begin, double end, const QGauss<1>& gauss)
      : fine(gauss, 2), rule(graded_rule(begin, end, fine)), from_rule(interpolation(gauss, fine)),
        at_radii(rule.r) {}

  QIterated<1> fine;
  RadialRule rule;              ///< fine on each of its pieces
  FullMatrix<double> from_rule; ///< on one piece
  ForceAtRadii at_radii;
};

} // namespace

double missed_moment(const RingSpace& space, const ForceInterpolant& force,
                     RadialShapesOfMesh& shapes, ForceColumns& columns, const QGauss<1>& gauss) {
  const QIterated<1> fine(gauss, 2);
  ForceColumns fine_columns(force, fine);
  const FullMatrix<double> from_lines = interpolation(gauss, fine);
  const unsigned int n = gauss.size();
  IntervalMap<FinerRadii> known_radii;
  std::vector<std::vector<double>> at_rule(n), on_fine_lines(fine.size());
  std::vector<double> at_fine_radii;
  double along_z = 0, along_r = 0; // squares
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    const double length = high[1] - low[1];
    const auto& lines = columns.on(low[1], high[1]);
    const RadialShapes& radial = shapes.on(low[0], high[0]);
    ForceAtRadii& rule_radii = columns.at_radii(low[0], high[0], radial.r);
    FinerRadii& finer = known_radii.at(low[0], high[0], [&] {
      return FinerRadii(low[0], high[0], shapes.gauss(low[0], high[0]));
    });

    const auto& fine_lines = fine_columns.on(low[1], high[1]);
    for (unsigned int p = 0; p < n; ++p)
      rule_radii.integrals(lines[p], at_rule[p]);
    for (unsigned int p = 0; p < fine.size(); ++p)
      rule_radii.integrals(fine_lines[p], on_fine_lines[p]);
    for (unsigned int q = 0; q < radial.r.size(); ++q) {
      double square = 0;
      for (unsigned int p = 0; p < fine.size(); ++p) {
        double error = on_fine_lines[p][q];
        for (unsigned int i = 0; i < n; ++i)
          error -= from_lines(p, i) * at_rule[i][q];
        square += fine.weight(p) * error * error;
      }
      along_z += square * length * radial.weight[q] / radial.r[q];
    }

    const unsigned int n_fine = finer.from_rule.m(), n_rule = finer.from_rule.n();
    for (unsigned int p = 0; p < n; ++p) {
      finer.at_radii.integrals(lines[p], at_fine_radii);
      for (unsigned int q = 0; q < at_fine_radii.size(); ++q) {
        const unsigned int piece = q / n_fine;
        double error = at_fine_radii[q];
        for (unsigned int i = 0; i < n_rule; ++i)
          error -= finer.from_rule(q % n_fine, i) * at_rule[p][n_rule * piece + i];
        along_r +=
            gauss.weight(p) * length * finer.rule.weight[q] / finer.rule.r[q] * error * error;
      }
    }
  }
  const MPI_Comm communicator = space.communicator();
  return std::sqrt(Utilities::MPI::sum(along_z, communicator)) +
         std::sqrt(Utilities::MPI::sum(along_r, communicator));
}

} // namespace rollwave
