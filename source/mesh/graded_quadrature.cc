#include "rollwave/mesh/graded_quadrature.h"

#include <algorithm>
#include <cmath>

namespace rollwave {

RadialRule graded_rule(double begin, double end, const dealii::Quadrature<1>& points) {
  const unsigned int n_pieces = std::max(1., std::ceil(std::log2(end / begin) - 1e-12));
  RadialRule rule;
  double piece_begin = begin;
  for (unsigned int piece = 1; piece <= n_pieces; ++piece) {
    const double piece_end =
        piece == n_pieces ? end : begin * std::pow(end / begin, double(piece) / n_pieces);
    for (unsigned int q = 0; q < points.size(); ++q) {
      rule.r.push_back(piece_begin + (piece_end - piece_begin) * points.point(q)[0]);
      rule.weight.push_back((piece_end - piece_begin) * points.weight(q));
    }
    piece_begin = piece_end;
  }
  return rule;
}

} // namespace rollwave
