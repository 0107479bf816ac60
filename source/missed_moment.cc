#include "missed_moment.h"

#include "contact_free.h"
#include "interpolation.h"
#include "radial_rule.h"
#include "scene.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace rollwave {

using namespace dealii;

namespace {

bool have_equal_pieces(const ForceColumn& one, const ForceColumn& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](const ForcePiece& a, const ForcePiece& b) {
                      return a.begin == b.begin && a.end == b.end;
                    });
}

/// The rule along z and a finer one.
struct AngularRules {
  explicit AngularRules(const QGauss<1>& gauss)
      : fine(gauss, 2), from_rule(interpolation(gauss, fine)) {}

  /// A bound, for any radius, of the mean square of what is missed of G in an angular interval,
  /// from its @p lines at both rules' points. Since Legendre polynomials other than the first have
  /// no mean, |int_t^1 L_k| <= (t (1 - t))^(1/2) <= 1/2. Infinite where pieces differ.
  double bound(const std::vector<ForceColumn>& lines,
               const std::vector<ForceColumn>& fine_lines) const {
    for (const auto* const columns : {&lines, &fine_lines})
      for (const ForceColumn& column : *columns)
        if (!have_equal_pieces(column, lines[0]))
          return std::numeric_limits<double>::infinity();
    double mean_square = 0;
    for (unsigned int p = 0; p < fine.size(); ++p) {
      double largest = 0;
      for (unsigned int s = 0; s < fine_lines[p].size(); ++s) {
        ForcePiece missed = fine_lines[p][s];
        for (unsigned int i = 0; i < lines.size(); ++i) {
          missed.outside -= from_rule(p, i) * lines[i][s].outside;
          for (unsigned int k = 0; k < ForcePiece::n_coefficients; ++k)
            missed.coefficients[k] -= from_rule(p, i) * lines[i][s].coefficients[k];
        }
        double sum = std::abs(missed.coefficients[0]);
        for (unsigned int k = 1; k < ForcePiece::n_coefficients; ++k)
          sum += std::abs(missed.coefficients[k]) / 2;
        largest = std::max(largest, std::abs(missed.outside) + (missed.end - missed.begin) * sum);
      }
      mean_square += fine.weight(p) * largest * largest;
    }
    return mean_square;
  }

  /// The mean over z of the integral of w^2 / r dr of what is missed of G on a cell.
  double missed_square(const std::vector<ForceColumn>& lines,
                       const std::vector<ForceColumn>& fine_lines, const RadialShapes& radial,
                       ForceAtRadii& at_radii) const {
    const unsigned int n_q = radial.r.size();
    std::vector<double> of_rule(lines.size() * n_q), values;
    for (unsigned int i = 0; i < lines.size(); ++i) {
      at_radii.integrals(lines[i], values);
      std::copy(values.begin(), values.end(), &of_rule[i * n_q]);
    }
    double square = 0;
    for (unsigned int p = 0; p < fine.size(); ++p) {
      at_radii.integrals(fine_lines[p], values);
      for (unsigned int q = 0; q < n_q; ++q) {
        double missed = values[q];
        for (unsigned int i = 0; i < lines.size(); ++i)
          missed -= from_rule(p, i) * of_rule[i * n_q + q];
        square += fine.weight(p) * radial.weight_over_r[q] * missed * missed;
      }
    }
    return square;
  }

  QIterated<1> fine;
  FullMatrix<double> from_rule;
};

/// The rule of a radial interval and a finer one.
class RadialRules {
public:
  RadialRules(double begin, double end, const QGauss<1>& gauss, const std::vector<double>& radii)
      : fine(gauss, 2), rule(graded_rule(begin, end, fine)), from_rule(interpolation(gauss, fine)),
        radii(radii), at_radii(radii), at_fine_radii(rule.r) {}

  /// int w^2 / r dr of what is missed of G on a line, or a bound of it.
  double missed_square(const ForceColumn& line) {
    recent_piece = piece_at(line, rule.r.front(), recent_piece);
    const ForcePiece& piece = line[recent_piece];
    if (rule.r.back() <= piece.end) {
      if (begin != piece.begin || end != piece.end)
        prepare(piece);
      double sum = 0;
      for (unsigned int k = 0; k < ForcePiece::n_coefficients; ++k)
        sum += std::abs(piece.coefficients[k]) * missed_norms[k];
      return sum * sum;
    }
    at_radii.integrals(line, values);
    at_fine_radii.integrals(line, fine_values);
    return missed_square(values, fine_values);
  }

private:
  double missed_square(const std::vector<double>& of_rule, const std::vector<double>& of_fine) {
    const unsigned int n_fine = from_rule.m(), n = from_rule.n();
    double square = 0;
    for (unsigned int q = 0; q < of_fine.size(); ++q) {
      double missed = of_fine[q];
      for (unsigned int i = 0; i < n; ++i)
        missed -= from_rule(q % n_fine, i) * of_rule[n * (q / n_fine) + i];
      square += rule.weight[q] / rule.r[q] * missed * missed;
    }
    return square;
  }

  /// The norms of what is missed of the integrals of Legendre's polynomials of a piece.
  void prepare(const ForcePiece& piece) {
    begin = piece.begin;
    end = piece.end;
    std::vector<ForcePiece::Coefficients> of_rule, of_fine;
    for (const double r : radii)
      of_rule.push_back(legendre_integrals(begin, end, r));
    for (const double r : rule.r)
      of_fine.push_back(legendre_integrals(begin, end, r));
    values.resize(radii.size());
    fine_values.resize(rule.r.size());
    for (unsigned int k = 0; k < ForcePiece::n_coefficients; ++k) {
      for (unsigned int q = 0; q < values.size(); ++q)
        values[q] = of_rule[q][k];
      for (unsigned int q = 0; q < fine_values.size(); ++q)
        fine_values[q] = of_fine[q][k];
      missed_norms[k] = std::sqrt(missed_square(values, fine_values));
    }
  }

  QIterated<1> fine;
  RadialRule rule;              ///< fine on each of its pieces
  FullMatrix<double> from_rule; ///< on one piece
  const std::vector<double> radii;
  ForceAtRadii at_radii, at_fine_radii;
  std::vector<double> values, fine_values;
  unsigned int recent_piece = 0;
  double begin = 0, end = 0; ///< of the piece prepared last
  ForcePiece::Coefficients missed_norms;
};

/// Lines at the finer points of an angular interval, if they have to be looked at.
struct FineLines {
  double bound; ///< of AngularRules
  std::vector<ForceColumn> columns;
};

} // namespace

double missed_moment(const RingSpace& space, const Scene& scene, const ForceInterpolant& force,
                     RadialShapesOfMesh& shapes, ForceColumns& columns, const QGauss<1>& gauss,
                     double negligible) {
  const AngularRules angular(gauss);
  const double negligible_mean_square =
      negligible * negligible /
      (2 * numbers::PI * log_of_ratio(scene.outer_radius, scene.inner_radius));
  IntervalMap<FineLines> fine_lines;
  IntervalMap<RadialRules> radial_rules;
  double along_z = 0, along_r = 0; // squares
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    const double length = high[1] - low[1];
    const auto& lines = columns.on(low[1], high[1]);
    const RadialShapes& radial = shapes.on(low[0], high[0]);

    const FineLines& finer = fine_lines.at(low[1], high[1], [&] {
      std::vector<ForceColumn> all;
      for (const auto& point : angular.fine.get_points())
        all.push_back(force.column(low[1] + length * point[0]));
      const double bound = angular.bound(lines, all);
      if (bound <= negligible_mean_square)
        all.clear();
      return FineLines{bound, std::move(all)};
    });
    if (finer.columns.empty())
      along_z += finer.bound * length * std::log(high[0] / low[0]);
    else
      along_z += length * angular.missed_square(lines, finer.columns, radial,
                                                columns.at_radii(low[0], high[0], radial));

    RadialRules& rules = radial_rules.at(low[0], high[0], [&] {
      return RadialRules(low[0], high[0], shapes.gauss(low[0], high[0]), radial.r);
    });
    for (unsigned int p = 0; p < gauss.size(); ++p)
      along_r += gauss.weight(p) * length * rules.missed_square(lines[p]);
  }
  const MPI_Comm communicator = space.communicator();
  return std::sqrt(Utilities::MPI::sum(along_z, communicator)) +
         std::sqrt(Utilities::MPI::sum(along_r, communicator));
}

} // namespace rollwave
