// Roads of constant curvature: the shape, and scenes on them against the exact answer.
#include "rollwave/base/errors.h"
#include "rollwave/run/simulation.h"
#include "rollwave/verify/reference_solution.h"

#include "test_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

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

TEST(Road, KeepsItsDigitsInHairlineContact) {
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
                  1e-7);
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

// At the limit the drum spans an angle at the axle that is a thousand times the accuracy of angles,
// in any unit.
TEST(Road, RefusesDrumsBelowTheResolutionOfAngles) {
  for (const double b : {1., 0.035, 700.})
    for (const double curvature : {0.99e10, 1.01e10, 1e16}) {
      const auto make = [&] {
        return make_scene(parameters_of(
            {assignment("Cylinder/Inner radius", b / 2), assignment("Cylinder/Outer radius", b),
             "Cylinder/Angular velocity=0", assignment("Road/Distance", 0.8 * b),
             assignment("Road/Curvature", curvature / b)}));
      };
      if (curvature < 1e10) {
        const Scene scene = make();
        const double tangent = std::asin(1 / (1 + 0.8 * curvature));
        EXPECT_NEAR((scene.zone_end - scene.zone_begin) / (2 * tangent), 1, 1e-4);
        continue;
      }
      try {
        make();
        ADD_FAILURE() << curvature << " was not refused";
      } catch (const BadValue& value) {
        EXPECT_EQ(value.section + '/' + value.key, "Road/Curvature");
      }
    }
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
      const Solution solution = solve_on(curvature, "Road/Distance=0.8", level == 0 ? 60 : 480);
      const auto exact = find_exact_solution(solution.scene);
      ASSERT_TRUE(exact);
      const Result& result = solution.result;
      EXPECT_NEAR(result.contact.loads.total / exact->loads.total, 1, 2e-3);
      EXPECT_NEAR(*result.contact.loads.work_conjugate / *exact->loads.work_conjugate, 1, 2e-3);
      EXPECT_LE(result.certified->lower_bound, exact->energy);
      EXPECT_GE(result.certified->upper_bound, exact->energy);
      errors[level] = result.certified->energy_norm;
    }
    EXPECT_GT(std::log2(errors[0] / errors[1]) / 3, 1.2); // Q2 has 3/2 in the end
  }
}

// The inside of a drum of the radius R, whose axis is e above that of the cylinder:
// phi(x) = -e cos x + (R^2 - e^2 sin^2 x)^(1/2) - b, without further odd modes. Where the cylinder
// fills it, u = phi all around, and with w = phi - u_f and the symbol sigma_k of each mode
// F = -2 pi b sigma_0 w_0, V = pi b sigma_1 e, J = J(u_f) + a(w, w)/2.
constexpr double sigma_1 = 1.6264193094; // a = 0.5, b = 1, omega = 0.5

TEST(Road, CylinderThatFillsADrumTouchesItAllAround) {
  struct Filled {
    double distance, force, energy;
  };
  for (const auto& [distance, force, energy] :
       {Filled{1.1, 1.8769758607, -0.3630600497}, Filled{1.05, 1.8843452669, -0.3523031880}}) {
    const Parameters parameters = parameters_of({"Cylinder/Radial force=2", "Road/Curvature=-0.9",
                                                 assignment("Road/Distance", distance),
                                                 "Mesh/Radial cells=20", "Mesh/Angular cells=240"});
    const Result result = simulate(make_scene(parameters), parameters).result;
    EXPECT_EQ(result.contact.active_nodes, 480u);
    EXPECT_NEAR(result.contact.half_width(), dealii::numbers::PI, 1e-12);
    EXPECT_NEAR(result.contact.loads.total, force, 1e-6);
    EXPECT_NEAR(result.contact.loads.vertical, dealii::numbers::PI * sigma_1 * (1 / 0.9 - distance),
                1e-6);
    EXPECT_NEAR(result.energy.value, energy, 1e-6);
    constexpr double rounding = 5e-11; // of the ten digits above
    EXPECT_LE(result.certified->lower_bound, energy + rounding);
    EXPECT_GE(result.certified->upper_bound, energy - rounding);
    EXPECT_LE(result.certified->relative, 1e-2);
    // Displacements stretch the linear model.
    EXPECT_LE(texts_of(result.notes, Note::Kind::remark).size(), 1u);
  }
}

// Near the least distance the surface is free at the top, at the wanted one it is not.
TEST(Road, LoadInsideOfADrumIsFoundWhereTheCylinderFillsIt) {
  const Parameters parameters =
      parameters_of({"Cylinder/Radial force=2", "Road/Curvature=-0.9", "Road/Load=0.1",
                     "Mesh/Radial cells=10", "Mesh/Angular cells=120"});
  const Result result = simulate(make_scene(parameters), parameters).result;
  EXPECT_NEAR(result.road_distance, 1 / 0.9 - 0.1 / (dealii::numbers::PI * sigma_1), 1e-6);
}

TEST(Road, EnergyFallsWithTheDistanceByTheWorkConjugateLoad) {
  const double h = 3e-4;
  const std::vector<std::vector<std::string>> scenes = {
      {"Road/Curvature=1"},
      {"Road/Curvature=-0.5"},
      {"Cylinder/Inner radius=0.2", "Cylinder/Angular velocity=0", "Cylinder/Radial force=0.1"},
      {"Cylinder/Inner radius=0.2", "Cylinder/Angular velocity=1", "Cylinder/Radial force=0.1"}};
  for (const std::vector<std::string>& scene : scenes) {
    const auto at = [&](double c) {
      return *find_exact_solution(
          make_scene(with(parameters_of(scene), {"Road/Distance=" + std::to_string(c)})));
    };
    const double slope = (at(0.8 - h).energy - at(0.8 + h).energy) / (2 * h);
    const ExactSolution middle = at(0.8);
    EXPECT_NEAR(slope, *middle.loads.work_conjugate, 1e-6);
    if (scene.size() > 1) { // on a flat road F < G < F / cos(w)
      EXPECT_GT(slope, middle.loads.total);
      EXPECT_LT(slope, middle.loads.total / std::cos(middle.half_width));
    }
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
    const Loads stiffness = *solution.result.contact.stiffness;
    EXPECT_NEAR(stiffness.total / ((near.loads.total - far.loads.total) / (2 * h)), 1, 1e-3);
    EXPECT_NEAR(stiffness.vertical / ((near.loads.vertical - far.loads.vertical) / (2 * h)), 1,
                1e-3);
    EXPECT_NEAR(*stiffness.work_conjugate /
                    ((*near.loads.work_conjugate - *far.loads.work_conjugate) / (2 * h)),
                1, 1e-3);
  }
}

// Around the whole drum, and where the zone cuts the contact at both ends. The work-conjugate load
// of the same mesh at other distances gives the slope.
TEST(Road, StiffnessHasTheCurvatureOfTheRoadWhereNoEndCanMove) {
  for (const auto& [settings, distance, right] :
       {std::tuple(std::vector<std::string>{"Cylinder/Radial force=2", "Mesh/Angular cells=48"}, 1.,
                   6.0234),
        {{"Road/Contact zone=4.31, 5.11", "Mesh/Angular cells=96"}, 0.8, 1.9155}}) {
    const auto at = [&, &settings = settings](double c) {
      const Parameters parameters =
          with(parameters_of(
                   {"Road/Curvature=-0.9", "Mesh/Radial cells=4", assignment("Road/Distance", c)}),
               settings);
      return simulate(make_scene(parameters), parameters).result.contact;
    };
    constexpr double h = 1e-4;
    const ContactResultants near = at(distance - h), middle = at(distance), far = at(distance + h);
    const double slope = (*near.loads.work_conjugate - *far.loads.work_conjugate) / (2 * h);
    EXPECT_NEAR(*middle.stiffness->work_conjugate / slope, 1, 1e-6);
    EXPECT_NEAR(*middle.stiffness->work_conjugate, right, 1e-4 * right);
  }
}

// The values are differences of exact answers. The distances of the quotient lie inside of the hub
// as well.
TEST(Road, StiffnessIsSmoothUpToTheHub) {
  const Parameters parameters = parameters_of(
      {"Road/Curvature=1", "Road/Distance=0.501", "Mesh/Radial cells=8", "Mesh/Angular cells=108"});
  const Loads stiffness = *simulate(make_scene(parameters), parameters).result.contact.stiffness;
  EXPECT_NEAR(stiffness.total / 3.43805, 1, 4e-3);
  EXPECT_NEAR(stiffness.vertical / 3.01574, 1, 2e-3);
  EXPECT_NEAR(*stiffness.work_conjugate / 4.75153, 1, 1e-2);
}

} // namespace
