#include "depth.h"

#include "scene.h"

#include <boost/math/quadrature/gauss.hpp>

#include <cmath>

namespace rollwave {

double depth_between(const Scene& scene, double inner, double outer) {
  // The only singularity is at r = 0: on pieces whose ends have the ratio 3/2 at most, ten points
  // are exact to round-off.
  const int n_pieces = std::max(1., std::ceil(std::log(outer / inner) / std::log(1.5)));
  double sum = 0, begin = inner;
  for (int piece = 1; piece <= n_pieces; ++piece) {
    const double end = piece == n_pieces
                           ? outer
                           : inner * std::pow(outer / inner, static_cast<double>(piece) / n_pieces);
    sum += boost::math::quadrature::gauss<double, 10>::integrate(
        [&](double r) { return r * scene.alpha(r); }, begin, end);
    begin = end;
  }
  return sum;
}

} // namespace rollwave
