#include "radial_shapes.h"

#include "potential_shapes.h"
#include "scene.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

RadialShapesOfMesh::RadialShapesOfMesh(const Scene& scene, unsigned int degree,
                                       unsigned int n_points)
    : scene(scene), lagrange(lobatto_lagrange(degree)), n_points(n_points) {}

const RadialShapes& RadialShapesOfMesh::on(double begin, double end) {
  const auto key = std::pair(begin, end);
  // Cells of a uniform mesh come from the inside out, one row after another.
  if (recent == known.end() || ++recent == known.end())
    recent = known.begin();
  if (recent == known.end() || recent->first != key)
    recent = known.find(key);
  if (recent == known.end())
    recent = known.emplace(key, make(begin, end)).first;
  return recent->second;
}

RadialShapes RadialShapesOfMesh::make(double begin, double end) const {
  const QGauss<1> gauss(n_points);
  const unsigned int n_pieces = std::max(1., std::ceil(std::log2(end / begin) - 1e-12));
  RadialShapes shapes;
  shapes.begin = begin;
  shapes.end = end;
  const PotentialShapes potential_shapes(scene, lagrange.size() - 1, begin, end);
  double piece_begin = begin;
  for (unsigned int piece = 1; piece <= n_pieces; ++piece) {
    const double piece_end =
        piece == n_pieces ? end : begin * std::pow(end / begin, double(piece) / n_pieces);
    for (unsigned int q = 0; q < gauss.size(); ++q) {
      shapes.r.push_back(piece_begin + (piece_end - piece_begin) * gauss.point(q)[0]);
      shapes.weight.push_back((piece_end - piece_begin) * gauss.weight(q));
    }
    piece_begin = piece_end;
  }

  const unsigned int n_q = shapes.r.size(), n = lagrange.size();
  std::vector<double> both(2);
  for (unsigned int q = 0; q < n_q; ++q) {
    const double r = shapes.r[q];
    shapes.alpha.push_back(scene.alpha(r));
    const std::vector<double> values = potential_shapes.values(r);
    const std::vector<double> derivatives = potential_shapes.depth_derivatives(r);
    shapes.shapes.emplace_back();
    for (unsigned int i = 0; i < n; ++i) {
      lagrange[i].value((r - begin) / (end - begin), both);
      shapes.shapes[q].push_back({both[0], both[1] / (end - begin), values[i], derivatives[i]});
    }
  }
  shapes.products = {FullMatrix<double>(n), FullMatrix<double>(n)};
  for (unsigned int q = 0; q < n_q; ++q)
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j) {
        const double r = shapes.r[q], weight = shapes.weight[q];
        const RadialShape &one = shapes.shapes[q][i], &other = shapes.shapes[q][j];
        shapes.products.stiffness(i, j) +=
            one.potential_s * other.potential_s * weight * r * shapes.alpha[q]; // ds = r alpha dr
        shapes.products.mass(i, j) += one.potential * other.potential * weight / r;
      }
  return shapes;
}

} // namespace rollwave
