// The factorisation answers every pinned problem exactly as dense algebra does.
#include "random_matrix.h"
#include "rollwave/base/errors.h"
#include "rollwave/run/solve_on_mesh.h"
#include "rollwave/solver/assembly.h"
#include "test_scenes.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <random>
#include <vector>

using namespace rollwave;
using dealii::FullMatrix;
using dealii::Vector;

namespace {

double factor_entries_per_unknown(const RingSpace& space, const Scene& scene) {
  CholmodFactor cholesky(space.n_unknowns(), 0);
  cholesky.set_matrix(assemble_stiffness(space, scene).entries());
  return cholesky.n_factor_entries() / space.n_unknowns();
}

// Nodes of coarse and fine cells on one edge may be at one place, or nearly.
TEST(NestedDissection, HasEachDegreeOfFreedomOnce) {
  for (int degree = 1; degree <= 8; ++degree) {
    const Parameters parameters = parameters_of(
        {"Mesh/Degree=" + std::to_string(degree), "Mesh/Radial cells=3", "Mesh/Angular cells=14"});
    const Scene scene = make_scene(parameters);
    MeshAndSpace ring(scene, parameters);
    for (int level = 1; level <= 4; ++level) {
      for (const auto& cell : ring.triangulation->active_cell_iterators())
        if (std::cos(7 * cell->center()[1] + level * cell->center()[0]) > 0.7)
          cell->set_refine_flag();
      ring.triangulation->execute_coarsening_and_refinement();
    }
    const RingSpace space(*ring.triangulation, scene, degree);
    std::vector<dealii::types::global_dof_index> order = space.elimination_order();
    std::sort(order.begin(), order.end());
    ASSERT_EQ(order.size(), space.dof_handler().n_dofs()) << degree;
    for (unsigned int dof = 0; dof < order.size(); ++dof)
      ASSERT_EQ(order[dof], dof) << degree;
  }
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

TEST(CholmodFactor, PartsTheLastUnknowns) {
  const int n = 60;
  const RandomMatrix matrix(n);
  FullMatrix<double> inverse(n, n);
  inverse.invert(matrix.full);
  std::vector<double> x(n);
  for (int i = 0; i < n; ++i)
    x[i] = std::sin(i);
  for (const int m : {0, 1, 13, n}) {
    CholmodFactor cholesky(n, m);
    cholesky.set_matrix(matrix.triplets);
    cholesky.factorise();
    const dealii::LAPACKFullMatrix<double> factor = cholesky.schur_factor();
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

    const std::vector<double> b = cholesky.multiply(x);
    for (int i = 0; i < n; ++i) {
      double sum = 0;
      for (int j = 0; j < n; ++j)
        sum += matrix.full(i, j) * x[j];
      EXPECT_NEAR(b[i], sum, 1e-12 * n);
    }
    const Vector<double> x_c(x.end() - m, x.end()), condensed = cholesky.condense(b);
    const std::vector<double> solved = cholesky.solve(b, x_c);
    for (int i = 0; i < n; ++i)
      EXPECT_NEAR(solved[i], x[i], 1e-13);
    Vector<double> schur_times_x(m);
    if (m > 0)
      schur.vmult(schur_times_x, x_c);
    for (int i = 0; i < m; ++i)
      EXPECT_NEAR(condensed(i), schur_times_x(i), 1e-12 * n);

    // Without b: K_ii x_i = -K_ic x_c
    const std::vector<double> followed = cholesky.solve({}, x_c),
                              balance = cholesky.multiply(followed);
    for (int i = 0; i < n; ++i)
      EXPECT_NEAR(i < n - m ? balance[i] : followed[i], i < n - m ? 0 : x[i], 1e-12);
  }
}

TEST(CholmodFactor, RefusesAnIndefiniteMatrix) {
  LowerTriplets triplets;
  triplets.add(0, 0, 1);
  triplets.add(1, 0, 2);
  triplets.add(1, 1, 1);
  CholmodFactor cholesky(2, 0);
  cholesky.set_matrix(triplets);
  EXPECT_THROW(cholesky.factorise(), NotSolved);
}

TEST(CholmodFactor, StartsNoThreads) {
  const auto n_threads = [] {
    using Entries = std::filesystem::directory_iterator;
    return std::distance(Entries("/proc/self/task"), Entries());
  };
  CholmodFactor cholesky(400, 0);
  cholesky.set_matrix(RandomMatrix(400).triplets);
  const auto before = n_threads();
  cholesky.factorise();
  EXPECT_EQ(n_threads(), before);
}

class Condensation : public testing::TestWithParam<int> {
protected:
  Condensation()
      : parameters(
            parameters_of({"Mesh/Degree=" + std::to_string(GetParam()), "Mesh/Radial cells=2",
                           "Mesh/Angular cells=12", "Cylinder/Radial force=1 + r*sin(z)"})),
        scene(make_scene(parameters)), ring(scene, parameters),
        system(make_system(ring.space, scene, scene.zone(), statistics)),
        load(make_load(system, scene, statistics)),
        equations(contact_equations(system, load.get(), ring.boundary)) {}

  /// Random displacements on the pinned nodes, random forces on the others.
  ContactState random_state(const std::vector<bool>& pinned) {
    ContactState state = {Vector<double>(pinned.size()), Vector<double>(pinned.size())};
    for (unsigned int i = 0; i < pinned.size(); ++i)
      (pinned[i] ? state.displacement(i) : state.force(i)) = value(random);
    return state;
  }

  std::vector<bool> every_third(bool pinned) const {
    std::vector<bool> nodes(ring.boundary.size(), !pinned);
    for (unsigned int i = 0; i < nodes.size(); i += 3)
      nodes[i] = pinned;
    return nodes;
  }

  FieldVector field_of(const ContactState& state) {
    return expand(system, load.get(), state.kept, statistics);
  }

  const Parameters parameters;
  const Scene scene;
  const MeshAndSpace ring;
  RunStatistics statistics;
  const System system;
  const std::unique_ptr<const Load> load;
  const ContactEquations equations;
  std::mt19937 random{5};
  std::uniform_real_distribution<double> value{-1, 1};
};

TEST_P(Condensation, StiffnessIsSymmetricAndSumsUpTheCells) {
  // K x against the form a(x, y) by a rule of many points.
  FieldVector x = ring.space.make_field(), y = ring.space.make_field();
  for (unsigned int i = 0; i < x.size(); ++i) {
    x(i) = value(random);
    y(i) = value(random);
  }
  ring.space.constraints().distribute(x);
  ring.space.constraints().distribute(y);
  const dealii::DoFHandler<2>& handler = ring.space.dof_handler();
  const dealii::QGauss<2> rule(12);
  dealii::FEValues<2> values(ring.space.mapping(), handler.get_fe(), rule,
                             dealii::update_gradients | dealii::update_quadrature_points |
                                 dealii::update_JxW_values);
  std::vector<dealii::Tensor<1, 2>> x_gradients(rule.size()), y_gradients(rule.size());
  double form = 0;
  for (const auto& cell : handler.active_cell_iterators()) {
    values.reinit(cell);
    values.get_function_gradients(x, x_gradients);
    values.get_function_gradients(y, y_gradients);
    for (const unsigned int q : values.quadrature_point_indices()) {
      const double r = values.quadrature_point(q)[0];
      form += r * values.JxW(q) *
              (x_gradients[q][0] * y_gradients[q][0] +
               scene.alpha(r) * x_gradients[q][1] * y_gradients[q][1]);
    }
  }
  EXPECT_NEAR(y * system.factor->apply(x), form, 1e-12 * std::abs(form));
  EXPECT_NEAR(x * system.factor->apply(y), form, 1e-12 * std::abs(form));
}

TEST_P(Condensation, PinnedProblemsAreInEquilibrium) {
  const unsigned int m = ring.boundary.size();
  for (int trial = 0; trial < 8; ++trial) {
    std::vector<bool> pinned(m);
    for (unsigned int i = 0; i < m; ++i)
      pinned[i] = trial == 0 ? false : trial == 1 ? true : random() % 2;
    const ContactState given = random_state(pinned);
    ContactState state = given;
    equations.solve(pinned, state, statistics);
    const FieldVector field = field_of(state);

    FieldVector imbalance = system.factor->apply(field);
    imbalance -= load->vector;
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

// A system made for a wider zone answers as one made for the zone.
TEST_P(Condensation, FreesTheNodesOutsideOfTheZone) {
  const std::pair<double, double> wide_zone = {scene.zone_begin - 0.6, scene.zone_end + 0.6};
  const System wide = make_system(ring.space, scene, wide_zone, statistics);
  const std::unique_ptr<const Load> wide_load = make_load(wide, scene, statistics);
  ASSERT_GT(wide.boundary.size(), ring.boundary.size());
  const ContactEquations of_wide = contact_equations(wide, wide_load.get(), ring.boundary);
  const std::vector<bool> pinned = every_third(false);
  ContactState one = random_state(pinned), other = one;
  equations.solve(pinned, one, statistics);
  of_wide.solve(pinned, other, statistics);
  for (unsigned int i = 0; i < pinned.size(); ++i) {
    EXPECT_NEAR(other.displacement(i), one.displacement(i), 1e-13);
    EXPECT_NEAR(other.force(i), one.force(i), 1e-12);
  }
  FieldVector difference = expand(wide, wide_load.get(), other.kept, statistics);
  difference -= field_of(one);
  EXPECT_LT(difference.linfty_norm(), 1e-12);
}

TEST_P(Condensation, ComplianceIsTheResponseToForces) {
  const std::vector<bool> none(ring.boundary.size(), false);
  ContactState pushed = random_state(none),
               unloaded = {pushed.displacement, Vector<double>(none.size())};
  equations.solve(none, pushed, statistics);
  equations.solve(none, unloaded, statistics);
  Vector<double> sum = equations.apply_compliance(pushed.force); // forces push towards the hub
  sum += pushed.displacement;
  sum -= unloaded.displacement;
  EXPECT_LE(sum.linfty_norm(), 1e-12 * pushed.displacement.linfty_norm());
}

TEST_P(Condensation, DerivativeIsTheDifferenceOfTwoStates) {
  const std::vector<bool> pinned = every_third(true);
  const ContactState change = random_state(pinned);
  ContactState one = random_state(pinned), other = one;
  other.displacement += change.displacement;
  equations.solve(pinned, one, statistics);
  equations.solve(pinned, other, statistics);
  const ContactState derivative = equations.derivative(pinned, change.displacement, statistics);
  for (unsigned int i = 0; i < pinned.size(); ++i) {
    EXPECT_NEAR(derivative.force(i), other.force(i) - one.force(i), 1e-11);
    EXPECT_NEAR(derivative.displacement(i), other.displacement(i) - one.displacement(i), 1e-11);
  }
}

INSTANTIATE_TEST_SUITE_P(Degree, Condensation, testing::Values(1, 3));

TEST(FullContact, HasItsExactForceAtEverySpeed) {
  const Parameters parameters = parameters_of(
      {"Mesh/Degree=2", "Mesh/Radial cells=16", "Mesh/Angular cells=12", "Contact/Most steps=10"});
  for (const double omega : {0., 0.5, 1.}) {
    const Scene scene = full_circle(0.5, 1, omega, -0.1);
    const MeshAndSpace ring(scene, parameters);
    RunStatistics statistics;
    const MeshObjects objects = {make_system(ring.space, scene, scene.zone(), statistics)};
    const MeshSolution solution = solve_on_mesh(objects, scene, parameters.contact, {}, statistics);
    EXPECT_EQ(solution.result.contact.active_nodes, 24u);
    const Vector<double>& nodal = solution.contact.state.force;
    const double force = nodal.l1_norm();
    EXPECT_NEAR(force, 2 * dealii::numbers::PI * 0.1 / std::log(2), 1e-6);
    // Every node carries the same pressure.
    for (unsigned int i = 0; i < nodal.size(); ++i)
      EXPECT_NEAR(nodal(i) / solution.problem.weight(i), force / (2 * dealii::numbers::PI), 1e-12);
  }
}

TEST(DenseProblem, IsRefusedBeforeAnyWorkWhereItWouldNotFit) {
  const auto key_of_refusal = [](const std::vector<std::string>& assignments) {
    try {
      const Parameters parameters = parameters_of(assignments);
      check_simulation(make_scene(parameters), parameters);
    } catch (const BadValue& refused) {
      return refused.section + '/' + refused.key;
    }
    return std::string();
  };
  EXPECT_EQ(key_of_refusal({"Mesh/Degree=1", "Mesh/Radial cells=1", "Mesh/Angular cells=200000"}),
            "Mesh/Angular cells");
  EXPECT_EQ(key_of_refusal({"Mesh/Degree=1", "Mesh/Radial cells=1", "Mesh/Angular cells=250",
                            "Mesh/Global refinements=10", "Mesh/Most unknowns=1000000000"}),
            "Mesh/Global refinements");
  EXPECT_EQ(key_of_refusal({"Mesh/Degree=1", "Mesh/Radial cells=1", "Mesh/Angular cells=2000"}),
            "");
  EXPECT_THROW(require_dense_memory(1e6, MPI_COMM_SELF), NotEnoughMemory);
}

/// u(b) of the contact-free solution of a constant f.
double free_displacement(const Scene& scene, double f) {
  const double a = scene.inner_radius, b = scene.outer_radius;
  return f * (-(b * b - a * a) / 4 + b * b / 2 * std::log(b / a));
}

TEST(ContactFree, SolutionOfAConstantForceConverges) {
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
