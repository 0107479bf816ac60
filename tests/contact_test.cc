// Both contact methods find the solution, prove it by its optimality conditions, and fail honestly.
#include "rollwave/base/errors.h"
#include "rollwave/contact/active_set.h"
#include "rollwave/contact/uzawa.h"
#include "rollwave/run/solve_on_mesh.h"
#include "test_scenes.h"

#include <deal.II/lac/full_matrix.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace rollwave;
using dealii::FullMatrix;
using dealii::Vector;

namespace {

/// The lower triangular L with L L^T = S.
dealii::LAPACKFullMatrix<double> cholesky_factor(const FullMatrix<double>& schur) {
  FullMatrix<double> lower(schur.m(), schur.m());
  lower.cholesky(schur);
  dealii::LAPACKFullMatrix<double> factor(schur.m());
  factor = lower;
  return factor;
}

TEST(ActiveSet, EndsWhereItsSetsWouldCycle) {
  // From the empty set the plain method visits {}, {0, 1}, {0, 2}, {}, ... for ever.
  FullMatrix<double> stiffness(3, 3);
  const double entries[] = {17, -7, 19, -7, 5, -7, 19, -7, 22};
  stiffness.fill(entries);
  Vector<double> load(3);
  load(0) = 4;
  load(1) = -4;
  load(2) = 1;
  CondensedSystem system(cholesky_factor(stiffness));
  const ContactEquations equations(system, load, 0, 3);
  RunStatistics statistics;
  ContactProblem problem;
  problem.phi.reinit(3);
  problem.weight.reinit(3);
  problem.weight = 1;

  const ContactSolution solution = active_set(equations, problem, 50, {}, statistics);
  EXPECT_FALSE(solution.notes.empty());
  for (unsigned int i = 0; i < 3; ++i) {
    EXPECT_LE(solution.state.displacement(i), 1e-14);
    EXPECT_GE(solution.state.force(i), -1e-13);
    EXPECT_NEAR(solution.state.force(i) * solution.state.displacement(i), 0, 1e-13);
  }
  EXPECT_THROW(active_set(equations, problem, 2, {}, statistics), NotSolved);
}

/// Mesh, equations and contact problem of a scene.
struct Prepared {
  explicit Prepared(const Parameters& parameters) : Prepared(make_scene(parameters), parameters) {}

  Prepared(const Scene& given, const Parameters& parameters)
      : scene(given), ring(scene, parameters),
        system(make_system(ring.space, scene, scene.zone(), statistics)),
        load(make_load(system, scene, statistics)),
        equations(contact_equations(system, load.get(), ring.boundary)),
        problem(make_contact_problem(ring.boundary, scene)) {}

  Scene scene;
  MeshAndSpace ring;
  RunStatistics statistics;
  System system;
  std::unique_ptr<const Load> load;
  ContactEquations equations;
  ContactProblem problem;
};

TEST(Uzawa, LargestComplianceIsThatOfTheRotationallySymmetricMode) {
  // A unit pressure all around displaces the surface by b ln(b / a).
  Prepared circle(
      full_circle(0.5, 1, 0.5, -0.1),
      parameters_of({"Mesh/Degree=2", "Mesh/Radial cells=16", "Mesh/Angular cells=12"}));
  const std::vector<bool> all(circle.problem.size(), true);
  EXPECT_NEAR(largest_compliance(circle.equations, circle.problem, all), std::log(2), 1e-6);
}

// Plain steps would be 9, 16 and 30.
TEST(ActiveSet, NeedsFewStepsOnStretchedCells) {
  for (const char* cells : {"250", "500", "1000"}) {
    Prepared scene(parameters_of(
        {"Mesh/Degree=1", "Mesh/Radial cells=2", std::string("Mesh/Angular cells=") + cells}));
    const ContactSolution solution =
        active_set(scene.equations, scene.problem, 50, {}, scene.statistics);
    EXPECT_LE(solution.history.size(), 18u) << cells;
    EXPECT_TRUE(solution.notes.empty());
  }
}

/// What contact adds to the displacement.
Vector<double> by_contact(Prepared& scene, Vector<double> displacement) {
  const unsigned int n = scene.problem.size();
  ContactState free = {Vector<double>(n), Vector<double>(n)};
  scene.equations.solve(std::vector<bool>(n, false), free, scene.statistics);
  displacement -= free.displacement;
  return displacement;
}

TEST(Uzawa, AgreesWithTheActiveSetToItsTolerance) {
  for (const PaperScene& paper : paper_scenes())
    for (const char* degree : {"Mesh/Degree=1", "Mesh/Degree=2"}) {
      Prepared scene(
          with(paper.parameters(), {degree, "Mesh/Radial cells=6", "Mesh/Angular cells=90"}));
      const ContactSolution exact =
          active_set(scene.equations, scene.problem, 50, {}, scene.statistics);
      for (const double tolerance : {1e-4, 1e-8, 1e-11}) {
        const ContactSolution solution =
            uzawa(scene.equations, scene.problem,
                  {ContactMethod::uzawa, std::nullopt, UzawaStop::gap, tolerance, 100000}, {},
                  scene.statistics);
        Vector<double> difference = solution.state.displacement;
        difference -= exact.state.displacement;
        EXPECT_LE(difference.l2_norm(),
                  tolerance * by_contact(scene, exact.state.displacement).l2_norm())
            << "figure " << paper.figure << ' ' << degree << ", tolerance " << tolerance;
      }
    }
}

// The remaining gap of Uzawa's method at active nodes does not count as an error of the mesh.
TEST(Uzawa, RefinesTheCellsThatTheActiveSetRefines) {
  for (const PaperScene& paper : paper_scenes())
    for (const char* degree : {"Mesh/Degree=1", "Mesh/Degree=2"}) {
      const Parameters parameters =
          with(paper.parameters(),
               {degree, "Mesh/Radial cells=2", "Mesh/Angular cells=60", "Mesh/Global refinements=1",
                "Mesh/Adaptive cycles=3", "Mesh/Marked fraction=0.3", "Contact/Tolerance=1e-9"});
      const Scene scene = make_scene(parameters);
      const Result exact = simulate(scene, parameters).result;
      const Result result = simulate(scene, with(parameters, {"Contact/Method=uzawa"})).result;
      for (unsigned int cycle = 0; cycle < 4; ++cycle) {
        EXPECT_EQ(result.cycles[cycle].n_cells, exact.cycles[cycle].n_cells)
            << "figure " << paper.figure << ' ' << degree << ", cycle " << cycle;
        const double indicated = exact.cycles[cycle].indicated.value_or(0); // none on the last mesh
        EXPECT_NEAR(result.cycles[cycle].indicated.value_or(0), indicated, 1e-5 * indicated)
            << "figure " << paper.figure << ' ' << degree << ", cycle " << cycle;
      }
    }
}

TEST(Uzawa, ConvergesBelowTheLargestRhoAndReportsItBeyond) {
  Prepared scene(with(paper_scenes()[1].parameters(),
                      {"Mesh/Degree=1", "Mesh/Radial cells=4", "Mesh/Angular cells=90"}));
  const ContactSolution exact =
      active_set(scene.equations, scene.problem, 50, {}, scene.statistics);
  const double largest = 2 / largest_compliance(scene.equations, scene.problem, exact.active);
  EXPECT_NO_THROW(uzawa(scene.equations, scene.problem,
                        {ContactMethod::uzawa, 0.97 * largest, UzawaStop::gap, 1e-6, 100000}, {},
                        scene.statistics));
  for (const double factor : {1.03, 1.5, 10.})
    try {
      uzawa(scene.equations, scene.problem,
            {ContactMethod::uzawa, factor * largest, UzawaStop::gap, 1e-6, 100000}, {},
            scene.statistics);
      FAIL() << "rho is " << factor << " times the largest that can converge";
    } catch (const NotSolved& failure) {
      std::ostringstream number;
      number << largest;
      EXPECT_NE(std::string(failure.what()).find(number.str()), std::string::npos);
    }
}

// A residual over rho is small, and so is one over a displacement that rho makes large.
TEST(Uzawa, DivergesWhateverTheTolerance) {
  Prepared scene(with(paper_scenes()[0].parameters(),
                      {"Mesh/Degree=1", "Mesh/Radial cells=3", "Mesh/Angular cells=36"}));
  const ContactSolution exact =
      active_set(scene.equations, scene.problem, 50, {}, scene.statistics);
  const double largest = 2 / largest_compliance(scene.equations, scene.problem, exact.active);
  for (const double rho : {1.001 * largest, 1.1 * largest, 20., 1e9, 1e300})
    for (const UzawaStop stop : {UzawaStop::gap, UzawaStop::change})
      for (const double tolerance : {0.1, 1e-3, 1e-8})
        EXPECT_THROW(uzawa(scene.equations, scene.problem,
                           {ContactMethod::uzawa, rho, stop, tolerance, 20000}, {},
                           scene.statistics),
                     NotSolved)
            << rho << ' ' << tolerance;
}

TEST(Uzawa, LeavesNoMoreThanItsToleranceExplains) {
  for (const PaperScene& paper : paper_scenes()) {
    Prepared scene(with(paper.parameters(), {"Mesh/Radial cells=3", "Mesh/Angular cells=36"}));
    const std::vector<bool> all(scene.problem.size(), true);
    const double safe = 2 / largest_compliance(scene.equations, scene.problem, all);
    for (const double rho : {0.01 * safe, 0.1 * safe, 0.5 * safe, 0.97 * safe})
      for (const UzawaStop stop : {UzawaStop::gap, UzawaStop::change})
        for (const double tolerance : {0.1, 1e-2, 1e-4}) {
          SCOPED_TRACE("figure " + std::to_string(paper.figure) + ", rho = " + shortest_text(rho) +
                       ", tolerance " + shortest_text(tolerance) +
                       (stop == UzawaStop::gap ? ", gap" : ", change"));
          const auto [displacement, force, kept] =
              uzawa(scene.equations, scene.problem,
                    {ContactMethod::uzawa, rho, stop, tolerance, 100000}, {}, scene.statistics)
                  .state;
          const Vector<double> gap = scene.problem.gaps(displacement);
          double penetration = 0, force_times_gap = 0, force_times_road = 0;
          for (unsigned int i = 0; i < gap.size(); ++i) {
            penetration = std::max(penetration, -gap(i));
            force_times_gap += std::abs(force(i) * gap(i));
            force_times_road += std::abs(force(i) * scene.problem.phi(i));
          }
          const double explained = 3 * (stop == UzawaStop::gap ? tolerance : std::sqrt(tolerance));
          EXPECT_LE(penetration, explained * by_contact(scene, displacement).linfty_norm());
          EXPECT_LE(force_times_gap, explained * force_times_road);
        }
  }
}

TEST(Uzawa, GivesUpAfterItsSteps) {
  Prepared scene(with(paper_scenes()[0].parameters(), {"Mesh/Angular cells=40"}));
  // The last is so small that squares of its steps vanish.
  for (const double rho : {0.01, 1e-300})
    EXPECT_THROW(uzawa(scene.equations, scene.problem,
                       {ContactMethod::uzawa, rho, UzawaStop::gap, 1e-10, 30}, {},
                       scene.statistics),
                 NotSolved);
  // Steps this short change u by little although nothing is solved.
  EXPECT_THROW(uzawa(scene.equations, scene.problem,
                     {ContactMethod::uzawa, 1e-9, UzawaStop::change, 1e-2, 1000}, {},
                     scene.statistics),
               NotSolved);
}

// On its way to the solution the displacement passes through zero.
TEST(Uzawa, ConvergesWithAVerySmallRho) {
  const std::vector<std::string> settings = {"Cylinder/Angular velocity=1",
                                             "Cylinder/Radial force=1", "Road/Distance=0.85",
                                             "Mesh/Radial cells=3", "Mesh/Angular cells=60"};
  Prepared scene(parameters_of(settings));
  const auto force_by = [&](double rho) {
    const ContactSolution solution =
        uzawa(scene.equations, scene.problem,
              {ContactMethod::uzawa, rho, UzawaStop::gap, 1e-2, 100000}, {}, scene.statistics);
    return loads_of(scene.problem, solution.state.force).total;
  };
  EXPECT_NEAR(force_by(0.001), force_by(0.01), 1e-3);
  EXPECT_NEAR(force_by(0.001), 0.50995, 0.01);
}

TEST(Uzawa, DoesNotEndByTheChangeOfShortSteps) {
  Prepared scene(
      parameters_of({"Cylinder/Radial force=-8*exp(-((z-4.71238898)/0.2)^2)", "Road/Distance=0.7",
                     "Mesh/Radial cells=3", "Mesh/Angular cells=60"}));
  const ContactSolution solution =
      uzawa(scene.equations, scene.problem,
            {ContactMethod::uzawa, 0.001, UzawaStop::change, 1e-2, 100000}, {}, scene.statistics);
  EXPECT_NEAR(loads_of(scene.problem, solution.state.force).total, 0.05105, 0.006);
}

TEST(Uzawa, NeedsTheStepsOfThePapersFigure9) {
  // Mesh and stopping rule are those of prm/figure-9.prm; the counts are published in M2AN 25
  // (1991), figure 9, where 0 stands for none.
  const std::vector<double> rhos = {0.5, 1, 1.5, 2, 2.5, 2.75, 3, 3.25, 3.5};
  const std::vector<std::vector<int>> published = {{37, 28, 0, 19, 17, 16, 14, 18, 28},
                                                   {29, 19, 15, 12, 14, 21, 37, 0, 0}};
  const double best_rho[] = {3, 2};
  for (int figure = 0; figure < 2; ++figure) {
    Prepared scene(with(paper_scenes()[figure].parameters(),
                        {"Mesh/Degree=1", "Mesh/Radial cells=4", "Mesh/Angular cells=180"}));
    std::vector<unsigned int> counts;
    for (unsigned int i = 0; i < rhos.size() && (i == 2 || published[figure][i] > 0); ++i) {
      counts.push_back(uzawa(scene.equations, scene.problem,
                             {ContactMethod::uzawa, rhos[i], UzawaStop::change, 2.5e-4, 1000}, {},
                             scene.statistics)
                           .history.size());
      if (published[figure][i] > 0) {
        EXPECT_NEAR(counts.back(), published[figure][i], 5) << "rho = " << rhos[i];
      }
    }
    const auto best = std::min_element(counts.begin(), counts.end());
    EXPECT_EQ(std::count(counts.begin(), counts.end(), *best), 1);
    EXPECT_EQ(rhos[best - counts.begin()], best_rho[figure]);
  }
}

} // namespace
