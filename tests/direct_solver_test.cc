// The factorisation answers every pinned problem exactly as dense algebra does.
#include "rollwave/solver/direct_solver.h"

#include "rollwave/base/errors.h"
#include "rollwave/mesh/assembly.h"
#include "rollwave/solver/sparse_cholesky.h"
#include "test_scenes.h"

#include <deal.II/lac/full_matrix.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iterator>
#include <random>
#include <vector>

using namespace rollwave;
using dealii::FullMatrix;
using dealii::Vector;

namespace {

/// A random sparse symmetric positive definite matrix, as triplets and in full.
struct RandomMatrix {
  explicit RandomMatrix(int n) : full(n, n) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> value(-1, 1);
    for (int i = 0; i < n; ++i)
      add(i, i, n);
    for (int k = 0; k < 4 * n; ++k)
      add(random() % n, random() % n, value(random));
  }

  void add(int i, int j, double value) {
    triplets.add(std::max(i, j), std::min(i, j), value);
    full(i, j) += value;
    if (i != j)
      full(j, i) += value;
  }

  LowerTriplets triplets;
  FullMatrix<double> full;
};

double factor_entries_per_unknown(const RingSpace& space, const Scene& scene) {
  SparseCholesky cholesky(space);
  cholesky.number_unknowns(space.constraints());
  RunStatistics statistics;
  cholesky.analyse(cholesky.assemble(space.constraints(), stiffness_matrices(space, scene)),
                   statistics);
  return cholesky.factor().n_factor_entries() / space.n_unknowns();
}

// Between layers of n nodes a node has at most its own and those on both sides in the factor, 3 n;
// merged supernodes at most double that.
TEST(CholmodFactor, RingOfManyLayersHasTheFactorOfABand) {
  const auto entries = [](const char* radial_cells, const char* angular_cells) {
    const Parameters parameters =
        parameters_of({std::string("Mesh/Radial cells=") + radial_cells,
                       std::string("Mesh/Angular cells=") + angular_cells});
    const Scene scene = make_scene(parameters);
    return factor_entries_per_unknown(MeshAndSpace(scene, parameters).space, scene);
  };
  EXPECT_LE(entries("2000", "8"), 6 * 8);
  EXPECT_LE(entries("8", "2000"), 6 * 8); // the first cut includes the seam
}

// Around a point each level of cells is the same, so that the factor grows with their number.
TEST(CholmodFactor, DeepMeshHasTheFactorOfAShallowOne) {
  const Parameters parameters = parameters_of({"Mesh/Radial cells=4", "Mesh/Angular cells=16"});
  const Scene scene = make_scene(parameters);
  MeshAndSpace ring(scene, parameters);
  std::vector<double> entries;
  for (int level = 1; level <= 20; ++level) {
    for (const auto& cell : ring.triangulation->active_cell_iterators())
      if (cell->vertex(3).distance({1, 3 * dealii::numbers::PI / 2}) < 1.5 * cell->diameter())
        cell->set_refine_flag();
    ring.triangulation->execute_coarsening_and_refinement();
    if (level % 10 == 0)
      entries.push_back(
          factor_entries_per_unknown(RingSpace(*ring.triangulation, scene, 1), scene));
  }
  EXPECT_LE(entries.back(), 1.3 * entries.front());
}

TEST(CholmodFactor, TrailingFactorIsThatOfTheSchurComplement) {
  const int n = 60;
  const RandomMatrix matrix(n);
  CholmodFactor cholesky(n);
  cholesky.set_matrix(matrix.triplets);
  cholesky.factorise();
  FullMatrix<double> inverse(n, n);
  inverse.invert(matrix.full);
  for (const int m : {0, 1, 13, n}) {
    const FullMatrix<double> factor = cholesky.trailing_factor(m);
    FullMatrix<double> schur(m, m);
    if (m > 0)
      factor.mTmult(schur, factor);

    // The inverse of the Schur complement is the trailing block of the inverse.
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < m; ++j) {
        double product = 0;
        for (int k = 0; k < m; ++k)
          product += schur(i, k) * inverse(n - m + k, n - m + j);
        EXPECT_NEAR(product, i == j, 1e-12);
      }
  }
}

TEST(CholmodFactor, SolvesAndMultiplies) {
  const int n = 60;
  const RandomMatrix matrix(n);
  CholmodFactor cholesky(n);
  LowerTriplets triplets = matrix.triplets;
  for (const bool is_first : {true, false}) { // then other values in the same pattern
    cholesky.set_matrix(triplets);
    cholesky.factorise();
    std::vector<double> x(n);
    for (int i = 0; i < n; ++i)
      x[i] = std::sin(i);
    const std::vector<double> product = cholesky.multiply(x);
    const std::vector<double> solved = cholesky.backward(cholesky.forward(product));
    for (int i = 0; i < n; ++i) {
      EXPECT_NEAR(solved[i], x[i], 1e-13);
      double sum = 0;
      for (int j = 0; j < n; ++j)
        sum += matrix.full(i, j) * x[j];
      EXPECT_NEAR(product[i], is_first ? sum : 2 * sum, 1e-12 * n);
    }
    for (double& entry : triplets.values)
      entry *= 2;
  }
}

TEST(CholmodFactor, RefusesAnIndefiniteMatrix) {
  LowerTriplets triplets;
  triplets.add(0, 0, 1);
  triplets.add(1, 0, 2);
  triplets.add(1, 1, 1);
  CholmodFactor cholesky(2);
  cholesky.set_matrix(triplets);
  EXPECT_THROW(cholesky.factorise(), NotSolved);
}

TEST(CholmodFactor, StartsNoThreads) {
  const auto n_threads = [] {
    using Entries = std::filesystem::directory_iterator;
    return std::distance(Entries("/proc/self/task"), Entries());
  };
  CholmodFactor cholesky(400);
  cholesky.set_matrix(RandomMatrix(400).triplets);
  const auto before = n_threads();
  cholesky.factorise();
  EXPECT_EQ(n_threads(), before);
}

class Direct : public testing::TestWithParam<int> {
protected:
  Direct()
      : parameters(
            parameters_of({"Mesh/Degree=" + std::to_string(GetParam()), "Mesh/Radial cells=2",
                           "Mesh/Angular cells=12", "Cylinder/Radial force=1 + r*sin(z)"})),
        scene(make_scene(parameters)), ring(scene, parameters),
        load(assemble_load(ring.space, scene)), solver(ring.boundary) {
    solver.set_problem(scene, ring.boundary, load, statistics);
  }

  const Parameters parameters;
  const Scene scene;
  const MeshAndSpace ring;
  const std::optional<FieldVector> load;
  RunStatistics statistics;
  DirectSolver solver;
};

TEST_P(Direct, StiffnessIsSymmetricAndSumsUpTheCells) {
  // K x against the sum of cell matrices, with constraints applied to both factors.
  FieldVector x = ring.space.make_field(), y = ring.space.make_field();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1, 1);
  for (unsigned int i = 0; i < x.size(); ++i) {
    x(i) = value(random);
    y(i) = value(random);
  }
  ring.space.constraints().distribute(x);
  ring.space.constraints().distribute(y);
  double by_cells = 0;
  stiffness_matrices(ring.space, scene)([&](const auto& dofs, const auto& cell_matrix) {
    for (unsigned int i = 0; i < dofs.size(); ++i)
      for (unsigned int j = 0; j < dofs.size(); ++j)
        by_cells += y(dofs[i]) * cell_matrix(i, j) * x(dofs[j]);
  });
  EXPECT_NEAR(y * solver.apply(x), by_cells, 1e-12 * std::abs(by_cells));
  EXPECT_NEAR(x * solver.apply(y), by_cells, 1e-12 * std::abs(by_cells));
}

TEST_P(Direct, PinnedProblemsAreInEquilibrium) {
  const unsigned int m = ring.boundary.size();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> value(-1, 1);
  for (int trial = 0; trial < 8; ++trial) {
    std::vector<bool> pinned(m);
    ContactState state;
    state.displacement.reinit(m);
    state.force.reinit(m);
    for (unsigned int i = 0; i < m; ++i) {
      pinned[i] = trial == 0 ? false : trial == 1 ? true : random() % 2;
      (pinned[i] ? state.displacement(i) : state.force(i)) = value(random);
    }
    const ContactState given = state;
    solver.solve(pinned, state, 0);
    const FieldVector field = solver.displacement_field(state);

    FieldVector imbalance = solver.apply(field);
    imbalance -= *load;
    for (unsigned int i = 0; i < m; ++i) {
      imbalance(ring.boundary.contact_nodes()[i].dof) += state.force(i);
      EXPECT_NEAR(field(ring.boundary.contact_nodes()[i].dof), state.displacement(i), 1e-13);
      if (pinned[i])
        EXPECT_EQ(state.displacement(i), given.displacement(i));
      else
        EXPECT_EQ(state.force(i), given.force(i));
    }
    EXPECT_LT(imbalance.linfty_norm(), 1e-12);
  }
}

// A solver made for a wider zone answers as one made for the zone.
TEST_P(Direct, FreesTheCandidatesOutsideOfTheZone) {
  const ContactBoundary wide(ring.space, {scene.zone_begin - 0.6, scene.zone_end + 0.6});
  const unsigned int m = ring.boundary.size();
  ASSERT_GT(wide.size(), m);
  DirectSolver of_wide(wide);
  of_wide.set_problem(scene, ring.boundary, load, statistics);
  std::vector<bool> pinned(m, true);
  pinned[m / 2] = false;
  ContactState one = {Vector<double>(m), Vector<double>(m)};
  for (unsigned int i = 0; i < m; ++i)
    one.displacement(i) = -0.1 * std::cos(i);
  ContactState other = one;
  solver.solve(pinned, one, 0);
  of_wide.solve(pinned, other, 0);
  for (unsigned int i = 0; i < m; ++i) {
    EXPECT_NEAR(other.displacement(i), one.displacement(i), 1e-13);
    EXPECT_NEAR(other.force(i), one.force(i), 1e-12);
  }
  FieldVector difference = of_wide.displacement_field(other);
  difference -= solver.displacement_field(one);
  EXPECT_LT(difference.linfty_norm(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Degree, Direct, testing::Values(1, 3));

/// u(b) of the contact-free solution of a constant f.
double free_displacement(const Scene& scene, double f) {
  const double a = scene.inner_radius, b = scene.outer_radius;
  return f * (-(b * b - a * a) / 4 + b * b / 2 * std::log(b / a));
}

TEST(Direct, ContactFreeSolutionOfAConstantForceConverges) {
  for (const int degree : {1, 2}) {
    std::vector<double> errors;
    for (const int cells : {4, 8, 16}) {
      const Parameters parameters = parameters_of(
          {"Mesh/Degree=" + std::to_string(degree), "Mesh/Radial cells=" + std::to_string(cells),
           "Mesh/Angular cells=6", "Cylinder/Radial force=-3", "Road/Distance=0.99"});
      const Scene scene = make_scene(parameters);
      const Solution solution = simulate(scene, parameters);
      EXPECT_EQ(solution.result.contact.active_nodes, 0u);
      EXPECT_EQ(solution.result.contact.loads.total, 0);
      EXPECT_FALSE(solution.result.contact.ends);
      errors.push_back(
          std::abs(solution.result.surface.front().displacement - free_displacement(scene, -3)));
    }
    // The surface value is an energy-type functional: twice the rate of the energy norm.
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2 * degree, 0.2);
    EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2 * degree, 0.2);
  }
}

} // namespace
