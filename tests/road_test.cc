// Roads of constant curvature: the shape, and scenes on them against the exact answer.
#include "rollwave/base/errors.h"
#include "rollwave/run/simulation.h"
#include "rollwave/verify/reference_solution.h"

#include "test_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace rollwave;

namespace {

/// The distance of the point at the angle x on a road from the drum's surface, or from the line.
double defect(const Road& road, double x) {
  const double rho = road.outer_radius + road.displacement(x), c = road.distance;
  if (road.curvature == 0)
    return rho * std::cos(x) - c;
  const double radius = 1 / road.curvature;
  return std::hypot(rho * std::sin(x), rho * std::cos(x) - (c + radius)) - std::abs(radius);
}

TEST(Road, LiesOnItsLineOrCircle) {
  for (const double curvature : {0., 1., 20., -0.4, -0.9})
    for (const double x : {0., 0.01, -0.02, 0.03})
      EXPECT_NEAR(defect({2, 1.05, curvature}, x), 0, 1e-15 / (1e-3 + std::abs(curvature)) + 1e-15)
          << curvature << ' ' << x;
}

TEST(Road, NothingCancelsWhereItIsHardlyTouched) {
  // phi at the angle x is -1e-14 + m c x^2/2.
  const double c = 1 - 1e-14, x = 1e-6;
  for (const double curvature : {0., 1., -0.5}) {
    const double m = 1 + curvature * c;
    const Road road{1, c, curvature};
    EXPECT_NEAR(road.displacement(0) / (c - 1), 1, 1e-14);
    const double rise = curvature == 0 ? x * x / 2 : m * x * x / 2;
    EXPECT_NEAR(road.displacement(x) / (c - 1 + rise), 1, 1e-11);
    EXPECT_NEAR(road.slope(x) / (m * x), 1, 1e-11);
  }
}

TEST(Road, DerivativesAreThoseOfItsShape) {
  const double h = 1e-5;
  for (const double curvature : {0., 1., -0.5, 1e-9}) {
    const auto at = [&](double c) { return Road{1, c, curvature}; };
    const Road road = at(0.8);
    for (const double x : {0.1, -0.3, 0.5}) {
      EXPECT_NEAR(road.slope(x), (road.displacement(x + h) - road.displacement(x - h)) / (2 * h),
                  1e-8);
      EXPECT_NEAR(road.distance_derivative(x),
                  (at(0.8 + h).displacement(x) - at(0.8 - h).displacement(x)) / (2 * h), 1e-8);
      EXPECT_NEAR(road.second_distance_derivative(x),
                  (at(0.8 + h).distance_derivative(x) - at(0.8 - h).distance_derivative(x)) /
                      (2 * h),
                  1e-8);
    }
  }
}

TEST(Road, HasNoJumpAtZeroCurvature) {
  for (const double x : {0., 0.2, 0.6, 1.2})
    for (const double sign : {1., -1.})
      EXPECT_NEAR((Road{1, 0.8, sign * 1e-12}.displacement(x)), (Road{1, 0.8}.displacement(x)),
                  2e-11);
}

TEST(Road, MeetsTheSurfaceAtItsCrossingAngle) {
  for (const double curvature : {0., 1., -0.5}) {
    const Road road{1, 0.8, curvature};
    EXPECT_NEAR(road.displacement(road.crossing_angle(0.1)), 0.1, 1e-14);
    EXPECT_EQ(road.crossing_angle(-0.3), 0);
  }
  // A thin drum ends at its tangent.
  EXPECT_NEAR((Road{1, 0.8, 100}.crossing_angle(0)), std::asin(1 / 81.), 1e-14);
}

TEST(Road, InsideOfADrumMustBeLargerThanTheCylinder) {
  EXPECT_THROW(make_scene(parameters_of({"Road/Curvature=-1"})), BadValue);
  EXPECT_NO_THROW(make_scene(parameters_of({"Road/Curvature=-0.99"})));
}

/// The scene of figure 4 on a road of this curvature, Q2.
Solution solve_on(double curvature, const std::string& more, unsigned int angular_cells) {
  const Parameters parameters =
      parameters_of({"Road/Curvature=" + std::to_string(curvature), more,
                     "Mesh/Radial cells=" + std::to_string(angular_cells / 20),
                     "Mesh/Angular cells=" + std::to_string(angular_cells)});
  return simulate(make_scene(parameters), parameters);
}

TEST(Road, DrumsConvergeToTheExactAnswer) {
  for (const double curvature : {1., -0.5}) {
    double errors[2];
    for (const unsigned int level : {0u, 1u}) {
      const Solution solution = solve_on(curvature, "Road/Distance=0.8", level == 0 ? 60 : 240);
      const auto exact = find_exact_solution(solution.scene);
      ASSERT_TRUE(exact);
      const Result& result = solution.result;
      EXPECT_NEAR(result.patch.force / exact->force, 1, 2e-3);
      EXPECT_NEAR(result.patch.work_conjugate_load / exact->work_conjugate_load, 1, 2e-3);
      EXPECT_LE(result.certified->lower_bound, exact->energy);
      EXPECT_GE(result.certified->upper_bound, exact->energy);
      errors[level] = result.certified->energy_norm;
    }
    EXPECT_GT(std::log2(errors[0] / errors[1]) / 2, 1.2); // Q2 has 3/2 in the end
  }
}

TEST(Road, EnergyFallsWithTheDistanceByTheWorkConjugateLoad) {
  const double h = 3e-4;
  for (const double curvature : {1., -0.5}) {
    const auto at = [&](double c) {
      return *find_exact_solution(make_scene(parameters_of(
          {"Road/Curvature=" + std::to_string(curvature), "Road/Distance=" + std::to_string(c)})));
    };
    EXPECT_NEAR((at(0.8 - h).energy - at(0.8 + h).energy) / (2 * h), at(0.8).work_conjugate_load,
                1e-6);
  }
}

TEST(Road, StiffnessIsTheSlopeOfTheLoads) {
  const double h = 1e-3;
  for (const double curvature : {0., 1.}) {
    const Solution solution = solve_on(curvature, "Mesh/Wanted relative error=1e-3", 60);
    const auto at = [&](double c) {
      return *find_exact_solution(with_distance(solution.scene, c));
    };
    const ExactSolution near = at(0.8 - h), far = at(0.8 + h);
    const Loads& stiffness = solution.result.patch.stiffness;
    EXPECT_NEAR(stiffness.total / ((near.force - far.force) / (2 * h)), 1, 1e-3);
    EXPECT_NEAR(stiffness.vertical / ((near.vertical_load - far.vertical_load) / (2 * h)), 1, 1e-3);
    EXPECT_NEAR(stiffness.work_conjugate /
                    ((near.work_conjugate_load - far.work_conjugate_load) / (2 * h)),
                1, 1e-3);
  }
}

} // namespace
