// Scenes in which digits could be lost: other units, contact that is no contact, hairline contact.
#include "manufactured_scene.h"
#include "rollwave/run/quantities.h"
#include "rollwave/study/study.h"
#include "rollwave/verify/reference_solution.h"
#include "rollwave/verify/true_errors.h"
#include "test_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>
#include <string>

using namespace rollwave;

namespace {

/// The quantities of a scene with a force, all its lengths multiplied by @p scale.
std::map<std::string, double> solve_scaled(double scale) {
  const Parameters parameters = parameters_of(
      {assignment("Cylinder/Inner radius", 0.45 * scale),
       assignment("Cylinder/Outer radius", 1.1 * scale),
       assignment("Cylinder/Angular velocity", 0.7 / scale),
       assignment("Cylinder/Radial force", 0.25 / scale), assignment("Road/Distance", 0.9 * scale),
       "Mesh/Radial cells=3", "Mesh/Angular cells=40", "Mesh/Adaptive cycles=3"});
  const Scene scene = make_scene(parameters);
  return values_of(simulate(scene, parameters).result, scene.units);
}

bool is_cost(const std::string& name) {
  return std::regex_search(name, std::regex("^(work|seconds|peak_memory_mib)"));
}

TEST(Stability, PowersOfTwoChangeNoDigit) {
  const auto one = solve_scaled(1);
  for (const int power : {-490, -7, 1, 2, 490}) {
    const double scale = std::ldexp(1., power);
    SCOPED_TRACE(power);
    const auto other = solve_scaled(scale);
    for (const auto& [name, value] : one) {
      if (is_cost(name))
        continue;
      EXPECT_EQ(other.at(name), value * Units{scale}.of(result_quantity(name).quantity)) << name;
    }
  }
}

TEST(Stability, AnyUnitOfLengthGivesTheSameScene) {
  const auto one = solve_scaled(1);
  for (const double scale : {1e-150, 1e-10, 1e10, 1e150}) {
    SCOPED_TRACE(scale);
    const auto other = solve_scaled(scale);
    EXPECT_NEAR(other.at("contact.force") / scale / one.at("contact.force"), 1, 1e-12);
    EXPECT_NEAR(other.at("energy.value") / scale / scale / one.at("energy.value"), 1, 1e-12);
  }
}

TEST(Stability, BiactiveContactIsSolved) {
  // u = phi without pressure on stretches of 0.2 next to the contact.
  const GegenbauerPressure pressure(4.7, 0.4, 1, {0.3, 0.05});
  for (const double omega : {0.5, 1.}) {
    const double end_exponent = 0.5;
    const ManufacturedScene made =
        manufacture_scene(0.5, 1, omega, pressure, end_exponent, 0, 0.2, 3000);
    double previous = 1;
    for (const int cells : {60, 120, 240}) {
      const Parameters parameters =
          parameters_of({"Mesh/Radial cells=" + std::to_string(cells / 10),
                         "Mesh/Angular cells=" + std::to_string(cells)});
      const Solution solution = simulate(made.scene, parameters);
      SCOPED_TRACE(testing::Message() << "omega " << omega << ", " << cells << " cells");
      EXPECT_LE(solution.result.residuals.largest(), wanted_residual);
      EXPECT_LE(solution.result.history.size(), 25u);
      // phi grows like d^(3/2) at the ends of the pressure, within cells: the rules of the
      // certificate resolve that so far.
      const double slack = 2e-4 * made.exact.energy;
      EXPECT_LE(solution.result.certified->lower_bound, made.exact.energy + slack);
      EXPECT_GE(solution.result.certified->upper_bound, made.exact.energy - slack);
      const double error = measure_true_errors(solution, made.exact).relative_energy_norm;
      EXPECT_LT(error, 0.6 * previous);
      previous = error;
    }
  }
}

/// Force and bounds of the energy against the exact answer.
void expect_exact_answer(const Parameters& parameters) {
  const Scene scene = make_scene(parameters);
  const Result result = simulate(scene, parameters).result;
  const auto exact = find_exact_solution(scene);
  ASSERT_TRUE(exact);
  EXPECT_EQ(shortfall_text(result.notes), "") << shortfall_text(result.notes);
  EXPECT_NEAR(result.contact.loads.total / exact->loads.total, 1, 1e-3);
  EXPECT_LE(result.certified->lower_bound, exact->energy * (1 + 1e-9));
  EXPECT_GE(result.certified->upper_bound, exact->energy * (1 - 1e-9));
}

TEST(Stability, HairlineContactHasItsExactAnswer) {
  for (const double depth : {1e-4, 1e-14})
    for (const double speed : {0.5, 1.}) {
      SCOPED_TRACE(testing::Message() << depth << " deep at the speed " << speed);
      const Parameters parameters = parameters_of(
          {assignment("Road/Distance", 1 - depth), assignment("Cylinder/Angular velocity", speed),
           "Mesh/Radial cells=4", "Mesh/Angular cells=200", "Mesh/Wanted relative error=0.03"});
      expect_exact_answer(parameters);
    }
}

TEST(Stability, RingsOfAnyThicknessHaveTheirExactAnswer) {
  for (const double inner : {1e-6, 1e-3, 0.99, 0.9999}) {
    SCOPED_TRACE(inner);
    const double distance = inner > 0.5 ? (1 + inner) / 2 : 0.8;
    const Parameters parameters = parameters_of(
        {assignment("Cylinder/Inner radius", inner), assignment("Road/Distance", distance),
         inner > 0.5 ? "Mesh/Radial cells=2" : "Mesh/Radial cells=12", "Mesh/Angular cells=120",
         inner > 0.5 ? "Mesh/Wanted relative error=0.01" : "Mesh/Wanted relative error=0.03",
         "Mesh/Most unknowns=100000"});
    expect_exact_answer(parameters);
  }
}

// Until the mesh resolves the contact of such a drum, each ring of cells around it has as large a
// part of the error as the next one. All of them need one cut, the innermost one further ones.
TEST(Stability, ContactInAPointTakesFewUnknowns) {
  const Parameters parameters = parameters_of(
      {"Road/Curvature=1e6", "Road/Distance=0.9", "Mesh/Radial cells=2", "Mesh/Angular cells=24",
       "Mesh/Wanted relative error=0.05", "Mesh/Most unknowns=100000"});
  const Result result = simulate(make_scene(parameters), parameters).result;
  EXPECT_EQ(shortfall_text(result.notes), "") << shortfall_text(result.notes);
  EXPECT_LT(result.mesh.n_unknowns, 20000u);
}

TEST(Stability, ShortZonesReachTheirTarget) {
  for (const char* end : {"4.7001", "4.702", "4.72", "4.77"})
    for (const int radial_cells : {2, 20}) {
      SCOPED_TRACE(testing::Message() << end << ", cells " << radial_cells);
      const Parameters parameters = parameters_of(
          {std::string("Road/Contact zone=4.7, ") + end,
           assignment("Mesh/Radial cells", radial_cells),
           assignment("Mesh/Angular cells", 12 * radial_cells), "Mesh/Wanted relative error=0.01"});
      const Result result = simulate(make_scene(parameters), parameters).result;
      EXPECT_EQ(shortfall_text(result.notes), "");
      EXPECT_LT(result.cycles.size(), 20u);
      EXPECT_LT(result.mesh.n_unknowns, 30000u);
    }
}

// A cell is cut at most once in a cycle, also if nearly all cells are marked.
TEST(Stability, NoCycleMoreThanQuadruplesTheCells) {
  for (const char* marking : {"Mesh/Marking=bulk", "Mesh/Marking=all"})
    for (const char* fraction : {"Mesh/Marked fraction=0.6", "Mesh/Marked fraction=1"}) {
      const Parameters parameters = parameters_of(
          {marking, fraction, "Cylinder/Inner radius=0.99", "Road/Distance=0.995", "Mesh/Degree=1",
           "Mesh/Radial cells=4", "Mesh/Angular cells=96", "Mesh/Adaptive cycles=3"});
      const auto& cycles = simulate(make_scene(parameters), parameters).result.cycles;
      ASSERT_EQ(cycles.size(), 4u);
      for (unsigned int cycle = 1; cycle < cycles.size(); ++cycle)
        EXPECT_LE(cycles[cycle].n_cells, 4 * cycles[cycle - 1].n_cells)
            << marking << ' ' << fraction;
    }
}

} // namespace
