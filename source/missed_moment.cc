#include "missed_moment.h"

#include "contact_free.h"
#include "interpolation.h"
#include "radial_rule.h"
#include "scene.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace rollwave {

using namespace dealii;

namespace {

/// A rule for [0, 1] that is exact for squares of polynomials as G is in z on parts with these ends
/// and as G_h is; with fewer points on parts so short that they add nothing but where G jumps.
Quadrature<1> rule_on_parts(const std::vector<double>& ends, unsigned int n_points) {
  constexpr unsigned int n_on_short = 3;
  constexpr double short_part = 0.01;
  std::vector<Point<1>> points;
  std::vector<double> weights;
  for (unsigned int part = 0; part + 1 < ends.size(); ++part) {
    const double share = ends[part + 1] - ends[part];
    const QGauss<1> gauss(share < short_part ? n_on_short : n_points);
    for (unsigned int q = 0; q < gauss.size(); ++q) {
      points.emplace_back(ends[part] + share * gauss.point(q)[0]);
      weights.push_back(share * gauss.weight(q));
    }
  }
  return {points, weights};
}

} // namespace

/// The rule of a radial interval and a finer one.
class MissedMoment::RadialRules {
public:
  RadialRules(double begin, double end, const QGauss<1>& gauss, const std::vector<double>& radii)
      : rules(gauss), rule(graded_rule(begin, end, rules.fine)), radii(radii), at_radii(radii),
        at_fine_radii(rule.r) {}

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
    const unsigned int n_fine = rules.fine.size(), n = rules.rule.size();
    double square = 0;
    for (unsigned int q = 0; q < of_fine.size(); ++q) {
      double missed = of_fine[q];
      for (unsigned int i = 0; i < n; ++i)
        missed -= rules.interpolation(q % n_fine, i) * of_rule[n * (q / n_fine) + i];
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

  const HalvedRule rules; ///< on one piece
  RadialRule rule;        ///< fine on each of its pieces
  const std::vector<double> radii;
  ForceAtRadii at_radii, at_fine_radii;
  std::vector<double> values, fine_values;
  unsigned int recent_piece = 0;
  double begin = 0, end = 0; ///< of the piece prepared last
  ForcePiece::Coefficients missed_norms;
};

MissedMoment::MissedMoment(const Scene& scene, const ForceInterpolant& force,
                           RadialShapesOfMesh& shapes, ForceColumns& columns,
                           const QGauss<1>& gauss)
    : force(force), shapes(shapes), columns(columns), angular(gauss),
      negligible_mean_square(
          std::pow(force.negligible(), 2) /
          (2 * numbers::PI * log_of_ratio(scene.outer_radius, scene.inner_radius))) {}

MissedMoment::~MissedMoment() = default;

MissedMoment::FineLines MissedMoment::find_fine_lines(double begin, double end) const {
  FineLines finer;
  std::vector<double> ends = {0};
  for (const double z : force.panel_ends(begin, end))
    ends.push_back((z - begin) / (end - begin));
  ends.push_back(1);
  if (ends.size() == 2) {
    finer.mean_square = std::pow(force.missed_along_z(begin, end, angular), 2);
    if (finer.mean_square <= negligible_mean_square)
      return finer;
  }
  const Quadrature<1> fine =
      rule_on_parts(ends, std::max<unsigned int>(ForcePiece::n_coefficients, angular.rule.size()));
  finer.weights = fine.get_weights();
  finer.from_rule = interpolation(angular.rule, fine);
  finer.columns = force.columns(begin, end, fine);
  return finer;
}

double MissedMoment::FineLines::missed_square(const std::vector<ForceColumn>& lines,
                                              const RadialShapes& radial,
                                              ForceAtRadii& at_radii) const {
  const unsigned int n_q = radial.r.size();
  std::vector<double> of_rule(lines.size() * n_q), values;
  for (unsigned int i = 0; i < lines.size(); ++i) {
    at_radii.integrals(lines[i], values);
    std::copy(values.begin(), values.end(), &of_rule[i * n_q]);
  }
  double square = 0;
  for (unsigned int p = 0; p < columns.size(); ++p) {
    at_radii.integrals(columns[p], values);
    for (unsigned int q = 0; q < n_q; ++q) {
      double missed = values[q];
      for (unsigned int i = 0; i < lines.size(); ++i)
        missed -= from_rule(p, i) * of_rule[i * n_q + q];
      square += weights[p] * radial.weight_over_r[q] * missed * missed;
    }
  }
  return square;
}

void MissedMoment::add_cell(const Point<2>& low, const Point<2>& high,
                            const std::vector<ForceColumn>& lines, const RadialShapes& radial) {
  const double length = high[1] - low[1];
  const FineLines& finer =
      fine_lines.at(low[1], high[1], [&] { return find_fine_lines(low[1], high[1]); });
  if (finer.columns.empty())
    along_z += finer.mean_square * length * std::log(high[0] / low[0]);
  else
    along_z +=
        length * finer.missed_square(lines, radial, columns.at_radii(low[0], high[0], radial));

  RadialRules& rules = *radial_rules.at(low[0], high[0], [&] {
    return std::make_unique<RadialRules>(low[0], high[0], shapes.gauss(low[0], high[0]), radial.r);
  });
  for (unsigned int p = 0; p < lines.size(); ++p)
    along_r += angular.rule.weight(p) * length * rules.missed_square(lines[p]);
}

double MissedMoment::bound(MPI_Comm communicator) const {
  return std::sqrt(Utilities::MPI::sum(along_z, communicator)) +
         std::sqrt(Utilities::MPI::sum(along_r, communicator));
}

} // namespace rollwave
