#include "tensor_solver.h"

#include "cell_places.h"
#include "errors.h"
#include "lexicographic_dofs.h"
#include "memory.h"

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

namespace {

/// The place of angular node @p j of @p n, such that nodes that are close on the ring have close
/// places: both ways round in turn.
unsigned int folded(unsigned int j, unsigned int n) {
  return 2 * j < n ? 2 * j : 2 * (n - j) - 1;
}

/// Adds @p weight times the integrals of one cell, whose nodes have these @p places.
void add_products(const FullMatrix<double>& products, double weight,
                  const std::vector<unsigned int>& places, BandedMatrix& sum) {
  for (unsigned int j = 0; j < places.size(); ++j)
    for (unsigned int l = 0; l < places.size(); ++l)
      if (places[j] <= places[l])
        sum(places[j], places[l] - places[j]) += weight * products(j, l);
}

} // namespace

bool TensorSolver::suits(const RingSpace& space) {
  const auto& triangulation = space.dof_handler().get_triangulation();
  const CellPlaces places(triangulation);
  return triangulation.n_active_cells() == triangulation.n_cells(triangulation.n_levels() - 1) &&
         places.n_radial() <= places.n_angular();
}

void TensorSolver::set_matrix(const Scene& /*scene*/, const AffineConstraints<double>& constraints,
                              const RadialProducts& radial, Work& work) {
  const DoFHandler<2>& handler = space.dof_handler();
  const unsigned int degree = handler.get_fe().degree, n = degree + 1;
  const CellPlaces cells(handler.get_triangulation());
  const double per_size = 1 / cells.of(handler.begin_active()).size;
  const unsigned int n_radii = degree * std::lround(cells.n_radial() * per_size) + 1;
  n_angles = degree * std::lround(cells.n_angular() * per_size);
  require_memory(sizeof(double) * (4. * n_radii * n_radii + 3. * n_radii * n_angles),
                 "the diagonalisation of the dual problem");

  const ShapeProducts reference = reference_products(degree);
  angular_mass = angular_stiffness = BandedMatrix(2 * degree);
  angular_mass.grow(n_angles);
  angular_stiffness.grow(n_angles);
  LAPACKFullMatrix<double> mass(n_radii), stiffness(n_radii);
  dofs.assign(n_radii * n_angles, numbers::invalid_dof_index);
  LexicographicDofs dofs_of_cells(handler);
  std::vector<unsigned int> angular_places(n);
  for (const auto& cell : handler.active_cell_iterators()) {
    const CellPlace place = cells.of(cell);
    const unsigned int first_radius = degree * std::lround(place.low[0] * per_size);
    const unsigned int first_angle = degree * std::lround(place.low[1] * per_size);
    for (unsigned int j = 0; j < n; ++j)
      angular_places[j] = folded((first_angle + j) % n_angles, n_angles);
    const auto& of_cell = dofs_of_cells.of(cell);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        if (const auto dof = of_cell[i + n * j]; !constraints.is_constrained(dof))
          dofs[(first_radius + i) * n_angles + angular_places[j]] = dof;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    if (first_radius == 0) {
      add_products(reference.mass, high[1] - low[1], angular_places, angular_mass);
      add_products(reference.stiffness, 1 / (high[1] - low[1]), angular_places, angular_stiffness);
    }
    if (first_angle == 0) {
      const ShapeProducts& products = radial(low[0], high[0]);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int k = 0; k < n; ++k) {
          mass(first_radius + i, first_radius + k) += products.mass(i, k);
          stiffness(first_radius + i, first_radius + k) += products.stiffness(i, k);
        }
    }
  }

  for (unsigned int i = n_radii; i-- > 0;)
    if (dofs[i * n_angles] == numbers::invalid_dof_index) {
      mass.remove_row_and_column(i, i);
      stiffness.remove_row_and_column(i, i);
    }
  dofs.erase(std::remove(dofs.begin(), dofs.end(), numbers::invalid_dof_index), dofs.end());
  const unsigned int n_modes = mass.m();
  std::vector<Vector<double>> vectors(n_modes);
  stiffness.compute_generalized_eigenvalues_symmetric(mass, vectors);
  ++work.diagonalisations;
  modes.reinit(n_modes, n_modes);
  eigenvalues.clear();
  for (unsigned int k = 0; k < n_modes; ++k) {
    eigenvalues.push_back(stiffness.eigenvalue(k).real());
    if (!(eigenvalues.back() > 0))
      throw NotSolved("the radial problem is not positive definite but for round-off: raise "
                      "Cylinder/Inner radius or lower Mesh/Radial cells");
    for (unsigned int i = 0; i < n_modes; ++i)
      modes(i, k) = vectors[k](i);
  }
}

FieldVector TensorSolver::solve(const FieldVector& rhs, Work& work) {
  const unsigned int n_modes = eigenvalues.size();
  LAPACKFullMatrix<double> load(n_angles, n_modes), of_modes(n_angles, n_modes);
  for (unsigned int i = 0; i < n_modes; ++i)
    for (unsigned int j = 0; j < n_angles; ++j) {
      const auto dof = dofs[i * n_angles + j];
      load(j, i) = rhs(dof);
    }
  load.mmult(of_modes, modes);
  std::vector<double> along(n_angles);
  for (unsigned int k = 0; k < n_modes; ++k) {
    BandedMatrix matrix = angular_stiffness;
    matrix.add(eigenvalues[k], angular_mass);
    matrix.factorise();
    for (unsigned int j = 0; j < n_angles; ++j)
      along[j] = of_modes(j, k);
    along = matrix.solve(std::move(along));
    for (unsigned int j = 0; j < n_angles; ++j)
      of_modes(j, k) = along[j];
  }
  of_modes.mTmult(load, modes);
  ++work.back_substitutions;
  FieldVector solution = space.make_field();
  for (std::size_t i = 0; i < dofs.size(); ++i)
    solution(dofs[i]) = load(i % n_angles, i / n_angles);
  return solution;
}

} // namespace rollwave
