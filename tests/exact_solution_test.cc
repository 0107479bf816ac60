// The semi-analytic answer: known digits, asymptotic laws, and the optimality conditions point by
// point.
#include "rollwave/exact/bessel_modes.h"
#include "rollwave/exact/exact_field.h"
#include "rollwave/exact/exact_solution.h"
#include "rollwave/scene/road.h"

#include "test_scenes.h"

#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/bessel_prime.hpp>
#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace rollwave;
using dealii::numbers::PI;

namespace {

TEST(BesselModes, AreThoseOfBesselFunctions) {
  using boost::math::cyl_bessel_j;
  using boost::math::cyl_neumann;
  for (const double omega : {0.3, 0.8, 1.}) {
    const double a = 0.4;
    const BesselModes modes(a, 1, omega);
    for (const double k : {1., 2., 7., 20.}) {
      const double y_hub = cyl_neumann(k, k * omega * a), j_hub = cyl_bessel_j(k, k * omega * a);
      const auto mode = [&](double r) {
        return cyl_bessel_j(k, k * omega * r) * y_hub - j_hub * cyl_neumann(k, k * omega * r);
      };
      const double slope = k * omega *
                           (boost::math::cyl_bessel_j_prime(k, k * omega) * y_hub -
                            j_hub * boost::math::cyl_neumann_prime(k, k * omega));
      EXPECT_NEAR(modes.compliance(k) * slope / mode(1), 1, 1e-12);
      const std::vector<double> radii = {0.45, 0.7, 0.99};
      const auto profile = modes.profile(k, radii);
      for (unsigned int i = 0; i < radii.size(); ++i)
        EXPECT_NEAR(profile[i], mode(radii[i]) / mode(1), 1e-11);
    }
  }
}

// A hub that is small changes R_1 from J_1(omega r) by a share of (a/r)^2 only.
TEST(BesselModes, AreResolvedAboveSmallestHubs) {
  for (const double a : {1e-8, 1e-20, 1e-50, 1e-100, 1e-150})
    for (const double omega : {0., 0.5, 1.}) {
      const BesselMode mode(a, 1, omega, 1);
      const auto j = [&](double r) { return omega == 0 ? r : std::cyl_bessel_j(1, omega * r); };
      const auto slope = [&](double r) { // J_1'
        return omega == 0 ? 1
                          : omega * (std::cyl_bessel_j(0, omega * r) -
                                     std::cyl_bessel_j(1, omega * r) / (omega * r));
      };
      for (const double r : {1e-7, 1e-4, 5e-5, 1e-2, 0.3, 0.9, 1.}) {
        const double hub = std::pow(a / r, 2), accuracy = 1e-8 * hub + (r < 1e-4 ? 1e-8 : 1e-12);
        EXPECT_NEAR(mode.at(r).value / (j(r) * (1 - hub)) * j(1), 1, accuracy) << a << ' ' << r;
        EXPECT_NEAR(mode.at(r).slope * j(1) / slope(r), 1 + hub, accuracy + hub * r);
      }
      EXPECT_NEAR(mode.compliance(), j(1) / slope(1), 1e-13);
    }
}

TEST(BesselModes, HaveTheirLimits) {
  // Without rotation sigma_k = (k / b) coth(k ln(b / a)).
  for (const double a : {0.01, 0.5, 0.99, 0.9999}) {
    const BesselModes modes(a, 1, 0);
    EXPECT_NEAR(modes.compliance(0), std::log(1 / a), 1e-15);
    for (const double k : {1., 10., 100., 777.7, 30000.})
      EXPECT_NEAR(modes.compliance(k) * k / std::tanh(k * std::log(1 / a)), 1, 1e-11) << a << k;
  }
  // sigma_k / k tends to sqrt(1/b^2 - omega^2), and at omega = 1/b sigma_k to 0.918497 k^(2/3) / b.
  EXPECT_NEAR(1 / (2e5 * BesselModes(1, 2, 0.3).compliance(2e5)), std::sqrt(0.25 - 0.09), 1e-5);
  EXPECT_NEAR(2 / (BesselModes(1, 2, 0.5).compliance(1e6) * std::pow(1e6, 2. / 3)), 0.918497, 1e-4);
}

TEST(GegenbauerPressure, HasItsTransform) {
  for (const double nu : {0., 1. / 6, 1., 7. / 6}) {
    const GegenbauerPressure series(1, 0.7, nu, {0.3, 0.1, -0.2, 0.05, 0.02});
    for (const double k : {0., 3., 40.}) {
      // z = m + w sin(s) resolves the ends.
      double cosine = 0, sine = 0;
      const int n = 40000;
      for (int i = 0; i < n; ++i) {
        const double s = PI * ((i + 0.5) / n - 0.5), z = 1 + 0.7 * std::sin(s);
        const double mass = series(z) * 0.7 * std::cos(s) * PI / n;
        cosine += mass * std::cos(k * (z - 1));
        sine += mass * std::sin(k * (z - 1));
      }
      EXPECT_NEAR(series.fourier_integral(k).real(), cosine, 3e-5);
      EXPECT_NEAR(series.fourier_integral(k).imag(), sine, 3e-5);
    }
  }
}

TEST(ExactSolution, HasTheKnownDigitsOfThePapersScenes) {
  for (const PaperScene& paper : paper_scenes()) {
    const ExactSolution solution =
        solve_exactly({0.5, 1, paper.angular_velocity, {1, paper.distance}, paper.force_density});
    EXPECT_NEAR(solution.half_width, paper.half_width, 6e-7) << paper.figure;
    EXPECT_NEAR(solution.loads.total / paper.force, 1, 1e-10) << paper.figure;
    EXPECT_NEAR(solution.energy, paper.energy, 6e-12) << paper.figure;
    EXPECT_NEAR(solution.peak_pressure, paper.peak_pressure, 6e-7) << paper.figure;
    EXPECT_LT(solution.force_accuracy, 2e-10) << paper.figure;
    EXPECT_TRUE(solution.ends_resolved);
  }
}

TEST(ExactSolution, ScalesWithItsLengths) {
  const ExactSolution one = solve_exactly({0.3, 1, 0.8, {1, 0.75}, -0.4});
  const ExactSolution two = solve_exactly({0.6, 2, 0.4, {2, 1.5}, -0.2});
  EXPECT_NEAR(two.half_width / one.half_width, 1, 1e-9);
  EXPECT_NEAR(two.loads.total / one.loads.total, 2, 1e-9);
  EXPECT_NEAR(two.energy / one.energy, 4, 1e-9);
}

TEST(ExactSolution, WithoutContactIsTheContactFreeSolution) {
  const ExactSolution solution = solve_exactly({0.5, 1, 0.5, {1, 0.98}, -1});
  EXPECT_EQ(solution.half_width, 0);
  EXPECT_EQ(solution.loads.total, 0);
  const Parameters parameters = parameters_of({"Road/Distance=0.98", "Cylinder/Radial force=-1",
                                               "Mesh/Angular cells=12", "Mesh/Radial cells=64"});
  const Result result = simulate(make_scene(parameters), parameters).result;
  EXPECT_NEAR(result.energy.value, solution.energy, 1e-7 * std::abs(solution.energy));
}

TEST(ExactSolution, IsOptimalPointByPoint) {
  for (const double omega : {0.5, 1.}) {
    const ExactScene scene{0.5, 1, omega, {1, 0.8}, 0.2};
    const ExactSolution solution = solve_exactly(scene);
    const double w = solution.half_width;
    const std::vector<double> on_surface = cosine_coefficients(solution, 20000, {1})[0];
    const auto road = [](double angle) {
      return Road{1, 0.8}.displacement(from_lowest_point(angle));
    };
    for (int i = 0; i <= 40; ++i) {
      const double z = 3 * PI / 2 + 2 * w * i / 40.;
      const double u = cosine_sum(on_surface, z).value;
      if (z < 3 * PI / 2 + 0.98 * w) {
        EXPECT_NEAR(u, road(z), 1e-6);
        EXPECT_GT(solution.pressure(z), 0);
      } else {
        EXPECT_LT(u, road(z) + 1e-6);
      }
    }
    // The field equation and the hub, by differences.
    const double r = 0.7, z = 4.9, h = 1e-3;
    const auto coefficients = cosine_coefficients(solution, 20000, {0.5, r - h, r, r + h});
    const auto u = [&](unsigned int radius, double angle) {
      return cosine_sum(coefficients[radius], angle).value;
    };
    const double u_r = (u(3, z) - u(1, z)) / (2 * h),
                 u_rr = (u(3, z) - 2 * u(2, z) + u(1, z)) / (h * h),
                 u_zz = (u(2, z + h) - 2 * u(2, z) + u(2, z - h)) / (h * h);
    EXPECT_NEAR(-(1 / (r * r) - omega * omega) * u_zz - u_rr - u_r / r, 0.2, 1e-5);
    EXPECT_NEAR(u(0, z), 0, 1e-9);
  }
}

} // namespace
