// Scenes made to have a given pressure are solved with that pressure: contact anywhere, uneven, at
// any speed, with free or singular ends; and a smooth solution without contact.
#include "manufactured_scene.h"
#include "rollwave/scene/road.h"
#include "rollwave/verify/true_errors.h"
#include "test_scenes.h"

#include <boost/math/quadrature/gauss.hpp>
#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace rollwave;
using dealii::numbers::PI;

namespace {

struct Errors {
  TrueErrors true_errors;
  Result result;
};

Errors solve(const ManufacturedScene& made, int degree, int refinements) {
  const Parameters parameters = parameters_of(
      {"Mesh/Degree=" + std::to_string(degree), "Mesh/Radial cells=4", "Mesh/Angular cells=48",
       "Mesh/Global refinements=" + std::to_string(refinements)});
  Solution solution = simulate(made.scene, parameters);
  return {measure_true_errors(solution, made.exact), solution.result};
}

TEST(ManufacturedScene, UnevenContactIsFoundAtEverySpeed) {
  for (const double omega : {0., 0.4, 0.5}) {
    const double s = omega == 0.5 ? 1. / 3 : 1. / 2;
    // b = 2; the coefficients of odd index tilt the pressure.
    const GegenbauerPressure pressure(4.9, 0.61, 1.5 - s, {0.3, 0.1, 0.02, -0.01});
    const ManufacturedScene made =
        manufacture_scene(0.8, 2, omega, pressure, 1 - s, 0.3, 0.4, 8000);
    for (const int degree : {1, 2}) {
      const Errors coarse = solve(made, degree, 1), fine = solve(made, degree, 3);
      EXPECT_LT(fine.true_errors.relative_energy_norm, degree == 1 ? 1e-2 : 2e-3);
      EXPECT_NEAR(std::log2(coarse.true_errors.energy_norm / fine.true_errors.energy_norm) / 2,
                  degree == 1 ? 1 : 1.5, degree == 1 ? 0.1 : 0.3);
      EXPECT_NEAR(fine.result.contact.loads.total / made.exact.loads.total, 1, 2e-3);
      EXPECT_NEAR(fine.result.contact.ends->first, 4.9 - 0.61, 0.01);
      EXPECT_NEAR(fine.result.contact.ends->second, 4.9 + 0.61, 0.01);
    }
  }
}

TEST(ManufacturedScene, SingularPressureConvergesLikeTheSquareRoot) {
  // The ends of the zone are nodes of every mesh.
  const double w = 2 * PI / 12;
  const GegenbauerPressure pressure(3 * PI / 2, w, 0, {1, 0.2});
  const ManufacturedScene made = manufacture_scene(0.5, 1, 0.6, pressure, -0.5, 0, 0, 20000);
  for (const int degree : {1, 2}) {
    const Errors coarse = solve(made, degree, 0), fine = solve(made, degree, 2);
    EXPECT_NEAR(std::log2(coarse.true_errors.energy_norm / fine.true_errors.energy_norm) / 2, 0.5,
                0.1);
  }
}

TEST(ManufacturedScene, OfTheFlatRoadIsTheFlatRoad) {
  for (const double omega : {0.5, 1.}) {
    const ExactSolution exact = solve_exactly({0.5, 1, omega, {1, 0.8}, 0});
    const ManufacturedScene made =
        manufacture_scene(0.5, 1, omega, exact.pressure, exact.end_exponent, 0, 0.2, 20000);
    EXPECT_NEAR(made.exact.norm_squared / exact.norm_squared, 1, 1e-9);
    EXPECT_NEAR(made.exact.loads.total / exact.loads.total, 1, 1e-9);
    const auto flat = [](double angle) {
      return Road{1, 0.8}.displacement(from_lowest_point(angle));
    };
    for (double x = -0.45; x < 0.46; x += 0.05)
      EXPECT_NEAR(made.scene.phi(3 * PI / 2 + x), flat(3 * PI / 2 + x), 1e-6);
  }
}

TEST(SmoothSolution, ConvergesWithTheOrderOfTheDegree) {
  // u = (r - a)(2 b - a - r) (1 + cos(z)/2) has u_r(b) = 0; f follows from the equation.
  const double a = 0.5, b = 1, omega = 0.7;
  const auto radial = [&](double r) { return (r - a) * (2 * b - a - r); };
  Scene scene = make_scene(parameters_of({"Cylinder/Angular velocity=0.7", "Road/Distance=1.9"}));
  scene.force.density = [&](double r, double z) {
    const double slope = 2 * (b - r), curvature = -2;
    return scene.alpha(r) * radial(r) * std::cos(z) / 2 -
           (curvature + slope / r) * (1 + std::cos(z) / 2);
  };
  // J = -a(u, u)/2, with the integrals over z done: pi for sin^2 and 2 pi (1 + 1/8) for (..)^2.
  const double norm_squared = boost::math::quadrature::gauss<double, 20>::integrate(
      [&](double r) {
        return r * ((1 / (r * r) - omega * omega) * radial(r) * radial(r) * PI / 4 +
                    4 * (b - r) * (b - r) * 2 * PI * 1.125);
      },
      a, b);
  for (const int degree : {1, 2, 3}) {
    std::vector<double> errors;
    for (const int refinements : {0, 1}) {
      const Parameters parameters = parameters_of(
          {"Mesh/Degree=" + std::to_string(degree), "Mesh/Radial cells=4", "Mesh/Angular cells=16",
           "Mesh/Global refinements=" + std::to_string(refinements)});
      const Result result = simulate(scene, parameters).result;
      EXPECT_EQ(result.contact.active_nodes, 0u);
      // a(u - u_h, u - u_h) = 2 (J(u_h) - J(u)) without contact
      errors.push_back(std::sqrt(2 * result.energy.value + norm_squared));
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), degree, 0.1) << "degree " << degree;
  }
}

} // namespace
