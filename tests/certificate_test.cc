// The certificate is a bound: never below the true error, whatever the scene, the mesh and the
// force, and not far above it.
#include "rollwave/error_bound/error_bound.h"

#include "draw.h"
#include "manufactured_scene.h"
#include "rollwave/base/work.h"
#include "rollwave/error_bound/admissible_pressure.h"
#include "rollwave/error_bound/radial_shapes.h"
#include "rollwave/run/simulation.h"
#include "rollwave/run/solve_on_mesh.h"
#include "rollwave/scene/uniform_force.h"
#include "rollwave/verify/reference_solution.h"
#include "rollwave/verify/true_errors.h"
#include "test_scenes.h"

#include <boost/math/quadrature/gauss.hpp>
#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace rollwave;
using dealii::numbers::PI;

namespace {

TEST(Certificate, HoldsForRandomScenes) {
  Draw draw(20240607);
  int n_checked = 0;
  double worst = 0, worst_on_fine_adaptive = 0;
  while (n_checked < n_random_scenes(12)) {
    const double b = draw.one_of<double>({1, 0.3, 7});
    const double a = b * draw.number(0.1, 0.95);
    const double omega = draw.one_of<double>({0, draw.number(0, 0.95), 1}) / b;
    // u_f(b) is 1/2 f b^2 times a function of a/b; lengths of the order of the ring's thickness
    const double f = draw.one_of<double>({0, 0, draw.number(-0.3, 1)}) / b;
    const double c = b - (b - a) * draw.number(0.01, 0.9);
    const int radial = draw.count(1, 4);
    const int angular = std::max(
        3, static_cast<int>(radial * 2 * PI * (a + b) / 2 / (b - a) * draw.number(0.3, 2)));
    const std::vector<std::string> settings = {"Cylinder/Inner radius=" + digits(a),
                                               "Cylinder/Outer radius=" + digits(b),
                                               "Cylinder/Angular velocity=" + digits(omega),
                                               "Cylinder/Radial force=" + digits(f),
                                               "Road/Distance=" + digits(c),
                                               "Mesh/Degree=" + std::to_string(draw.count(1, 2)),
                                               "Mesh/Radial cells=" + std::to_string(radial),
                                               "Mesh/Angular cells=" + std::to_string(angular),
                                               "Mesh/Adaptive cycles=" +
                                                   std::to_string(draw.count(0, 7)),
                                               "Mesh/Most unknowns=40000"};
    SCOPED_TRACE(testing::PrintToString(settings));
    const Parameters parameters = parameters_of(settings);
    const Scene scene = make_scene(parameters);
    const auto exact = find_exact_solution(scene);
    ASSERT_TRUE(exact);
    ++n_checked;

    const Solution solution = simulate(scene, parameters);
    const CertifiedError& certified = *solution.result.certified;
    // The exact energy has its own accuracy.
    const double floor = 10 * exact->energy_accuracy * std::abs(exact->energy) +
                         1e-13 * std::abs(exact->norm_squared);
    EXPECT_LE(certified.lower_bound, exact->energy + floor);
    EXPECT_GE(certified.upper_bound, exact->energy - floor);
    const TrueErrors errors = measure_true_errors(*solution.space, solution.displacement,
                                                  solution.result, solution.certificate, *exact);
    EXPECT_GE(certified.energy_norm * (1 + 1e-6) + 1e-6 * std::sqrt(exact->norm_squared),
              *errors.admissible_energy_norm);
    if (certified.upper_bound - exact->energy > 100 * floor) {
      const bool is_fine_adaptive =
          solution.result.cycles.size() > 1 && solution.result.mesh.dofs > 1000;
      EXPECT_LE(*errors.effectivity, is_fine_adaptive ? 2.5 : 6)
          << solution.result.mesh.dofs << " unknowns";
      worst = std::max(worst, *errors.effectivity);
      if (is_fine_adaptive)
        worst_on_fine_adaptive = std::max(worst_on_fine_adaptive, *errors.effectivity);
    }
  }
  std::cout << n_checked << " scenes, largest effectivity " << worst
            << ", on adaptive meshes with more than "
            << "1000 unknowns " << worst_on_fine_adaptive << std::endl;
}

TEST(Certificate, HoldsForHigherDegrees) {
  for (const int degree : {3, 4, 8})
    for (const int cycles : {0, 4}) {
      const Parameters parameters =
          with(paper_scenes()[0].parameters(),
               {"Mesh/Degree=" + std::to_string(degree), "Mesh/Radial cells=2",
                "Mesh/Angular cells=24", "Mesh/Adaptive cycles=" + std::to_string(cycles)});
      const Scene scene = make_scene(parameters);
      const auto exact = find_exact_solution(scene);
      ASSERT_TRUE(exact);
      const Solution solution = simulate(scene, parameters);
      const CertifiedError& certified = *solution.result.certified;
      EXPECT_LE(certified.lower_bound, exact->energy) << degree;
      EXPECT_GE(certified.upper_bound, exact->energy) << degree;
      const TrueErrors errors = measure_true_errors(*solution.space, solution.displacement,
                                                    solution.result, solution.certificate, *exact);
      EXPECT_GE(certified.energy_norm, *errors.admissible_energy_norm) << degree;
      EXPECT_LE(*errors.effectivity, degree < 8 ? 6 : 12) << degree << " " << cycles;
      // The indicator has found the ends of contact: to halve all cells gains 2^(3/2).
      if (cycles > 0) {
        EXPECT_LT(errors.energy_norm, solution.result.cycles.front().indicated / 4) << degree;
      }
    }
}

// J of the contact-free solution lies between bounds that are round-off apart, in rings where that
// is large beside the difference of the radii: J = -pi int_a^b G^2 / r dr with G = (b^2 - r^2)/2.
TEST(Certificate, HoldsToRoundOffInThinRings) {
  for (const double thickness : {1e-2, 1e-4, 1e-6, 1e-8})
    for (const char* degree : {"1", "2", "4", "8"}) {
      const Parameters parameters =
          parameters_of({assignment("Cylinder/Inner radius", 1 - thickness), "Road/Distance=1.5",
                         "Cylinder/Radial force=-1", "Mesh/Radial cells=4", "Mesh/Angular cells=20",
                         std::string("Mesh/Degree=") + degree});
      const CertifiedError certified =
          simulate(make_scene(parameters), parameters).result.certified.value();
      // By the depth t = b - r, which has all its digits.
      const double d = 1 - parameters.cylinder.inner_radius;
      const dealii::QGauss<1> gauss(10);
      double energy = 0;
      for (unsigned int q = 0; q < gauss.size(); ++q) {
        const double t = d * gauss.point(q)[0], moment = t * (2 - t) / 2;
        energy -= PI * d * gauss.weight(q) * moment * moment / (1 - t);
      }
      SCOPED_TRACE(digits(thickness) + " Q" + degree);
      EXPECT_LE(certified.lower_bound, energy * (1 - 1e-15));
      EXPECT_GE(certified.upper_bound, energy * (1 + 1e-15));
    }
}

// Contact that ends freely, that the zone cuts short on one side, and in a thin ring.
TEST(EdgePressures, CarryTheContactForce) {
  const std::vector<std::vector<std::string>> scenes = {
      {},
      {"Road/Contact zone=4.5, 5.8"},
      {"Cylinder/Inner radius=0.999", "Road/Distance=0.9995", "Cylinder/Angular velocity=1",
       "Mesh/Radial cells=2"}};
  for (const auto& settings : scenes)
    for (unsigned int degree = 1; degree <= 4; ++degree) {
      SCOPED_TRACE(testing::PrintToString(settings) + " degree " + std::to_string(degree));
      const Parameters parameters =
          with(parameters_of(settings), {"Mesh/Degree=" + std::to_string(degree)});
      const Scene scene = make_scene(parameters);
      const Discretisation ring(scene, parameters);
      MeshCache system;
      Work work;
      const MeshSolution solution = solve_on_mesh(scene, parameters, ring.space, {}, system, work);
      double nodal = 0, sum = 0;
      for (unsigned int i = 0; i < solution.problem.weight.size(); ++i)
        nodal += std::max(0., solution.contact.state.force(i));
      const auto pressures = admissible_pressures(ring.space, scene, solution.contact);
      for (unsigned int i = 0; i < pressures.size(); ++i) {
        const SurfaceFace& face = ring.space.surface_faces()[i];
        sum += scene.outer_radius * (face.end - face.begin) * pressures[i].mean;
        EXPECT_GE(pressures[i].mean, 0);
        const double limit = degree == 1 ? 0 : degree == 2 ? 3 : 2;
        EXPECT_LE(std::abs(pressures[i].slope), limit * pressures[i].mean);
      }
      EXPECT_GT(sum, 0);
      EXPECT_NEAR(sum / nodal, 1, 1e-13);
    }
}

// Without contact the flux G / r is the exact one, and D(tau) = min J = -pi f^2 int r u_1 dr.
TEST(Certificate, IsAnEqualityWithoutContact) {
  for (const char* degree : {"1", "2", "3", "8"})
    for (const char* radius : {"0.99", "0.5", "0.0067", "1e-6"}) {
      const Parameters parameters = parameters_of(
          {std::string("Mesh/Degree=") + degree, "Mesh/Radial cells=4", "Mesh/Angular cells=7",
           "Cylinder/Angular velocity=0.9", std::string("Cylinder/Inner radius=") + radius,
           "Road/Distance=1.1", "Cylinder/Radial force=-3"});
      const Result result = simulate(make_scene(parameters), parameters).result;
      const double exact = -9 * PI * contact_free_unit_work(std::stod(radius), 1);
      EXPECT_EQ(result.patch.active_nodes, 0u);
      EXPECT_NEAR(result.certified->lower_bound, exact, 1e-12 * std::abs(exact)) << radius;
      EXPECT_GE(result.certified->upper_bound, exact * (1 + 1e-12)) << radius;
    }
}

// Where all of the height answers to what happens on the surface.
TEST(Certificate, IsSharpInThinRings) {
  for (const double a : {0.9, 0.99, 0.999})
    for (const double omega : {0., 0.9, 1.}) {
      std::optional<ExactSolution> exact;
      for (const int degree : {1, 2})
        for (const double wanted : {0.01}) {
          const std::vector<std::string> settings = {"Cylinder/Inner radius=" + digits(a),
                                                     "Cylinder/Angular velocity=" + digits(omega),
                                                     "Road/Distance=" + digits((1 + a) / 2),
                                                     "Mesh/Degree=" + std::to_string(degree),
                                                     "Mesh/Radial cells=2",
                                                     "Mesh/Angular cells=120",
                                                     "Mesh/Wanted relative error=" + digits(wanted),
                                                     "Mesh/Most unknowns=40000"};
          SCOPED_TRACE(testing::PrintToString(settings));
          const Parameters parameters = parameters_of(settings);
          const Scene scene = make_scene(parameters);
          if (!exact)
            exact = find_exact_solution(scene);
          ASSERT_TRUE(exact);
          const Solution solution = simulate(scene, parameters);
          EXPECT_TRUE(solution.result.shortfalls.empty());
          EXPECT_LE(solution.result.certified->lower_bound, exact->energy * (1 + 1e-9));
          EXPECT_GE(solution.result.certified->upper_bound, exact->energy * (1 - 1e-9));
          const TrueErrors errors =
              measure_true_errors(*solution.space, solution.displacement, solution.result,
                                  solution.certificate, *exact);
          const bool is_fine_adaptive =
              solution.result.cycles.size() > 1 && solution.result.mesh.dofs > 1000;
          EXPECT_LE(*errors.effectivity, is_fine_adaptive ? 2.5 : 6)
              << solution.result.mesh.dofs << " unknowns";
        }
    }
}

// Contact within one cell, which each cycle halves: half the length of what penetrates, and of the
// road's gap a quarter, which makes 2^(-3/2) of the bound.
TEST(Certificate, HoldsInTheThinnestRingsAtTheCriticalSpeed) {
  for (const double thickness : {1e-8, 1e-9})
    for (const int degree : {1, 2, 4}) {
      std::vector<CertifiedError> certified;
      for (int cycles = 0; cycles <= 5; ++cycles) {
        const Parameters parameters =
            with(paper_scenes()[0].parameters(),
                 {"Cylinder/Inner radius=" + digits(1 - thickness), "Cylinder/Angular velocity=1",
                  "Road/Distance=" + digits(1 - 0.3 * thickness),
                  "Mesh/Degree=" + std::to_string(degree), "Mesh/Radial cells=4",
                  "Mesh/Angular cells=40", "Mesh/Adaptive cycles=" + std::to_string(cycles)});
        certified.push_back(*simulate(make_scene(parameters), parameters).result.certified);
      }
      for (unsigned int k = 0; k + 1 < certified.size(); ++k) {
        EXPECT_LE(certified[k].lower_bound, certified.back().upper_bound) << thickness;
        // Round-off makes the potential worse than the best by what the second number allows for.
        EXPECT_NEAR(std::log2(certified[k].energy_norm / certified[k + 1].energy_norm), 1.5, 0.8)
            << thickness << " " << degree << " " << k;
      }
    }
}

TEST(Certificate, BoundsScenesWithUnevenOrSingularContact) {
  for (const double omega : {0., 0.6, 1.})
    for (const bool is_cut : {false, true}) {
      const double s = omega == 1 ? 1. / 3 : 1. / 2;
      const GegenbauerPressure pressure(4.9, 0.41, is_cut ? 0.5 - s : 1.5 - s, {0.3, 0.05, 0.02});
      const ManufacturedScene made =
          manufacture_scene(0.5, 1, omega, pressure, is_cut ? -s : 1 - s, 0.3, is_cut ? 0 : 0.4,
                            is_cut ? 20000 : 3000);
      for (const int degree : {1, 2})
        for (const int cycles : {0, 6}) {
          const Parameters parameters = parameters_of(
              {"Mesh/Degree=" + std::to_string(degree), "Mesh/Radial cells=4",
               "Mesh/Angular cells=50", "Mesh/Adaptive cycles=" + std::to_string(cycles)});
          const Solution solution = simulate(made.scene, parameters);
          const TrueErrors errors =
              measure_true_errors(*solution.space, solution.displacement, solution.result,
                                  solution.certificate, made.exact);
          SCOPED_TRACE(testing::Message() << "omega " << omega << " cut " << is_cut << " degree "
                                          << degree << " cycles " << cycles);
          EXPECT_LE(solution.result.certified->lower_bound, made.exact.energy);
          EXPECT_GE(solution.result.certified->upper_bound, made.exact.energy);
          EXPECT_GE(solution.result.certified->energy_norm, *errors.admissible_energy_norm);
          EXPECT_LE(*errors.effectivity, 6);
        }
    }
}

TEST(Certificate, HoldsForForcesWithKinks) {
  // No contact, so that the finest solution's certified bounds enclose J for the coarser ones.
  for (const std::string force :
       {"sin(3*z)*r^2", "abs(z-3)", "if(r<0.7123,1,0)*if(z<2,1,-1)", "sin(9*z)*exp(40*(r-1))",
        "if((r-0.7)^2+(z-3)^2<0.01,1,0)", "exp(-((z-4.7)/0.003)^2)"}) {
    const auto solve = [&](const std::string& key, int times) {
      const Parameters parameters = parameters_of(
          {"Cylinder/Radial force=" + force, "Road/Distance=1.95", "Mesh/Radial cells=3",
           "Mesh/Angular cells=36", key + "=" + std::to_string(times)});
      return *simulate(make_scene(parameters), parameters).result.certified;
    };
    double lower = -1e9, upper = 1e9;
    for (const std::string key : {"Mesh/Global refinements", "Mesh/Adaptive cycles"})
      for (const int times : {0, 1, 2, 3}) {
        const CertifiedError certified = solve(key, times);
        EXPECT_LT(certified.lower_bound, certified.upper_bound);
        // Each interval meets all others.
        lower = std::max(lower, certified.lower_bound);
        upper = std::min(upper, certified.upper_bound);
        EXPECT_LT(lower, upper) << force << " after " << times << " of " << key;
      }
  }
}

// A strip of a cell, too narrow for the points of the load, in which the force is another.
TEST(Certificate, SeesAJumpBesideALineOfTheMesh) {
  const double cell = 2 * PI / 48, line = PI / 2 + 5 * cell;
  const auto certify_jump = [](double at, int degree, int angular_cells) {
    const Parameters parameters =
        with(paper_scenes()[0].parameters(),
             {"Mesh/Degree=" + std::to_string(degree), "Mesh/Radial cells=4", "Road/Distance=1.3",
              "Mesh/Angular cells=" + std::to_string(angular_cells),
              "Cylinder/Radial force=if(z<" + digits(at) + ",1,0)"});
    return *simulate(make_scene(parameters), parameters).result.certified;
  };
  for (const double share : {-0.01, 0.01}) {
    const double at = line + share * cell;
    const CertifiedError coarse = certify_jump(at, 4, 48);
    const CertifiedError fine = certify_jump(at, 4, 4800); // on which the jump is a line
    EXPECT_LE(coarse.lower_bound, fine.upper_bound) << share;
    EXPECT_GE(coarse.upper_bound, fine.lower_bound) << share;
  }
}

TEST(Certificate, SeesAStripOfAFewCells) {
  const double cell = 2 * PI / 480;
  const auto certify_strip = [&](double begin, int radial_cells, int angular_cells) {
    const Parameters parameters =
        with(paper_scenes()[0].parameters(),
             {"Mesh/Degree=2", "Mesh/Radial cells=" + std::to_string(radial_cells),
              "Road/Distance=1.3", "Mesh/Angular cells=" + std::to_string(angular_cells),
              "Cylinder/Radial force=1+if(abs(z-" + digits(begin + 1.5 * cell) + ")<" +
                  digits(1.5 * cell) + ",5,0)"});
    return *simulate(make_scene(parameters), parameters).result.certified;
  };
  for (const int line : {224, 226, 228}) {
    const CertifiedError coarse = certify_strip(PI / 2 + line * cell, 20, 480),
                         fine = certify_strip(PI / 2 + line * cell, 40, 1440);
    EXPECT_LE(coarse.lower_bound, fine.upper_bound) << line;
    EXPECT_GE(coarse.upper_bound, fine.lower_bound) << line;
  }
}

// -J = int pi f^2 (b^2 - r^2)^2 / (4 r) dr without contact, to the last digits: sums over many
// cells that rounded as doubles do would be off by more than the bounds are apart.
TEST(Certificate, EnclosesTheEnergyToRoundOff) {
  const long double a = 0.9, f = 8;
  const long double expected = -static_cast<long double>(PI) * f * f / 4 *
                               (std::log(1 / a) - (1 - a * a) + (1 - a * a * a * a) / 4);
  for (const int factor : {1, 2, 4, 8}) {
    const Parameters parameters = parameters_of(
        {"Cylinder/Inner radius=0.9", "Cylinder/Angular velocity=1", "Cylinder/Radial force=8",
         "Road/Distance=1.3", "Mesh/Degree=3", "Mesh/Radial cells=" + std::to_string(5 * factor),
         "Mesh/Angular cells=" + std::to_string(31 * factor)});
    const CertifiedError certified = *simulate(make_scene(parameters), parameters).result.certified;
    EXPECT_LE(certified.lower_bound, expected);
    EXPECT_GE(certified.upper_bound, expected);
    EXPECT_LT(certified.upper_bound - certified.lower_bound, 1e-11 * std::abs(expected));
  }
}

TEST(Certificate, IsNearlyTheSameForANumberAndAnExpressionOfItsValue) {
  for (const int degree : {1, 2}) {
    const auto certify_force = [&](const std::string& force) {
      const Parameters parameters =
          parameters_of({"Cylinder/Radial force=" + force, "Mesh/Degree=" + std::to_string(degree),
                         "Road/Contact zone=4, 5.4", "Mesh/Radial cells=4", "Mesh/Angular cells=40",
                         "Mesh/Adaptive cycles=3"});
      return *simulate(make_scene(parameters), parameters).result.certified;
    };
    const CertifiedError number = certify_force("2"), expression = certify_force("2+0*abs(z-3)");
    EXPECT_NEAR(expression.energy_norm / number.energy_norm, 1, 0.01);
    EXPECT_NEAR(expression.lower_bound / number.lower_bound, 1, 1e-3);
    EXPECT_NEAR(expression.upper_bound / number.upper_bound, 1, 1e-3);
  }
}

TEST(LoadBounds, EncloseTheExactLoad) {
  for (const char* scene_key : {"Cylinder/Angular velocity=0.5", "Cylinder/Angular velocity=1",
                                "Cylinder/Radial force=1", "Road/Contact zone=4.5, 4.95"}) {
    const Parameters parameters =
        parameters_of({scene_key, "Mesh/Radial cells=4", "Mesh/Angular cells=48",
                       "Mesh/Wanted relative error=1e-3", "Certificate/Load bounds=true"});
    const Scene scene = make_scene(parameters);
    const Solution solution = simulate(scene, parameters);
    const LoadBounds bounds = *solution.result.load_bounds;
    EXPECT_LT(bounds.lower, bounds.upper);
    EXPECT_LT(bounds.upper - bounds.lower, 0.01 * bounds.upper);
    if (const auto exact = find_exact_solution(scene)) {
      // With z = m - w cos(x) even a singular pressure is smooth.
      const auto& pressure = exact->pressure;
      const double load = boost::math::quadrature::gauss<double, 100>::integrate(
          [&](double x) {
            const double z = pressure.middle() - pressure.half_width() * std::cos(x);
            return pressure.over_weight(z) * pressure.half_width() *
                   std::pow(std::sin(x), 2 * pressure.order()) / std::cos(z - 3 * PI / 2);
          },
          0, PI);
      EXPECT_LT(bounds.lower, load) << scene_key;
      EXPECT_GT(bounds.upper, load) << scene_key;
    }
  }
  // Without contact there is no load.
  const Parameters free = parameters_of({"Road/Distance=1.5", "Certificate/Load bounds=true"});
  const LoadBounds none = *simulate(make_scene(free), free).result.load_bounds;
  EXPECT_EQ(none.lower, 0);
  EXPECT_EQ(none.upper, 0);
}

TEST(Certificate, OfAnExactSolutionIsRoundOff) {
  // u = phi ln(r/a)/ln(b/a) is no polynomial, but without force and contact u = 0 is.
  const Parameters parameters =
      parameters_of({"Road/Distance=1.5", "Mesh/Radial cells=2", "Mesh/Angular cells=12"});
  const Solution solution = simulate(make_scene(parameters), parameters);
  EXPECT_EQ(solution.result.certified->energy_norm, 0);
  EXPECT_EQ(solution.result.certified->relative, 0);
  EXPECT_EQ(solution.result.certified->lower_bound, 0);
  EXPECT_EQ(solution.result.certified->upper_bound, 0);
}

TEST(Certificate, OfFullContactEnclosesTheExactEnergy) {
  // J = -b phi lambda pi = pi phi^2 / ln(b/a)
  const double phi = -0.1, energy = PI * phi * phi / std::log(2.);
  for (const int degree : {1, 2, 3, 8}) {
    const Parameters parameters =
        parameters_of({"Mesh/Degree=" + std::to_string(degree), "Mesh/Radial cells=3",
                       "Mesh/Angular cells=24", "Mesh/Adaptive cycles=3"});
    const Solution solution = simulate(full_circle(0.5, 1, 0.5, phi), parameters);
    const CertifiedError& certified = *solution.result.certified;
    // Where the mesh is the same at every angle the flux is exact, and so is the lower bound but
    // for the rounding of sums over all cells.
    const double round_off = 1e-12 * energy;
    EXPECT_LE(certified.lower_bound, energy + round_off);
    EXPECT_GE(certified.upper_bound, energy - round_off);
    EXPECT_LT(certified.relative, degree == 1 ? 0.05 : 0.005);
  }
}

TEST(StressFunctionBasis, AreNodalAndContainTheDepth) {
  const Scene scene = full_circle(0.5, 1, 0.8, 0);
  for (const unsigned int degree : {1, 2, 4}) {
    const StressFunctionBasis shapes(scene, degree, 0.6, 0.75);
    const dealii::QGaussLobatto<1> nodes(degree + 1);
    for (unsigned int k = 0; k <= degree; ++k) {
      const auto values = shapes.values(0.6 + 0.15 * nodes.point(k)[0]);
      for (unsigned int i = 0; i <= degree; ++i)
        EXPECT_NEAR(values[i], i == k ? 1 : 0, 1e-12);
    }
    // s and, from degree 2 on, int rho^2 alpha drho = r - omega^2 r^3/3
    const auto depth = [](double r) { return -std::log(r) + 0.32 * r * r; };
    const auto next = [](double r) { return r - 0.64 * r * r * r / 3; };
    for (const double r : {0.61, 0.68, 0.74}) {
      const auto values = shapes.values(r), slopes = shapes.depth_derivatives(r);
      double s = 0, s_slope = 0, second = 0;
      for (unsigned int i = 0; i <= degree; ++i) {
        const double node = 0.6 + 0.15 * nodes.point(i)[0];
        s += values[i] * depth(node);
        s_slope += slopes[i] * depth(node);
        second += values[i] * next(node);
      }
      EXPECT_NEAR(s, depth(r), 1e-13);
      EXPECT_NEAR(s_slope, 1, 1e-11);
      if (degree > 1) {
        EXPECT_NEAR(second, next(r), 1e-12);
      }
    }
  }
}

TEST(StressFunctionBasis, AreAccurateInThinLayersAtTheCriticalSpeed) {
  // b = 1, s(1 - y) = y^2 + y^3/3 + y^4/4 + ...
  const Scene scene = full_circle(0.5, 1, 1, 0);
  for (double y = 1e-12; y < 0.5; y *= 10) {
    const double inner = 1 - y, thickness = 1 - inner;
    double series = thickness * thickness;
    for (int k = 60; k >= 3; --k)
      series += std::pow(thickness, k) / k;
    // Points between inner and 1 are rounded to multiples of the unit in the last place.
    EXPECT_NEAR(StressFunctionBasis(scene, 2, inner, 1).depth() / series, 1,
                1e-13 + 4e-16 / thickness);
  }
}

} // namespace
