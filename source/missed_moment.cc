#include "missed_moment.h"

#include "force_integrals.h"
#include "interpolation.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace rollwave {

using namespace dealii;

/// The rule of a radial interval and a finer one.
class MissedMoment::RadialRules {
public:
  RadialRules(double begin, double end, const RadialShapesOfMesh& shapes,
              const std::vector<double>& radii)
      : rules(shapes.gauss(begin, end), QIterated<1>(shapes.gauss(begin, end), 2)),
        rule(shapes.rule(begin, end, rules.fine)), radii(radii), at_radii(radii),
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

  const FinerRule rules; ///< on one piece
  RadialRule rule;       ///< fine on each of its pieces
  const std::vector<double> radii;
  ForceAtRadii at_radii, at_fine_radii;
  std::vector<double> values, fine_values;
  unsigned int recent_piece = 0;
  double begin = 0, end = 0; ///< of the piece prepared last
  ForcePiece::Coefficients missed_norms;
};

MissedMoment::MissedMoment(RadialShapesOfMesh& shapes) : shapes(shapes) {}

MissedMoment::~MissedMoment() = default;

void MissedMoment::add_cell(const Point<2>& low, const Point<2>& high, const ForceLines& lines,
                            const RadialShapes& radial) {
  const double length = high[1] - low[1];
  along_z += lines.missed_mean_square * length * std::log(high[0] / low[0]);
  RadialRules& rules = *radial_rules.at(low[0], high[0], [&] {
    return std::make_unique<RadialRules>(low[0], high[0], shapes, radial.r);
  });
  for (unsigned int p = 0; p < lines.columns.size(); ++p)
    along_r += lines.rule.weight(p) * length * rules.missed_square(lines.columns[p]);
}

double MissedMoment::bound(MPI_Comm communicator) const {
  return std::sqrt(Utilities::MPI::sum(along_z, communicator)) +
         std::sqrt(Utilities::MPI::sum(along_r, communicator));
}

} // namespace rollwave
