// The iterative kind of solver gives the answer of the direct kind, and says what it took.
#include "rollwave/solver/iterative_solver.h"

#include "rollwave/base/errors.h"
#include "rollwave/mesh/assembly.h"
#include "rollwave/run/measure.h"
#include "rollwave/run/simulation.h"
#include "rollwave/solver/amg_cg.h"
#include "rollwave/solver/choose_solver.h"
#include "test_scenes.h"

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace rollwave;
using dealii::Vector;

namespace {

struct Answer {
  Answer(const Scene& scene, const Parameters& parameters, const ContactBoundary& boundary,
         const std::string& kind)
      : on_mesh(solve_on_mesh(scene, with(parameters, {"Solver/Kind=" + kind}), boundary, {}, cache,
                              statistics)),
        result(measure(on_mesh)) {}

  RunStatistics statistics;
  MeshCache cache;
  MeshSolution on_mesh;
  Result result;
};

void expect_same_answer(const Scene& scene, const Parameters& parameters,
                        const ContactBoundary& boundary) {
  const Answer direct(scene, parameters, boundary, "direct");
  const Answer iterative(scene, parameters, boundary, "iterative");

  EXPECT_EQ(iterative.on_mesh.contact.active, direct.on_mesh.contact.active);
  FieldVector difference = iterative.on_mesh.displacement;
  difference -= direct.on_mesh.displacement;
  EXPECT_LE(difference.linfty_norm(), 1e-10 * direct.on_mesh.displacement.linfty_norm());
  EXPECT_NEAR(iterative.result.contact.loads.total, direct.result.contact.loads.total,
              1e-10 * direct.result.contact.loads.total);
  EXPECT_NEAR(iterative.result.energy.value, direct.result.energy.value,
              1e-10 * std::abs(direct.result.energy.value));

  const Residuals& residuals = iterative.result.residuals;
  EXPECT_LT(residuals.equilibrium, 1e-10);
  EXPECT_LE(residuals.penetration, direct.result.residuals.penetration + 1e-10);
  EXPECT_LE(residuals.negative_pressure, 1e-10);
  EXPECT_LE(residuals.complementarity, direct.result.residuals.complementarity + 1e-10);

  EXPECT_GT(iterative.statistics.linear_iterations, 0u);
  EXPECT_GT(iterative.statistics.preconditioners, 0u);
  EXPECT_EQ(iterative.statistics.factorisations, 0u);
  EXPECT_EQ(direct.statistics.linear_iterations, 0u);
  EXPECT_EQ(direct.statistics.preconditioners, 0u);
}

class IterativeKind : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(IterativeKind, AgreesWithTheDirectKind) {
  const Parameters parameters = with(parameters_of({"Certificate/Error bound=false"}), GetParam());
  const Scene scene = make_scene(parameters);
  const Solution solution = simulate(scene, parameters);
  expect_same_answer(scene, parameters, ContactBoundary(solution.space(), scene.zone()));
}

// Cells that are square, long in r, long in z, and adaptive ones.
INSTANTIATE_TEST_SUITE_P(
    Scene, IterativeKind,
    testing::Values(
        std::vector<std::string>{"Mesh/Degree=1", "Mesh/Radial cells=16", "Mesh/Angular cells=200",
                                 "Cylinder/Angular velocity=0"},
        std::vector<std::string>{"Mesh/Degree=2", "Mesh/Radial cells=5", "Mesh/Angular cells=300",
                                 "Cylinder/Angular velocity=1"},
        std::vector<std::string>{"Mesh/Degree=1", "Mesh/Radial cells=70", "Mesh/Angular cells=40",
                                 "Cylinder/Radial force=1 + r*sin(z)"},
        std::vector<std::string>{"Mesh/Degree=2", "Mesh/Radial cells=4", "Mesh/Angular cells=48",
                                 "Mesh/Adaptive cycles=9", "Cylinder/Angular velocity=1",
                                 "Cylinder/Radial force=1 + r*sin(z)"},
        std::vector<std::string>{"Mesh/Degree=1", "Mesh/Radial cells=12", "Mesh/Angular cells=150",
                                 "Cylinder/Angular velocity=1", "Contact/Method=uzawa",
                                 "Contact/Tolerance=1e-12"}));

TEST(Iterative, CertifiesWhatTheDirectKindDoes) {
  // A spot next to the seam: hanging nodes lie on it, which both problems tie in their own ways.
  for (const auto* degree : {"1", "2", "3"}) {
    SCOPED_TRACE(degree);
    const auto certified = [&](const std::string& kind) {
      const Parameters own =
          parameters_of({std::string("Mesh/Degree=") + degree, "Mesh/Radial cells=4",
                         "Mesh/Angular cells=48", "Mesh/Adaptive cycles=4", "Solver/Kind=" + kind,
                         "Cylinder/Radial force=if((r-0.8)^2+(z-1.6)^2<0.02,3,0)"});
      return *simulate(make_scene(own), own).result.certified;
    };
    const CertifiedError direct = certified("direct"), iterative = certified("iterative");
    EXPECT_NEAR(iterative.energy_norm, direct.energy_norm, 1e-8 * direct.energy_norm);
    EXPECT_NEAR(iterative.lower_bound, direct.lower_bound, 1e-9 * std::abs(direct.lower_bound));
    EXPECT_NEAR(iterative.upper_bound, direct.upper_bound, 1e-9 * std::abs(direct.upper_bound));
  }
}

/// Both kinds of solver for one matrix, with a force and hanging nodes.
class Kinds : public testing::Test {
protected:
  Kinds()
      : parameters(parameters_of({"Mesh/Radial cells=10", "Mesh/Angular cells=126",
                                  "Mesh/Adaptive cycles=2", "Certificate/Error bound=false",
                                  "Cylinder/Radial force=1 + r*sin(z)"})),
        scene(make_scene(parameters)), adaptive(simulate(scene, parameters)),
        space(adaptive.space()), boundary(space, scene.zone()), load(assemble_load(space, scene)),
        direct(boundary), iterative(boundary) {
    direct.set_problem(scene, boundary, load, direct_work);
    iterative.set_problem(scene, boundary, load, iterative_work);
  }

  /// Random displacements on the pinned nodes, random forces on the others.
  ContactState random_state(const std::vector<bool>& pinned) {
    ContactState state;
    state.displacement.reinit(pinned.size());
    state.force.reinit(pinned.size());
    for (unsigned int i = 0; i < pinned.size(); ++i)
      (pinned[i] ? state.displacement(i) : state.force(i)) = value(random);
    return state;
  }

  const Parameters parameters;
  const Scene scene;
  const Solution adaptive;
  const RingSpace& space;
  const ContactBoundary boundary;
  const std::optional<FieldVector> load;
  RunStatistics direct_work, iterative_work;
  DirectSolver direct;
  IterativeSolver iterative;
  std::mt19937 random{5};
  std::uniform_real_distribution<double> value{-1, 1};
};

TEST_F(Kinds, AgreeForAnyPinnedNodes) {
  const unsigned int m = boundary.size();
  for (int trial = 0; trial < 6; ++trial) {
    std::vector<bool> pinned(m);
    for (unsigned int i = 0; i < m; ++i)
      pinned[i] = trial == 0 ? false : trial == 1 ? true : random() % 2;
    ContactState one = random_state(pinned), other = one;
    direct.solve(pinned, one, 0);
    EXPECT_LE(iterative.solve(pinned, other, 1e-12), 1e-12);
    for (unsigned int i = 0; i < m; ++i) {
      EXPECT_NEAR(other.displacement(i), one.displacement(i), 1e-11);
      EXPECT_NEAR(other.force(i), one.force(i), 1e-11);
      if (pinned[i]) {
        EXPECT_EQ(other.displacement(i), one.displacement(i));
      }
    }

    FieldVector field = iterative.displacement_field(other);
    FieldVector product = iterative.apply(field);
    product -= direct.apply(field);
    EXPECT_LT(product.linfty_norm(), 1e-13);
    field -= direct.displacement_field(one);
    EXPECT_LT(field.linfty_norm(), 1e-11);
  }
}

TEST_F(Kinds, AgreeOnTheCompliance) {
  Vector<double> force(boundary.size());
  for (double& nodal : force)
    nodal = value(random);
  Vector<double> difference = iterative.apply_compliance(force, 1e-12);
  const Vector<double> response = direct.apply_compliance(force, 0);
  difference -= response;
  EXPECT_LE(difference.linfty_norm(), 1e-10 * response.linfty_norm());
}

TEST_F(Kinds, TheIterativeOneContinuesItsLastSolution) {
  const std::vector<bool> pinned(boundary.size(), true);
  ContactState state = random_state(pinned);
  iterative.solve(pinned, state, 1e-3);
  const unsigned int loose = iterative_work.linear_iterations;
  iterative.solve(pinned, state, 1e-3);
  EXPECT_EQ(iterative_work.linear_iterations, loose);
  iterative.solve(pinned, state, 1e-11);
  const unsigned int both = iterative_work.linear_iterations;
  EXPECT_GT(both, loose);
  EXPECT_EQ(iterative_work.preconditioners, 1u);

  RunStatistics statistics;
  IterativeSolver fresh(boundary);
  fresh.set_problem(scene, boundary, load, statistics);
  fresh.solve(pinned, state, 1e-11);
  EXPECT_LE(both, statistics.linear_iterations + 2);
}

TEST_F(Kinds, GiveTheFieldOfTheStateThatIsAskedFor) {
  const unsigned int m = boundary.size();
  for (ContactLinearSolver* const solver : {static_cast<ContactLinearSolver*>(&direct),
                                            static_cast<ContactLinearSolver*>(&iterative)}) {
    std::vector<bool> pinned(m);
    for (unsigned int i = 0; i < m; ++i)
      pinned[i] = i % 3 == 0;
    ContactState one = random_state(pinned), other = random_state(pinned);
    solver->solve(pinned, one, 1e-12);
    FieldVector field = solver->displacement_field(one);
    solver->solve(pinned, other, 1e-12);
    field -= solver->displacement_field(one);
    EXPECT_LT(field.linfty_norm(), 1e-10);
  }
}

TEST_F(Kinds, AgreeOnTheChangeOfForces) {
  const unsigned int m = boundary.size();
  std::vector<bool> pinned(m);
  for (unsigned int i = 0; i < m; ++i)
    pinned[i] = i % 3 != 0;
  const ContactState change = random_state(pinned);
  // The problem is linear: that of two states is the difference of their forces.
  ContactState one = random_state(pinned), other = one;
  other.displacement += change.displacement;
  direct.solve(pinned, one, 0);
  direct.solve(pinned, other, 0);
  Vector<double> difference = other.force;
  difference -= one.force;
  const double size = difference.linfty_norm();

  iterative.solve(pinned, one, 1e-12);
  for (ContactLinearSolver* const solver : {static_cast<ContactLinearSolver*>(&direct),
                                            static_cast<ContactLinearSolver*>(&iterative)}) {
    Vector<double> forces = solver->derivative(pinned, change.displacement, 1e-13).force;
    forces -= difference;
    EXPECT_LE(forces.linfty_norm(), 1e-10 * size);
  }
  // The iterative one still goes on where it stopped.
  const unsigned int iterations = iterative_work.linear_iterations;
  iterative.solve(pinned, one, 1e-11);
  EXPECT_EQ(iterative_work.linear_iterations, iterations);
}

TEST_F(Kinds, ZeroForcesGiveZeroDisplacement) {
  RunStatistics statistics;
  const std::optional<FieldVector> no_load;
  IterativeSolver solver(boundary);
  solver.set_problem(scene, boundary, no_load, statistics);
  const unsigned int m = boundary.size();
  ContactState state = random_state(std::vector<bool>(m, true));
  solver.solve(std::vector<bool>(m, true), state, 1e-11);
  EXPECT_GT(state.force.l2_norm(), 0);
  state.force = 0;
  EXPECT_EQ(solver.solve(std::vector<bool>(m, false), state, 1e-11), 0);
  EXPECT_EQ(state.displacement.linfty_norm(), 0);
}

TEST(FullContact, HasItsExactForceAtEverySpeed) {
  const Parameters parameters = parameters_of(
      {"Mesh/Degree=2", "Mesh/Radial cells=16", "Mesh/Angular cells=12", "Contact/Most steps=10"});
  for (const std::string kind : {"direct", "iterative"})
    for (const double omega : {0., 0.5, 1.}) {
      const Scene scene = full_circle(0.5, 1, omega, -0.1);
      const MeshAndSpace ring(scene, parameters);
      const Answer answer(scene, parameters, ring.boundary, kind);
      EXPECT_EQ(answer.result.contact.active_nodes, 24u);
      const Vector<double>& nodal = answer.on_mesh.contact.state.force;
      const double force = nodal.l1_norm();
      EXPECT_NEAR(force, 2 * dealii::numbers::PI * 0.1 / std::log(2), 1e-6);
      // Every node carries the same pressure.
      for (unsigned int i = 0; i < nodal.size(); ++i)
        EXPECT_NEAR(nodal(i) / answer.on_mesh.problem.weight(i), force / (2 * dealii::numbers::PI),
                    kind == "direct" ? 1e-12 : 1e-8);
    }
}

TEST(SolverChoice, TurnsToTheIterativeKindWhereTheFactorWouldNotFit) {
  // The dense problem of 200000 contact nodes needs 300 GiB.
  const Parameters parameters =
      parameters_of({"Mesh/Degree=1", "Mesh/Radial cells=1", "Mesh/Angular cells=200000"});
  const Scene scene = full_circle(0.5, 1, 0.5, -0.1);
  const MeshAndSpace ring(scene, parameters);
  const std::optional<FieldVector> no_load;
  RunStatistics statistics;
  const SolverChoice choice = choose_solver(SolverKind::automatic, ring.boundary, scene,
                                            ring.boundary, no_load, statistics);
  EXPECT_NE(dynamic_cast<const IterativeSolver*>(choice.solver.get()), nullptr);
  EXPECT_NE(choice.remark.find("200000 contact nodes"), std::string::npos) << choice.remark;
  EXPECT_THROW(
      choose_solver(SolverKind::direct, ring.boundary, scene, ring.boundary, no_load, statistics),
      NotEnoughMemory);
}

// The dense problem of m contact nodes takes m^3 operations, conjugate gradients some of each
// unknown.
TEST(SolverChoice, TurnsToTheIterativeKindWhereTheDenseProblemTakesLonger) {
  for (const auto& [radial_cells, is_direct] : {std::pair("1", false), std::pair("16", true)}) {
    const Parameters parameters =
        parameters_of({"Mesh/Degree=1", std::string("Mesh/Radial cells=") + radial_cells,
                       "Mesh/Angular cells=3000"});
    const Scene scene = full_circle(0.5, 1, 0.5, -0.1);
    const MeshAndSpace ring(scene, parameters);
    RunStatistics statistics;
    const std::optional<FieldVector> no_load;
    const SolverChoice choice = choose_solver(SolverKind::automatic, ring.boundary, scene,
                                              ring.boundary, no_load, statistics);
    EXPECT_EQ(choice.kind, is_direct ? SolverKind::direct : SolverKind::iterative);
    EXPECT_EQ(choice.remark.empty(), is_direct);
    EXPECT_EQ(statistics.factorisations, is_direct ? 1u : 0u);
  }
}

/// The iterations to 1e-10 from zero for a random right-hand side, which has all angular modes, on
/// the mesh of @p settings, refined where it says, with the nodes pinned that are in contact.
unsigned int count_iterations(const std::vector<std::string>& settings) {
  const Parameters parameters = with(parameters_of({"Certificate/Error bound=false"}), settings);
  const Scene scene = make_scene(parameters);
  const Solution solution = simulate(scene, parameters);
  const RingSpace& space = solution.space();
  dealii::AffineConstraints<double> constraints;
  constraints.copy_from(space.constraints());
  const ContactBoundary boundary(space, scene.zone());
  for (unsigned int i = 0; i < boundary.size(); ++i)
    if (solution.result.contact_rows[i].pressure > 0)
      constraints.add_line(boundary.contact_nodes()[i].dof);
  constraints.close();

  RunStatistics statistics;
  AmgCg solver(space);
  solver.set_matrix(constraints, stiffness_matrices(space, scene), statistics);
  const FieldVector rhs = random_load(space, constraints);
  FieldVector u = space.make_field();
  const double size = rhs.l2_norm();
  EXPECT_LE(solver.improve(
                u, rhs, [size](const FieldVector&) { return size; }, 1e-10, statistics),
            1e-10);
  return statistics.linear_iterations;
}

class Multigrid : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(Multigrid, NeedsFewIterationsAtAnySpeedAndDegree) {
  for (const std::string speed : {"0", "1"})
    for (const std::string degree : {"1", "2"}) {
      std::vector<std::string> settings = GetParam();
      settings.push_back("Cylinder/Angular velocity=" + speed);
      settings.push_back("Mesh/Degree=" + degree);
      EXPECT_LE(count_iterations(settings), speed == "0" ? 25u : 40u) << speed << ' ' << degree;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, Multigrid,
    testing::Values(std::vector<std::string>{"Mesh/Radial cells=40", "Mesh/Angular cells=250"},
                    std::vector<std::string>{"Mesh/Radial cells=80", "Mesh/Angular cells=50"},
                    std::vector<std::string>{"Mesh/Radial cells=8", "Mesh/Angular cells=800"},
                    std::vector<std::string>{"Cylinder/Inner radius=0.99", "Road/Distance=0.995",
                                             "Mesh/Radial cells=3", "Mesh/Angular cells=1000"},
                    std::vector<std::string>{"Cylinder/Inner radius=0.01", "Mesh/Radial cells=40",
                                             "Mesh/Angular cells=125"},
                    std::vector<std::string>{"Mesh/Radial cells=3", "Mesh/Angular cells=38",
                                             "Mesh/Adaptive cycles=100",
                                             "Mesh/Most unknowns=10000"}));

} // namespace
