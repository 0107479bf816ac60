#include "rollwave/adapt/residual_indicator.h"

#include "rollwave/adapt/cell_lines.h"
#include "rollwave/adapt/cell_residual.h"
#include "rollwave/mesh/lexicographic_dofs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// How often parts of the certified error count that are what they are, since the squares of
/// residuals are larger than those of the errors they stand for. With 2 certified errors are a
/// tenth larger, with 50 the true ones are (doc/decisions.md).
constexpr double exact_parts_weight = 10;

/// The terms of the indicator, summed up cell by cell. A jump needs the fluxes of both cells beside
/// a line, so that fluxes are collected while cells are visited.
class ResidualTerms {
public:
  ResidualTerms(const RingSpace& space, const Scene& scene, const FieldVector& field)
      : space(space), scene(scene), field(field), n(space.dof_handler().get_fe().degree + 1),
        gauss(n), inside(n - 1, mapped(gauss.get_points(), 0, 1)),
        ends(n - 1, {0, 1}), halves{LineShapes(n - 1, mapped(gauss.get_points(), 0, 0.5)),
                                    LineShapes(n - 1, mapped(gauss.get_points(), 0.5, 1))},
        lines(space), dofs(space.dof_handler()), moment(n - 1, gauss),
        jump(space.dof_handler().get_triangulation().n_raw_lines() * n),
        squares(space.dof_handler().get_triangulation().n_active_cells()) {
    const Polynomials::Legendre highest(n - 1);
    for (unsigned int q = 0; q < n; ++q)
      highest_mode.push_back(gauss.weight(q) * highest.value(gauss.point(q)[0]));
    for (const auto& cell : space.dof_handler().active_cell_iterators())
      if (!cell->is_artificial()) {
        const Rectangle box = rectangle_of(cell);
        const CellField u = gather(cell);
        squares[cell->active_cell_index()] = cell_term(box, u);
        collect_fluxes(cell, box, u);
      }
  }

  void add_jumps();
  void add_contact(const ContactProblem& problem, const ContactSolution& contact);

  /// eta_K; 0 on the cells of other processes.
  std::vector<double> values() const {
    std::vector<double> result(squares.size());
    for (const auto& cell : space.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        result[cell->active_cell_index()] = std::sqrt(squares[cell->active_cell_index()]);
    return result;
  }

private:
  using Cell = DoFHandler<2>::active_cell_iterator;

  CellField gather(const Cell& cell) {
    CellField u(n);
    const auto& of_cell = dofs.of(cell);
    for (unsigned int i = 0; i < n * n; ++i)
      u.nodal[i] = field(of_cell[i]);
    return u;
  }

  double cell_term(const Rectangle& box, const CellField& u);
  void collect_fluxes(const Cell& cell, const Rectangle& box, const CellField& u);
  double missed_modes(const NodeValues& pressure) const;
  double contact_term(const Rectangle& box, const CellField& u, const SurfaceFace& face,
                      const NodeValues& pressure, bool is_judged, double negligible_gap) const;

  const RingSpace& space;
  const Scene& scene;
  const FieldVector& field;
  const unsigned int n; ///< nodes on each side of a cell
  const QGauss<1> gauss;
  const LineShapes inside, ends;
  const std::vector<LineShapes> halves;
  const CellLines lines;
  LexicographicDofs dofs;
  ForceMoment moment;
  std::vector<double> highest_mode; ///< at the points of the rule, with their weights
  std::vector<double> jump;         ///< of the flux, at the points on each line
  std::vector<double> squares;      ///< eta_K^2
};

/// The residual inside of a cell, and the modes of the fluxes that the bound cannot represent.
double ResidualTerms::cell_term(const Rectangle& box, const CellField& u) {
  const double h_r = box.height(), h_z = box.length();
  if (scene.force)
    moment.reinit(scene, box);
  ResidualValues residual;
  NodeValues radial_mode = {}, angular_mode = {};
  for (unsigned int p = 0; p < n; ++p) {
    // Along the line z = const: u and its first two derivatives by z at the radial nodes
    NodeValues line = {}, line_z = {}, line_zz = {};
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j) {
        line[i] += inside.value[p][j] * u.nodal[i + n * j];
        line_z[i] += inside.first[p][j] * u.nodal[i + n * j] / h_z;
        line_zz[i] += inside.second[p][j] * u.nodal[i + n * j] / (h_z * h_z);
      }
    for (unsigned int q = 0; q < n; ++q) {
      const double r = box.r0 + h_r * gauss.point(q)[0];
      double u_r = 0, u_rr = 0, u_z = 0, u_zz = 0;
      for (unsigned int i = 0; i < n; ++i) {
        u_r += inside.first[q][i] * line[i] / h_r;
        u_rr += inside.second[q][i] * line[i] / (h_r * h_r);
        u_z += inside.value[q][i] * line_z[i];
        u_zz += inside.value[q][i] * line_zz[i];
      }
      residual[p][q] = u_r + r * u_rr + scene.alpha(r) * r * u_zz;
      if (scene.force)
        residual[p][q] += moment.value(p, q);
      radial_mode[q] += highest_mode[p] * u_r;
      angular_mode[p] += highest_mode[q] * u_z;
    }
  }
  const double middle = (box.r0 + box.r1) / 2, alpha = scene.alpha(middle);
  double unbalanced = 0;
  for (unsigned int q = 0; q < n; ++q)
    unbalanced += gauss.weight(q) * middle *
                  (radial_mode[q] * radial_mode[q] + alpha * angular_mode[q] * angular_mode[q]);
  return h_r * h_z *
         (weighted_square(n, residual, gauss, lengths_of(box, scene)) +
          exact_parts_weight * unbalanced);
}

void ResidualTerms::collect_fluxes(const Cell& cell, const Rectangle& box, const CellField& u) {
  for (const unsigned int f : cell->face_indices()) {
    if (f < 2 && cell->at_boundary(f))
      continue;
    const auto parts = lines.parts(cell, f);
    const unsigned int side = f % 2;
    for (unsigned int part = 0; part < parts.count; ++part) {
      const LineShapes& along = parts.count == 1 ? inside : halves[part];
      for (unsigned int q = 0; q < n; ++q) {
        const double t = gauss.point(q)[0];
        const double r = box.r0 + box.height() * (parts.count == 1 ? t : (part + t) / 2);
        const double flux =
            f < 2 ? (side == 0 ? box.r0 : box.r1) * u.sum(ends.first[side], along.value[q]) /
                        box.height()
                  : r * scene.alpha(r) * u.sum(along.value[q], ends.first[side]) / box.length();
        jump[parts.lines[part] * n + q] += side == 0 ? -flux : flux;
      }
    }
  }
}

void ResidualTerms::add_jumps() {
  // The squares of the mean of the jump on each line, and of what is left of the jump
  std::vector<std::pair<double, double>> jump_squares(jump.size() / n);
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
    if (!cell->is_locally_owned())
      continue;
    const Rectangle box = rectangle_of(cell);
    const Lengths length = lengths_of(box, scene);
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
      squares[cell->active_cell_index()] +=
          (f < 2 ? slenderness : 1 / slenderness) / (2 * parts.count) * sum;
    }
  }
}

void ResidualTerms::add_contact(const ContactProblem& problem, const ContactSolution& contact) {
  // What linear solvers and Uzawa's method leave at active nodes is not the mesh's error.
  double negligible_gap = 0;
  for (unsigned int i = 0; i < problem.size(); ++i)
    negligible_gap = std::max(negligible_gap, contact.state.displacement(i) - problem.road(i));
  negligible_gap += wanted_residual * contact.state.displacement.linfty_norm();
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned() || !cell->at_boundary(1))
      continue;
    const SurfaceFace& face = space.surface_faces()[*space.surface_face(cell)];
    NodeValues pressure = {};
    unsigned int n_active = 0, n_contact = 0;
    for (unsigned int k = 0; k < n; ++k)
      if (const auto node = space.contact_number(face.nodes[k])) {
        pressure[k] = contact.state.force(*node) / problem.weight(*node);
        n_active += contact.active[*node];
        ++n_contact;
      }
    squares[cell->active_cell_index()] +=
        contact_term(rectangle_of(cell), gather(cell), face, pressure,
                     n_contact > 0 && n_active < n, negligible_gap);
  }
}

/// The mean square on an edge of the modes of the pressure which the bound lacks: those between the
/// linear ones and the highest.
double ResidualTerms::missed_modes(const NodeValues& pressure) const {
  double sum = 0;
  for (unsigned int mode = 2; mode + 1 < n; ++mode) {
    const Polynomials::Legendre legendre(mode);
    double coefficient = 0;
    for (unsigned int q = 0; q < n; ++q)
      for (unsigned int k = 0; k < n; ++k)
        coefficient +=
            gauss.weight(q) * legendre.value(gauss.point(q)[0]) * inside.value[q][k] * pressure[k];
    sum += coefficient * coefficient;
  }
  return sum;
}

/// @param is_judged whether the edge may touch the road, but not with all of its nodes
double ResidualTerms::contact_term(const Rectangle& box, const CellField& u,
                                   const SurfaceFace& face, const NodeValues& pressure,
                                   bool is_judged, double negligible_gap) const {
  const double b = scene.outer_radius, h_r = box.height(), h_z = box.length();
  const double resistance = lengths_of(box, scene).both() / h_r;
  double square = exact_parts_weight * resistance * h_z * b * b * missed_modes(pressure);
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
    const double z = face.begin + (face.end - face.begin) * gauss.point(q)[0];
    if (!is_judged || z < scene.zone_begin || z > scene.zone_end)
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
  return square;
}

} // namespace

std::vector<double> residual_indicator(const RingSpace& space, const Scene& scene,
                                       const ContactProblem& problem,
                                       const ContactSolution& contact, const FieldVector& field) {
  ResidualTerms terms(space, scene, field);
  terms.add_jumps();
  terms.add_contact(problem, contact);
  return terms.values();
}

} // namespace rollwave
