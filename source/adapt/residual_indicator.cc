#include "rollwave/adapt/residual_indicator.h"

#include "rollwave/adapt/cell_field.h"
#include "rollwave/mesh/ring_space.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/numerics/error_estimator.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace rollwave {

using namespace dealii;

namespace {

/// How often parts of the certified error count that are what they are, since the squares of
/// residuals are larger than those of the errors they stand for. With 2 certified errors are a
/// tenth larger, with 50 the true ones are (doc/decisions.md).
constexpr double exact_parts_weight = 10;

using SpaceCell = DoFHandler<2>::active_cell_iterator;

/// The squares of the lengths, over r, that turn a residual into the energy norm of what a cell
/// cannot resolve, by the direction in which that varies.
struct Lengths {
  double radial;  ///< h_r^2 / r
  double angular; ///< h_z^2 / (alpha r)
  double both() const { return std::min(radial, angular); }
};

class ResidualTerms {
public:
  ResidualTerms(const RingSpace& space, const Scene& scene, const FieldVector& field)
      : scene(scene), field(field), n(space.dof_handler().get_fe().degree + 1), gauss(n),
        inside(n - 1, points_of(0, 1)), halves{{LineShapes(n - 1, points_of(0, 0.5)),
                                                LineShapes(n - 1, points_of(0.5, 1))}},
        ends(n - 1, {0, 1}), dofs(space.dof_handler()), modes(n) {
    for (unsigned int degree = 0; degree < n; ++degree)
      for (unsigned int q = 0; q < n; ++q)
        modes[degree][q] = gauss.weight(q) * Polynomials::Legendre(degree).value(gauss.point(q)[0]);
  }

  CellField field_on(const SpaceCell& cell);
  double cell_term(const CellField& u) const;
  double edge_term(const SpaceCell& cell, const CellField& u);
  double contact_term(const CellField& u, const SurfaceFace& face, const SideValues& pressure,
                      bool is_partly_free, double negligible_gap) const;

private:
  std::vector<double> points_of(double begin, double end) const {
    std::vector<double> points;
    for (const auto& point : gauss.get_points())
      points.push_back(begin + (end - begin) * point[0]);
    return points;
  }

  Lengths lengths_of(const CellField& u) const;
  double weighted_square(const std::array<SideValues, highest_degree + 1>& residual,
                         const Lengths& length) const;
  SideValues flux(const CellField& u, unsigned int f, double begin, double end) const;

  /// The coefficient of Legendre's polynomial of this degree, from @p values at the points.
  double mode(unsigned int degree, const SideValues& values) const {
    return std::inner_product(modes[degree].begin(), modes[degree].end(), values.begin(), 0.);
  }

  const Scene& scene;
  const FieldVector& field;
  const unsigned int n; ///< nodes, and points, on each side of a cell
  const QGauss<1> gauss;
  const LineShapes inside;
  const std::array<LineShapes, 2> halves;
  const LineShapes ends;
  LexicographicDofs dofs;
  std::vector<SideValues> modes; ///< Legendre's polynomials at the points, with their weights
};

CellField ResidualTerms::field_on(const SpaceCell& cell) {
  CellField u = {n, cell->vertex(0), cell->vertex(3) - cell->vertex(0), {}};
  const auto& of_cell = dofs.of(cell);
  for (unsigned int i = 0; i < n * n; ++i)
    u.nodal[i] = field(of_cell[i]);
  return u;
}

Lengths ResidualTerms::lengths_of(const CellField& u) const {
  const double middle = u.low[0] + u.size[0] / 2,
               thickness = scene.outer_radius - scene.inner_radius;
  // What varies in z has no more room between hub and surface than what varies in r.
  return {u.size[0] * u.size[0] / middle,
          std::min(u.size[1] * u.size[1] / scene.alpha(middle), thickness * thickness) / middle};
}

/// The mean over a cell of the square of a residual, z in rows, with the length of its direction
/// for what varies in one direction only, and the lesser length for all else.
double ResidualTerms::weighted_square(const std::array<SideValues, highest_degree + 1>& residual,
                                      const Lengths& length) const {
  SideValues of_z = {}, of_r = {};
  double mean = 0;
  for (unsigned int p = 0; p < n; ++p)
    for (unsigned int q = 0; q < n; ++q) {
      of_z[p] += gauss.weight(q) * residual[p][q];
      of_r[q] += gauss.weight(p) * residual[p][q];
      mean += gauss.weight(p) * gauss.weight(q) * residual[p][q];
    }
  double sum = 0;
  for (unsigned int p = 0; p < n; ++p) {
    sum += gauss.weight(p) * (length.angular * std::pow(of_z[p] - mean, 2) +
                              length.radial * std::pow(of_r[p] - mean, 2));
    for (unsigned int q = 0; q < n; ++q)
      sum += gauss.weight(p) * gauss.weight(q) * length.both() *
             std::pow(residual[p][q] - of_z[p] - of_r[q] + 2 * mean, 2);
  }
  return sum;
}

/// The residual inside of a cell, and the modes of the fluxes that the bound cannot represent.
double ResidualTerms::cell_term(const CellField& u) const {
  const double h_r = u.size[0], h_z = u.size[1];
  std::array<SideValues, highest_degree + 1> residual = {}, u_z_rows = {}, u_r_columns = {};
  for (unsigned int p = 0; p < n; ++p)
    for (unsigned int q = 0; q < n; ++q) {
      const double r = u.low[0] + h_r * gauss.point(q)[0], z = u.low[1] + h_z * gauss.point(p)[0];
      const double u_r = u.sum(inside.first[q], inside.value[p]) / h_r,
                   u_rr = u.sum(inside.second[q], inside.value[p]) / (h_r * h_r),
                   u_zz = u.sum(inside.value[q], inside.second[p]) / (h_z * h_z);
      const double f = scene.force ? scene.force(r, std::fmod(z, 2 * numbers::PI)) : 0;
      residual[p][q] = r * f + u_r + r * u_rr + r * scene.alpha(r) * u_zz;
      u_r_columns[q][p] = u_r;
      u_z_rows[p][q] = u.sum(inside.value[q], inside.first[p]) / h_z;
    }
  const double middle = u.low[0] + h_r / 2;
  double unbalanced = 0;
  for (unsigned int q = 0; q < n; ++q)
    unbalanced += gauss.weight(q) * middle *
                  (std::pow(mode(n - 1, u_r_columns[q]), 2) +
                   scene.alpha(middle) * std::pow(mode(n - 1, u_z_rows[q]), 2));
  return h_r * h_z * (weighted_square(residual, lengths_of(u)) + exact_parts_weight * unbalanced);
}

/// The flux over face @p f, r u_r or r alpha u_z, at the points between two places along it: its
/// ends, or an end and the middle where the cell beyond is finer.
SideValues ResidualTerms::flux(const CellField& u, unsigned int f, double begin, double end) const {
  const unsigned int normal = f / 2, along = 1 - normal;
  const bool is_whole = end - begin > 0.75 * u.size[along],
             is_upper = begin - u.low[along] > 0.25 * u.size[along];
  const LineShapes& shapes = is_whole ? inside : halves[is_upper];
  const SideValues& across = ends.first[f % 2];
  SideValues result = {};
  for (unsigned int q = 0; q < n; ++q)
    if (normal == 0)
      result[q] = (u.low[0] + f * u.size[0]) / u.size[0] * u.sum(across, shapes.value[q]);
    else {
      const double r = begin + (end - begin) * gauss.point(q)[0];
      result[q] = r * scene.alpha(r) / u.size[1] * u.sum(shapes.value[q], across);
    }
  return result;
}

/// The jumps of the fluxes over the faces, half of each.
double ResidualTerms::edge_term(const SpaceCell& cell, const CellField& u) {
  const Lengths length = lengths_of(u);
  double square = 0;
  for (const unsigned int f : cell->face_indices())
    for (const SpaceCell& beyond : neighbours(cell, f)) {
      const unsigned int normal = f / 2, along = 1 - normal;
      const CellField other = field_on(beyond);
      const double begin = std::max(u.low[along], other.low[along]),
                   end =
                       std::min(u.low[along] + u.size[along], other.low[along] + other.size[along]);
      SideValues jump = flux(u, f, begin, end);
      const SideValues of_other = flux(other, f ^ 1U, begin, end);
      double whole = 0;
      for (unsigned int q = 0; q < n; ++q) {
        jump[q] -= of_other[q];
        whole += gauss.weight(q) * jump[q] * jump[q];
      }
      const double mean = std::pow(mode(0, jump), 2);
      square +=
          (end - begin) / (2 * u.size[normal]) *
          ((normal == 0 ? length.radial : length.angular) * mean + length.both() * (whole - mean));
    }
  return square;
}

/// What is wrong at an edge on r = b, @p pressure given at its nodes.
/// @param is_partly_free whether the edge may touch the road, but not with all of its nodes
double ResidualTerms::contact_term(const CellField& u, const SurfaceFace& face,
                                   const SideValues& pressure, bool is_partly_free,
                                   double negligible_gap) const {
  const double b = scene.outer_radius, h_r = u.size[0], h_z = u.size[1];
  const double resistance = lengths_of(u).both() / h_r;
  SideValues pressures = {};
  double square = 0;
  for (unsigned int q = 0; q < n; ++q) {
    double& lambda = pressures[q];
    for (unsigned int k = 0; k < n; ++k)
      lambda += inside.value[q][k] * pressure[k];
    const double weight = gauss.weight(q) * h_z;
    const double imbalance = b * (u.sum(ends.first[1], inside.value[q]) / h_r + lambda);
    square += resistance * weight * imbalance * imbalance;
    const double z = face.begin + (face.end - face.begin) * gauss.point(q)[0];
    if (!is_partly_free || z < scene.zone_begin || z > scene.zone_end)
      continue;
    const double gap = scene.road(z) - u.sum(ends.value[1], inside.value[q]);
    // The point may be an active node, where the gap is of either sign.
    if (gap >= -negligible_gap)
      square += exact_parts_weight * 2 * b * weight * std::max(0., lambda) * std::max(0., gap);
    else {
      const double steepness = u.sum(ends.value[1], inside.first[q]) / h_z - scene.road_slope(z);
      const double alpha = scene.alpha(u.low[0] + h_r / 2);
      square += exact_parts_weight * b * weight *
                (gap * gap / h_r + alpha * h_r / 3 * steepness * steepness);
    }
  }
  // The modes of the pressure which the bound lacks: those between the linear ones and the highest
  for (unsigned int degree = 2; degree + 1 < n; ++degree)
    square += exact_parts_weight * resistance * h_z * b * b * std::pow(mode(degree, pressures), 2);
  return square;
}

} // namespace

std::vector<double> residual_indicator(const RingSpace& space, const Scene& scene,
                                       const ContactProblem& problem,
                                       const ContactSolution& contact, const FieldVector& field) {
  // What linear solvers and Uzawa's method leave at active nodes is not the mesh's error.
  double negligible_gap = 0;
  for (const double gap : problem.gaps(contact.state.displacement))
    negligible_gap = std::max(negligible_gap, -gap);
  negligible_gap += wanted_residual * contact.state.displacement.linfty_norm();

  const Vector<double> pressures = problem.pressures(contact.state.force);
  ResidualTerms terms(space, scene, field);
  std::vector<double> indicators(space.dof_handler().get_triangulation().n_active_cells());
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const CellField u = terms.field_on(cell);
    double square = terms.cell_term(u) + terms.edge_term(cell, u);
    if (const auto edge = space.surface_face(cell)) {
      const SurfaceFace& face = space.surface_faces()[*edge];
      SideValues pressure = {};
      unsigned int n_active = 0, n_contact = 0;
      for (unsigned int k = 0; k < face.nodes.size(); ++k)
        if (const auto node = space.contact_number(face.nodes[k])) {
          pressure[k] = pressures(*node);
          n_active += contact.active[*node];
          ++n_contact;
        }
      square += terms.contact_term(u, face, pressure, n_contact > 0 && n_active < face.nodes.size(),
                                   negligible_gap);
    }
    indicators[cell->active_cell_index()] = std::sqrt(square);
  }
  return indicators;
}

std::vector<double> kelly_indicator(const RingSpace& space, const FieldVector& field) {
  Vector<float> indicators(space.dof_handler().get_triangulation().n_active_cells());
  KellyErrorEstimator<2>::estimate(space.mapping(), space.dof_handler(),
                                   QGauss<1>(space.dof_handler().get_fe().degree + 1), {}, field,
                                   indicators);
  return {indicators.begin(), indicators.end()};
}

} // namespace rollwave
