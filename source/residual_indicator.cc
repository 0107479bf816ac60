#include "residual_indicator.h"

#include "radial_shapes.h"
#include "ring_mesh.h"
#include "scene.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace rollwave {

using namespace dealii;

namespace {

/// Shape functions on [0, 1] with two derivatives at some points.
struct LineShapes {
  std::vector<std::array<double, 9>> value, first, second;

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

/// The lines between cells, over the seam as well. A line that is shared by a coarser and two finer
/// cells counts as the two lines of the finer ones.
class Lines {
public:
  explicit Lines(const RingSpace& space) {
    for (const auto& cell : space.dof_handler().active_cell_iterators())
      for (const unsigned int f : {2U, 3U})
        if (!cell->is_artificial() && cell->at_boundary(f))
          seam[f - 2][{cell->face(f)->vertex(0)[0], cell->face(f)->vertex(1)[0]}] =
              cell->face(f)->index();
  }

  /// The numbers of the lines that make up a face, one or two.
  struct Parts {
    unsigned int count;
    std::array<int, 2> lines;
  };

  Parts parts(const DoFHandler<2>::active_cell_iterator& cell, unsigned int f) const {
    const auto face = cell->face(f);
    if (face->has_children())
      return {2, {{face->child_index(0), face->child_index(1)}}};
    if (f >= 2 && face->at_boundary()) {
      const double begin = face->vertex(0)[0], end = face->vertex(1)[0];
      const auto& other = seam[3 - f];
      if (const auto same = other.find({begin, end}); same != other.end())
        return {1, {{f == 2 ? face->index() : same->second, -1}}};
      const auto lower = other.lower_bound({begin, begin});
      if (lower != other.end() && lower->first.first == begin && lower->first.second < end)
        return {2, {{lower->second, std::next(lower)->second}}};
    }
    return {1, {{face->index(), -1}}};
  }

private:
  std::array<std::map<std::pair<double, double>, int>, 2> seam;
};

/// u on one cell by its nodal values, the radial index running fastest.
struct CellField {
  unsigned int n;
  std::array<double, 81> nodal;

  double sum(const std::array<double, 9>& radial, const std::array<double, 9>& angular) const {
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

} // namespace

std::vector<double> residual_indicator(const RingSpace& space, const Scene& scene,
                                       const ContactProblem& problem,
                                       const ContactSolution& contact, const FieldVector& field) {
  const auto& element = dynamic_cast<const FE_Q<2>&>(space.dof_handler().get_fe());
  const auto& triangulation = space.dof_handler().get_triangulation();
  const unsigned int degree = element.degree, n = degree + 1;
  const QGauss<1> gauss(n);
  const auto& points = gauss.get_points();
  const LineShapes inside(degree, mapped(points, 0, 1)), ends(degree, {0, 1});
  const std::vector<LineShapes> halves = {LineShapes(degree, mapped(points, 0, 0.5)),
                                          LineShapes(degree, mapped(points, 0.5, 1))};
  const std::vector<unsigned int> numbering = element.get_poly_space_numbering_inverse();
  std::vector<types::global_dof_index> dofs(n * n);
  const auto gather = [&](const auto& cell) {
    CellField u{n, {}};
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < n * n; ++i)
      u.nodal[i] = field(dofs[numbering[i]]);
    return u;
  };

  const Lines lines(space);
  std::vector<double> jump(triangulation.n_raw_lines() * n);
  std::vector<double> squares(triangulation.n_active_cells());
  std::vector<double> factor(triangulation.n_active_cells());
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (cell->is_artificial())
      continue;
    const Rectangle box = rectangle_of(cell);
    const CellField u = gather(cell);
    const double h_r = box.height(), h_z = box.length();
    const double middle = (box.r0 + box.r1) / 2;
    const double H2 = std::min(h_r * h_r, h_z * h_z / scene.alpha(middle)) / middle;
    factor[cell->active_cell_index()] = H2;

    double volume = 0;
    for (unsigned int p = 0; p < n; ++p)
      for (unsigned int q = 0; q < n; ++q) {
        const double r = box.r0 + h_r * points[q][0];
        double residual = u.sum(inside.first[q], inside.value[p]) / h_r;
        if (degree > 1)
          residual += r * (u.sum(inside.second[q], inside.value[p]) / (h_r * h_r) +
                           scene.alpha(r) * u.sum(inside.value[q], inside.second[p]) / (h_z * h_z));
        if (scene.force)
          residual += r * scene.force(r, std::fmod(box.z0 + h_z * points[p][0], 2 * numbers::PI));
        volume += gauss.weight(p) * gauss.weight(q) * residual * residual;
      }
    squares[cell->active_cell_index()] = H2 * h_r * h_z * volume;

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
            flux = (side == 0 ? box.r0 : box.r1) * u.sum(ends.first[side], along.value[q]) / h_r;
          else {
            const double t = parts.count == 1 ? points[q][0] : (part + points[q][0]) / 2;
            const double r = box.r0 + h_r * t;
            flux = r * scene.alpha(r) * u.sum(along.value[q], ends.first[side]) / h_z;
          }
          jump[parts.lines[part] * n + q] += sign * flux;
        }
      }
    }
  }

  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned()) {
      squares[cell->active_cell_index()] = 0;
      continue;
    }
    const Rectangle box = rectangle_of(cell);
    double sum = 0;
    for (const unsigned int f : cell->face_indices()) {
      if (f < 2 && cell->at_boundary(f))
        continue;
      const auto parts = lines.parts(cell, f);
      const double across = f < 2 ? box.height() : box.length();
      const double along = (f < 2 ? box.length() : box.height()) / parts.count;
      for (unsigned int part = 0; part < parts.count; ++part)
        for (unsigned int q = 0; q < n; ++q) {
          const double value = jump[parts.lines[part] * n + q];
          sum += gauss.weight(q) * along / (2 * across) * value * value;
        }
    }
    squares[cell->active_cell_index()] += factor[cell->active_cell_index()] * sum;
  }

  const double b = scene.outer_radius;
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned() || !cell->at_boundary(1))
      continue;
    const SurfaceFace& face = space.surface_faces()[*space.surface_face(cell)];
    const Rectangle box = rectangle_of(cell);
    const CellField u = gather(cell);
    std::array<double, 9> pressure = {};
    unsigned int n_active = 0, n_contact = 0;
    for (unsigned int k = 0; k < n; ++k)
      if (const auto node = space.contact_number(face.nodes[k])) {
        pressure[k] = contact.state.force(*node) / problem.weight(*node);
        n_active += contact.active[*node];
        ++n_contact;
      }
    const double h_r = box.height(), h_z = box.length();
    double& square = squares[cell->active_cell_index()];
    for (unsigned int q = 0; q < n; ++q) {
      double lambda = 0, displacement = 0, slope = 0;
      for (unsigned int k = 0; k < n; ++k) {
        lambda += inside.value[q][k] * pressure[k];
        displacement += inside.value[q][k] * u.nodal[n - 1 + n * k];
        slope += inside.first[q][k] * u.nodal[n - 1 + n * k] / h_z;
      }
      const double weight = gauss.weight(q) * h_z;
      const double imbalance = b * (u.sum(ends.first[1], inside.value[q]) / h_r + lambda);
      square += factor[cell->active_cell_index()] / h_r * weight * imbalance * imbalance;
      const double z = face.begin + (face.end - face.begin) * points[q][0];
      if (n_contact == 0 || n_active == n || z < scene.zone_begin || z > scene.zone_end)
        continue;
      const double gap = scene.road(z) - displacement;
      // The point may be an active node, where the gap is round-off of either sign.
      if (gap >= -1e-13 * std::abs(displacement))
        square += 2 * b * weight * std::max(0., lambda) * std::max(0., gap);
      else {
        const double steepness = slope - scene.road_slope(z);
        const double alpha = scene.alpha((box.r0 + box.r1) / 2);
        square += b * weight * (gap * gap / h_r + alpha * h_r / 3 * steepness * steepness);
      }
    }
  }
  for (double& value : squares)
    value = std::sqrt(value);
  return squares;
}

} // namespace rollwave
