#include "angular_bubbles.h"

#include "scene.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rollwave {

using namespace dealii;

namespace {

using Cell = DoFHandler<2>::active_cell_iterator;

/// Whether the neighbour of a cell over its face @p f towards the hub or the surface is as long.
bool has_equal_neighbour(const Cell& cell, unsigned int f) {
  return !cell->at_boundary(f) && cell->neighbor(f)->is_active() && !cell->neighbor_is_coarser(f);
}

/// The number on a cell, the radial index running fastest, of the node that carries g at the radial
/// node @p i: neighbours over a radial line have it in common, neighbours in z do not.
unsigned int carrier(unsigned int i, unsigned int n) {
  return n > 2 ? i + n : i;
}

/// What is nearest to @p wanted among the m with lambda + m P >= 0 for sure: coefficients over
/// Bernstein's polynomials B_k are positive, those of P are (-1)^(p + k) binomial(p, k) (2 p +
/// 1)^(1/2), those of lambda lie on a line.
double nearest_mode(const EdgePressure& pressure, unsigned int degree, double wanted) {
  double nearest = wanted, binomial = 1;
  for (unsigned int k = 0; k <= degree; ++k) {
    const double of_mode = (degree + k) % 2 ? -binomial * std::sqrt(2 * degree + 1.)
                                            : binomial * std::sqrt(2 * degree + 1.);
    const double limit = std::max(0., pressure(1. * k / degree)) / -of_mode;
    nearest = of_mode < 0 ? std::min(nearest, limit) : std::max(nearest, limit);
    binomial *= 1. * (degree - k) / (k + 1);
  }
  return nearest;
}

/// The quadratic form int (h_z beta g_s)^2 ds dz + int (P g)^2 / r dr dz.
class BubbleForm {
public:
  BubbleForm(const RingSpace& space, double bubble_square)
      : scale(space.make_field()), bubble_square(bubble_square), scaled(scale),
        n(space.dof_handler().get_fe().degree + 1) {}

  /// A cell.
  struct Part {
    const ShapeProducts* radial;
    double length;
  };

  /// @param places of the n values of g among a field's own and ghost values
  void add(const Part& part, const std::vector<unsigned int>& places) {
    parts.push_back(part);
    nodes.insert(nodes.end(), places.begin(), places.end());
  }

  double entry(const Part& part, unsigned int i, unsigned int k) const {
    return part.length * (part.length * part.length * bubble_square * part.radial->stiffness(i, k) +
                          part.radial->mass(i, k));
  }

  /// The matrix times @p g.
  void apply(FieldVector& result, const FieldVector& g) const {
    g.update_ghost_values();
    result = 0;
    const unsigned int* places = nodes.data();
    for (const Part& part : parts) {
      for (unsigned int i = 0; i < n; ++i) {
        double sum = 0;
        for (unsigned int k = 0; k < n; ++k)
          sum += entry(part, i, k) * g.local_element(places[k]);
        result.local_element(places[i]) += sum;
      }
      places += n;
    }
    result.compress(VectorOperation::add);
    g.zero_out_ghost_values();
  }

  /// The same with rows and columns times scale.
  void vmult(FieldVector& result, const FieldVector& g) const {
    scaled = g;
    scaled.scale(scale);
    apply(result, scaled);
    result.scale(scale);
  }

  FieldVector scale; ///< 1 / sqrt(diagonal) where g is free, 0 where it is zero

private:
  const double bubble_square; ///< int beta^2 dt
  mutable FieldVector scaled; ///< g with the scale, only while it is applied
  const unsigned int n;
  std::vector<Part> parts;
  std::vector<unsigned int> nodes; ///< n of each part
};

} // namespace

Polynomials::Polynomial<double> AngularBubbles::mode(unsigned int degree) {
  return Polynomials::Legendre(degree);
}

AngularBubbles::AngularBubbles(const RingSpace& space, const Scene& scene,
                               RadialShapesOfMesh& shapes, const FieldVector& potential,
                               const std::vector<EdgePressure>& pressures, ForceColumns* columns)
    : n(space.dof_handler().get_fe().degree + 1), field(space.make_field()) {
  const auto& element = dynamic_cast<const FE_Q<2>&>(space.dof_handler().get_fe());
  const auto numbering = element.get_poly_space_numbering_inverse();
  const unsigned int degree = element.degree;
  const auto highest = mode(degree), bubble = highest.primitive();
  const auto lagrange = lobatto_lagrange(degree);
  const QGauss<1> gauss(degree + 2);
  const auto& partitioner = *field.get_partitioner();
  double bubble_square = 0;
  std::vector<double> bubble_of(n), weighted_mode(gauss.size()); // int beta L_j dt; P at the points
  for (unsigned int q = 0; q < gauss.size(); ++q) {
    const double t = gauss.point(q)[0], weight = gauss.weight(q);
    weighted_mode[q] = weight * highest.value(t);
    bubble_square += weight * bubble.value(t) * bubble.value(t);
    for (unsigned int j = 0; j < n; ++j)
      bubble_of[j] += weight * bubble.value(t) * lagrange[j].value(t);
  }

  BubbleForm form(space, bubble_square);
  FieldVector load = space.make_field(), diagonal = space.make_field();
  std::vector<types::global_dof_index> dofs(n * n);
  std::vector<double> psi_bubble(n);
  std::vector<unsigned int> places(n);
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    const double length = high[1] - low[1];
    const RadialShapes& radial = shapes.on(low[0], high[0]);
    cell->get_dof_indices(dofs);
    const BubbleForm::Part part{&radial.products, length};
    std::array<double, 9> cell_load = {};
    for (unsigned int i = 0; i < n; ++i) {
      psi_bubble[i] = 0;
      for (unsigned int j = 0; j < n; ++j)
        psi_bubble[i] += bubble_of[j] * potential(dofs[numbering[i + n * j]]);
      places[i] = partitioner.global_to_local(dofs[numbering[carrier(i, n)]]);
    }
    form.add(part, places);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int k = 0; k < n; ++k)
        cell_load[i] -= length * length * radial.products.stiffness(i, k) * psi_bubble[k];
    if (columns && !columns->are_exact())
      for (unsigned int p = 0; p < gauss.size(); ++p) {
        const auto& column = columns->at(low[1] + length * gauss.point(p)[0]);
        for (unsigned int q = 0; q < radial.r.size(); ++q)
          for (unsigned int i = 0; i < n; ++i)
            cell_load[i] += length * weighted_mode[p] * column.integral(radial.r[q]) / radial.r[q] *
                            radial.weight[q] * radial.shapes[q][i].potential;
      }
    const auto edge = space.surface_face(cell);
    const bool has_pressure = edge && pressures[*edge].mean > 0;
    if (has_pressure) {
      const SurfaceFace& face = space.surface_faces()[*edge];
      for (unsigned int p = 0; p < gauss.size(); ++p)
        cell_load[degree] -= length * weighted_mode[p] *
                             scene.road(face.begin + gauss.point(p)[0] * (face.end - face.begin));
    }
    const bool is_free_below = cell->at_boundary(0) || has_equal_neighbour(cell, 0);
    const bool is_free_above = edge ? has_pressure : has_equal_neighbour(cell, 1);
    for (unsigned int i = is_free_below ? 0 : 1; i < (is_free_above ? n : degree); ++i) {
      load.local_element(places[i]) += cell_load[i];
      diagonal.local_element(places[i]) += form.entry(part, i, i);
    }
  }
  load.compress(VectorOperation::add);
  diagonal.compress(VectorOperation::add);
  for (unsigned int i = 0; i < field.locally_owned_size(); ++i)
    if (diagonal.local_element(i) > 0)
      form.scale.local_element(i) = 1 / std::sqrt(diagonal.local_element(i));

  FieldVector scaled_load = load;
  scaled_load.scale(form.scale);
  // More steps gain little but in the flattest cells.
  IterationNumberControl control(20, 0.1 * scaled_load.l2_norm());
  SolverCG<FieldVector>(control).solve(form, field, scaled_load, PreconditionIdentity());
  field.scale(form.scale);

  FieldVector excess = space.make_field();
  field.update_ghost_values();
  for (const auto& cell : space.dof_handler().active_cell_iterators())
    if (const auto edge = space.surface_face(cell); edge && cell->is_locally_owned()) {
      cell->get_dof_indices(dofs);
      const auto node = dofs[numbering[carrier(degree, n)]];
      const double b = scene.outer_radius;
      excess(node) += field(node) - b * nearest_mode(pressures[*edge], degree, field(node) / b);
    }
  excess.compress(VectorOperation::add);
  field.zero_out_ghost_values();
  field -= excess;

  FieldVector product = space.make_field();
  form.apply(product, field);
  const double square = field * product;
  field *= square > 0 ? std::clamp(load * field / square, 0., 1.) : 0;
  field.update_ghost_values();
}

void AngularBubbles::values(const std::vector<types::global_dof_index>& dofs,
                            std::vector<double>& g) const {
  for (unsigned int i = 0; i < n; ++i)
    g[i] = field(dofs[carrier(i, n)]);
}

} // namespace rollwave
