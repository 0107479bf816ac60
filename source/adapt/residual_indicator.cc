#include "rollwave/adapt/residual_indicator.h"

#include "rollwave/adapt/cell_lines.h"
#include "rollwave/mesh/lexicographic_dofs.h"
#include "rollwave/mesh/ring_mesh.h"
#include "rollwave/mesh/tensor_elements.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// On a line through a cell.
constexpr unsigned int most_nodes = highest_degree + 1;
using NodeValues = std::array<double, most_nodes>;

/// How often parts of the certified error count that are what they are, since the squares of
/// residuals are larger than those of the errors they stand for. With 2 certified errors are a
/// tenth larger, with 50 the true ones are (doc/adaptivity.md).
constexpr double exact_parts_weight = 10;

/// Shape functions on [0, 1] with two derivatives at some points.
struct LineShapes {
  std::vector<NodeValues> value, first, second;

  LineShapes(unsigned int degree, const std::vector<double>& points) {
    std::vector<double> all(3);
    const auto lagrange = lobatto_lagrange(degree);
    for (const double t : points) {
      for (auto* const list : {&value, &first, &second})
        list->emplace_back();
      for (unsigned int i = 0; i <= degree; ++i) {
        lagrange[i].value(t, all);
        value.back()[i] = all[0];
        first.back()[i] = all[1];
        second.back()[i] = all[2];
      }
    }
  }
};

std::vector<double> mapped(const std::vector<Point<1>>& points, double begin, double end) {
  std::vector<double> result;
  for (const auto& point : points)
    result.push_back(begin + (end - begin) * point[0]);
  return result;
}

/// u on one cell by its nodal values, the radial index running fastest.
struct CellField {
  explicit CellField(unsigned int n) : n(n) {}

  unsigned int n;
  std::array<double, most_nodes * most_nodes> nodal;

  double sum(const NodeValues& radial, const NodeValues& angular) const {
    double result = 0;
    for (unsigned int j = 0; j < n; ++j) {
      double row = 0;
      for (unsigned int i = 0; i < n; ++i)
        row += radial[i] * nodal[i + n * j];
      result += angular[j] * row;
    }
    return result;
  }
};

struct Rectangle {
  double r0, r1, z0, z1;
  double height() const { return r1 - r0; }
  double length() const { return z1 - z0; }
};

Rectangle rectangle_of(const DoFHandler<2>::active_cell_iterator& cell) {
  const Point<2> low = cell->vertex(0), high = cell->vertex(3);
  return {low[0], high[0], low[1], high[1]};
}

/// r f on one cell: the polynomial of a degree less than the element's that equals it at Gauss'
/// points. What is left varies too fast for the residual to tell how large its error is.
class ForceMoment {
public:
  /// @param rule at whose points it is asked for, in each direction
  ForceMoment(unsigned int degree, const Quadrature<1>& rule)
      : gauss(degree), to_points(rule.size(), degree), at_gauss(degree) {
    const auto lagrange = Polynomials::generate_complete_Lagrange_basis(gauss.get_points());
    for (unsigned int q = 0; q < rule.size(); ++q)
      for (unsigned int i = 0; i < degree; ++i)
        to_points(q, i) = lagrange[i].value(rule.point(q)[0]);
  }

  void reinit(const Scene& scene, const Rectangle& box) {
    for (unsigned int j = 0; j < gauss.size(); ++j) {
      const double z = std::fmod(box.z0 + box.length() * gauss.point(j)[0], 2 * numbers::PI);
      for (unsigned int i = 0; i < gauss.size(); ++i) {
        const double r = box.r0 + box.height() * gauss.point(i)[0];
        at_gauss(j, i) = r * scene.force(r, z);
      }
    }
  }

  double value(unsigned int p, unsigned int q) const {
    double sum = 0;
    for (unsigned int j = 0; j < gauss.size(); ++j)
      for (unsigned int i = 0; i < gauss.size(); ++i)
        sum += to_points(p, j) * to_points(q, i) * at_gauss(j, i);
    return sum;
  }

private:
  const QGauss<1> gauss;
  FullMatrix<double> to_points, at_gauss; ///< rows of the latter in z
};

/// The squares of the lengths, over r, that turn a residual into the energy norm of what a cell
/// cannot resolve, by the direction in which that varies.
struct Lengths {
  double radial;  ///< h_r^2 / r
  double angular; ///< h_z^2 / (alpha r)
  double both() const { return std::min(radial, angular); }
};

Lengths lengths_of(const Rectangle& box, const Scene& scene) {
  const double middle = (box.r0 + box.r1) / 2, thickness = scene.outer_radius - scene.inner_radius;
  // What varies in z has no more room between hub and surface than what varies in r.
  return {box.height() * box.height() / middle,
          std::min(box.length() * box.length() / scene.alpha(middle), thickness * thickness) /
              middle};
}

/// At the points of a product of rules on a cell, z in rows and r in columns.
using ResidualValues = std::array<NodeValues, most_nodes>;

/// The mean over a cell of the square of a residual, its values at the points of @p rule in each
/// direction, with the length of its direction for what varies in one direction only, and the
/// lesser length for all else.
double weighted_square(unsigned int n, const ResidualValues& residual, const QGauss<1>& rule,
                       const Lengths& length) {
  NodeValues of_z = {}, of_r = {};
  double mean = 0;
  for (unsigned int p = 0; p < n; ++p)
    for (unsigned int q = 0; q < n; ++q) {
      of_z[p] += rule.weight(q) * residual[p][q];
      of_r[q] += rule.weight(p) * residual[p][q];
      mean += rule.weight(p) * rule.weight(q) * residual[p][q];
    }
  double sum = 0;
  for (unsigned int p = 0; p < n; ++p) {
    sum += rule.weight(p) * (length.angular * std::pow(of_z[p] - mean, 2) +
                             length.radial * std::pow(of_r[p] - mean, 2));
    for (unsigned int q = 0; q < n; ++q)
      sum += rule.weight(p) * rule.weight(q) * length.both() *
             std::pow(residual[p][q] - of_z[p] - of_r[q] + 2 * mean, 2);
  }
  return sum;
}

/// With @p n nodes on each side of a cell.
std::vector<double> indicate(unsigned int n, const RingSpace& space, const Scene& scene,
                             const ContactProblem& problem, const ContactSolution& contact,
                             const FieldVector& field) {
  const auto& triangulation = space.dof_handler().get_triangulation();
  const unsigned int degree = n - 1;
  const QGauss<1> gauss(n);
  const auto& points = gauss.get_points();
  const LineShapes inside(degree, mapped(points, 0, 1)), ends(degree, {0, 1});
  const std::vector<LineShapes> halves = {LineShapes(degree, mapped(points, 0, 0.5)),
                                          LineShapes(degree, mapped(points, 0.5, 1))};
  LexicographicDofs dofs(space.dof_handler());
  const auto gather = [&](const auto& cell) {
    CellField u(n);
    const auto& of_cell = dofs.of(cell);
    for (unsigned int i = 0; i < n * n; ++i)
      u.nodal[i] = field(of_cell[i]);
    return u;
  };

  const CellLines lines(space);
  const Polynomials::Legendre highest(degree);
  std::vector<double> highest_mode(n); // of the rule's points, with their weights
  for (unsigned int q = 0; q < n; ++q)
    highest_mode[q] = gauss.weight(q) * highest.value(points[q][0]);
  std::vector<double> jump(triangulation.n_raw_lines() * n);
  std::vector<double> squares(triangulation.n_active_cells());
  std::vector<Lengths> lengths(triangulation.n_active_cells());
  ForceMoment moment(degree, gauss);
  ResidualValues residual;
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (cell->is_artificial())
      continue;
    const Rectangle box = rectangle_of(cell);
    const CellField u = gather(cell);
    const double h_r = box.height(), h_z = box.length(), per_r = 1 / h_r, per_z = 1 / h_z;
    const Lengths length = lengths[cell->active_cell_index()] = lengths_of(box, scene);
    NodeValues alpha_r; // at the points of the rule
    for (unsigned int q = 0; q < n; ++q) {
      const double r = box.r0 + h_r * points[q][0];
      alpha_r[q] = scene.alpha(r) * r;
    }

    if (scene.force)
      moment.reinit(scene, box);
    NodeValues radial_mode = {}, angular_mode = {};
    for (unsigned int p = 0; p < n; ++p) {
      // Along the line z = const: u and its first two derivatives by z at the radial nodes
      NodeValues line, line_z, line_zz;
      for (unsigned int i = 0; i < n; ++i) {
        line[i] = line_z[i] = line_zz[i] = 0;
        for (unsigned int j = 0; j < n; ++j) {
          line[i] += inside.value[p][j] * u.nodal[i + n * j];
          line_z[i] += inside.first[p][j] * u.nodal[i + n * j];
          line_zz[i] += inside.second[p][j] * u.nodal[i + n * j];
        }
        line_z[i] *= per_z;
        line_zz[i] *= per_z * per_z;
      }
      const auto sum = [n](const NodeValues& radial, const NodeValues& on_line) {
        double result = 0;
        for (unsigned int i = 0; i < n; ++i)
          result += radial[i] * on_line[i];
        return result;
      };
      for (unsigned int q = 0; q < n; ++q) {
        const double r = box.r0 + h_r * points[q][0];
        const double u_r = sum(inside.first[q], line) * per_r;
        residual[p][q] = u_r;
        if (degree > 1)
          residual[p][q] += r * sum(inside.second[q], line) * per_r * per_r +
                            alpha_r[q] * sum(inside.value[q], line_zz);
        if (scene.force)
          residual[p][q] += moment.value(p, q);
        radial_mode[q] += highest_mode[p] * u_r;
        angular_mode[p] += highest_mode[q] * sum(inside.value[q], line_z);
      }
    }
    const double middle = (box.r0 + box.r1) / 2, alpha = scene.alpha(middle);
    double unbalanced = 0;
    for (unsigned int q = 0; q < n; ++q)
      unbalanced += gauss.weight(q) * middle *
                    (radial_mode[q] * radial_mode[q] + alpha * angular_mode[q] * angular_mode[q]);
    squares[cell->active_cell_index()] =
        h_r * h_z * (weighted_square(n, residual, gauss, length) + exact_parts_weight * unbalanced);

    for (const unsigned int f : cell->face_indices()) {
      if (f < 2 && cell->at_boundary(f))
        continue;
      const auto parts = lines.parts(cell, f);
      const unsigned int side = f % 2;
      const double sign = side == 0 ? -1 : 1;
      for (unsigned int part = 0; part < parts.count; ++part) {
        const LineShapes& along = parts.count == 1 ? inside : halves[part];
        for (unsigned int q = 0; q < n; ++q) {
          double flux;
          if (f < 2)
            flux = (side == 0 ? box.r0 : box.r1) * u.sum(ends.first[side], along.value[q]) * per_r;
          else {
            const double r = box.r0 + h_r * (part + points[q][0]) / 2;
            flux = (parts.count == 1 ? alpha_r[q] : r * scene.alpha(r)) *
                   u.sum(along.value[q], ends.first[side]) * per_z;
          }
          jump[parts.lines[part] * n + q] += sign * flux;
        }
      }
    }
  }

  // The squares of the mean of the jump on each line, and of what is left of the jump
  std::vector<std::pair<double, double>> jump_squares(triangulation.n_raw_lines());
  for (unsigned int line = 0; line < jump_squares.size(); ++line) {
    const double* const values = &jump[line * n];
    double mean = 0, deviation = 0;
    for (unsigned int q = 0; q < n; ++q)
      mean += gauss.weight(q) * values[q];
    for (unsigned int q = 0; q < n; ++q)
      deviation += gauss.weight(q) * (values[q] - mean) * (values[q] - mean);
    jump_squares[line] = {mean * mean, deviation};
  }
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    double& square = squares[cell->active_cell_index()];
    if (!cell->is_locally_owned()) {
      square = 0;
      continue;
    }
    const Rectangle box = rectangle_of(cell);
    const Lengths length = lengths[cell->active_cell_index()];
    const double slenderness = box.length() / box.height();
    for (const unsigned int f : cell->face_indices()) {
      if (f < 2 && cell->at_boundary(f))
        continue;
      const auto parts = lines.parts(cell, f);
      double sum = 0;
      for (unsigned int part = 0; part < parts.count; ++part) {
        const auto& [mean, deviation] = jump_squares[parts.lines[part]];
        sum += (f < 2 ? length.radial : length.angular) * mean + length.both() * deviation;
      }
      square += (f < 2 ? slenderness : 1 / slenderness) / (2 * parts.count) * sum;
    }
  }

  const double b = scene.outer_radius;
  // What linear solvers and Uzawa's method leave at active nodes is not the mesh's error.
  double negligible_gap = 0;
  for (unsigned int i = 0; i < problem.size(); ++i)
    negligible_gap = std::max(negligible_gap, contact.state.displacement(i) - problem.road(i));
  negligible_gap += wanted_residual * contact.state.displacement.linfty_norm();
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned() || !cell->at_boundary(1))
      continue;
    const SurfaceFace& face = space.surface_faces()[*space.surface_face(cell)];
    const Rectangle box = rectangle_of(cell);
    const CellField u = gather(cell);
    NodeValues pressure = {};
    unsigned int n_active = 0, n_contact = 0;
    for (unsigned int k = 0; k < n; ++k)
      if (const auto node = space.contact_number(face.nodes[k])) {
        pressure[k] = contact.state.force(*node) / problem.weight(*node);
        n_active += contact.active[*node];
        ++n_contact;
      }
    const double h_r = box.height(), h_z = box.length();
    double& square = squares[cell->active_cell_index()];
    const double resistance = lengths[cell->active_cell_index()].both() / h_r;
    for (unsigned int mode = 2; mode < degree; ++mode) {
      const Polynomials::Legendre legendre(mode);
      double coefficient = 0;
      for (unsigned int q = 0; q < n; ++q) {
        double lambda = 0;
        for (unsigned int k = 0; k < n; ++k)
          lambda += inside.value[q][k] * pressure[k];
        coefficient += gauss.weight(q) * legendre.value(points[q][0]) * lambda;
      }
      square += exact_parts_weight * resistance * h_z * std::pow(b * coefficient, 2);
    }
    for (unsigned int q = 0; q < n; ++q) {
      double lambda = 0, displacement = 0, slope = 0;
      for (unsigned int k = 0; k < n; ++k) {
        lambda += inside.value[q][k] * pressure[k];
        displacement += inside.value[q][k] * u.nodal[n - 1 + n * k];
        slope += inside.first[q][k] * u.nodal[n - 1 + n * k] / h_z;
      }
      const double weight = gauss.weight(q) * h_z;
      const double imbalance = b * (u.sum(ends.first[1], inside.value[q]) / h_r + lambda);
      square += resistance * weight * imbalance * imbalance;
      const double z = face.begin + (face.end - face.begin) * points[q][0];
      if (n_contact == 0 || n_active == n || z < scene.zone_begin || z > scene.zone_end)
        continue;
      const double gap = scene.road(z) - displacement;
      // The point may be an active node, where the gap is of either sign.
      if (gap >= -negligible_gap)
        square += exact_parts_weight * 2 * b * weight * std::max(0., lambda) * std::max(0., gap);
      else {
        const double steepness = slope - scene.road_slope(z);
        const double alpha = scene.alpha((box.r0 + box.r1) / 2);
        square += exact_parts_weight * b * weight *
                  (gap * gap / h_r + alpha * h_r / 3 * steepness * steepness);
      }
    }
  }
  for (double& value : squares)
    value = std::sqrt(value);
  return squares;
}

} // namespace

std::vector<double> residual_indicator(const RingSpace& space, const Scene& scene,
                                       const ContactProblem& problem,
                                       const ContactSolution& contact, const FieldVector& field) {
  return indicate(space.dof_handler().get_fe().degree + 1, space, scene, problem, contact, field);
}

} // namespace rollwave
