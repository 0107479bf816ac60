// The guaranteed intervals of the contact force and the vertical load contain the exact loads,
// whatever the road, the zone, the force and the mesh.
#include "rollwave/error_bound/load_bounds.h"

#include "manufactured_scene.h"
#include "rollwave/run/simulation.h"
#include "rollwave/verify/reference_solution.h"
#include "test_scenes.h"

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

using namespace rollwave;
using dealii::numbers::PI;

namespace {

/// The intervals contain the loads, up to the accuracy of these.
void expect_contained(const CertifiedError& certified, const Loads& loads, double accuracy) {
  const double slack = accuracy * std::abs(loads.total);
  EXPECT_LE(certified.loads.total.lower, loads.total + slack);
  EXPECT_GE(certified.loads.total.upper, loads.total - slack);
  EXPECT_LE(certified.loads.vertical.lower, loads.vertical + slack);
  EXPECT_GE(certified.loads.vertical.upper, loads.vertical - slack);
  EXPECT_GE(certified.loads.total.lower, 0);
}

/// sqrt(1/2) eta |w| is the largest half-width of an interval; the rest is round-off.
void expect_narrow(const CertifiedError& certified, const Scene& scene) {
  const double depth = std::log(scene.outer_radius / scene.inner_radius);
  const auto half_width = [](const Interval& load) { return (load.upper - load.lower) / 2; };
  EXPECT_LE(half_width(certified.loads.total),
            0.71 * certified.eta * std::sqrt(2 * PI / depth) + 1e-13);
  // Among the functions that are cos x on the surface, the vertical one has the least norm: less
  // than cos x ln(r/a) / ln(b/a), of which d/dz adds int ln(r/a)^2 / r dr = depth^3 / 3.
  EXPECT_LE(half_width(certified.loads.vertical),
            0.71 * certified.eta * std::sqrt(PI * (1 / depth + depth / 3)) + 1e-13);
}

/// Certifies a scene that has an exact solution, with and without adaptive meshes.
void expect_exact_loads(const std::vector<std::string>& settings) {
  std::optional<ExactSolution> exact;
  for (const char* degree : {"1", "2", "4"})
    for (const char* cycles : {"0", "4"}) {
      SCOPED_TRACE(testing::PrintToString(settings) + " Q" + degree + ", cycles " + cycles);
      const Parameters parameters =
          with(parameters_of({"Mesh/Radial cells=2", "Mesh/Angular cells=36",
                              std::string("Mesh/Degree=") + degree,
                              std::string("Mesh/Adaptive cycles=") + cycles}),
               settings);
      const Scene scene = make_scene(parameters);
      if (!exact)
        exact = find_exact_solution(scene);
      ASSERT_TRUE(exact);
      const CertifiedError certified = *simulate(scene, parameters).result.certified;
      expect_contained(certified, exact->loads, 10 * exact->force_accuracy + 1e-12);
      expect_narrow(certified, scene);
    }
}

// F is measured by w = ln(r/a) / ln(b/a), and a force that Q_h misses by delta widens the interval.
TEST(LoadBounds, HaveTheNormOfTheirFunctionAndThePartOfTheForce) {
  const Parameters parameters =
      parameters_of({"Cylinder/Radial force=cos(3*z)*r", "Mesh/Radial cells=4",
                     "Mesh/Angular cells=100", "Mesh/Degree=1"});
  const Scene scene = make_scene(parameters);
  const double norm_squared = load_functions(scene)[0].norm_squared();
  EXPECT_NEAR(norm_squared, 2 * PI / std::log(scene.outer_radius / scene.inner_radius), 1e-12);
  const CertifiedError certified = *simulate(scene, parameters).result.certified;
  const Interval& load = certified.loads.total;
  ASSERT_GT(load.lower, 0);
  ASSERT_GT(certified.force_data, 0);
  EXPECT_GE((load.upper - load.lower) / 2,
            (certified.eta / 2 + 2 * certified.force_data) * std::sqrt(norm_squared) * (1 - 1e-9));
}

TEST(LoadBounds, ContainTheLoadsOfThePaper) {
  for (const PaperScene& paper : paper_scenes())
    expect_exact_loads({assignment("Cylinder/Angular velocity", paper.angular_velocity),
                        assignment("Cylinder/Radial force", paper.force_density),
                        assignment("Road/Distance", paper.distance)});
}

TEST(LoadBounds, ContainTheLoadsOnDrums) {
  for (const double curvature : {-0.9, -0.5, 1., 5., 20.})
    expect_exact_loads({assignment("Road/Curvature", curvature)});
  for (const double curvature : {-0.9, 1.})
    expect_exact_loads({assignment("Road/Curvature", curvature), "Cylinder/Angular velocity=1"});
}

TEST(LoadBounds, ContainTheLoadsOfCutZonesAndThinRings) {
  for (const char* speed : {"Cylinder/Angular velocity=0", "Cylinder/Angular velocity=1"}) {
    expect_exact_loads({speed, "Road/Contact zone=4.450589592585541, 4.974188368183839"});
    expect_exact_loads({speed, "Cylinder/Inner radius=0.99", "Road/Distance=0.995",
                        "Mesh/Angular cells=120", "Cylinder/Radial force=0.3"});
    expect_exact_loads({speed, "Cylinder/Inner radius=0.01", "Mesh/Radial cells=8"});
  }
}

// Where a zone cuts the contact at one side, or contact is uneven, the exact loads are those of a
// pressure that is given.
TEST(LoadBounds, ContainTheLoadsOfUnevenContact) {
  for (const double omega : {0., 0.6, 1.})
    for (const bool is_cut : {false, true}) {
      const double s = omega == 1 ? 1. / 3 : 1. / 2;
      const GegenbauerPressure pressure(4.9, 0.41, is_cut ? 0.5 - s : 1.5 - s, {0.3, 0.05, 0.02});
      const ManufacturedScene made =
          manufacture_scene(0.5, 1, omega, pressure, is_cut ? -s : 1 - s, 0.3, is_cut ? 0 : 0.4,
                            is_cut ? 20000 : 3000);
      for (const char* degree : {"1", "2"}) {
        const Parameters parameters =
            parameters_of({std::string("Mesh/Degree=") + degree, "Mesh/Radial cells=4",
                           "Mesh/Angular cells=50", "Mesh/Adaptive cycles=2"});
        SCOPED_TRACE(testing::Message() << omega << " cut " << is_cut << " Q" << degree);
        const CertifiedError certified = *simulate(made.scene, parameters).result.certified;
        // made.exact has the total load only
        const auto phase = std::polar(1., from_lowest_point(pressure.middle()));
        Loads loads = made.exact.loads;
        loads.vertical = (pressure.fourier_integral(1) * phase).real();
        expect_contained(certified, loads, 1e-8);
        expect_narrow(certified, made.scene);
      }
    }
}

// The load of a force that is an expression is between those of finer meshes, and does not depend
// on whether a number is written as one.
TEST(LoadBounds, OfExpressionsMeetThoseOfFinerMeshes) {
  for (const std::string force :
       {"sin(3*z)*r^2", "1-2*sin(z)", "if(r<0.7123,1,0)*if(z<4.5,1,-1)", "abs(z-3)"})
    for (const char* degree : {"1", "3"}) {
      LoadBounds common = {{-1e9, 1e9}, {-1e9, 1e9}};
      for (const char* refinements : {"0", "1", "3"}) {
        const Parameters parameters =
            parameters_of({"Cylinder/Radial force=" + force, std::string("Mesh/Degree=") + degree,
                           "Mesh/Radial cells=2", "Mesh/Angular cells=30",
                           std::string("Mesh/Global refinements=") + refinements});
        const LoadBounds loads =
            simulate(make_scene(parameters), parameters).result.certified->loads;
        for (const auto& load : {&LoadBounds::total, &LoadBounds::vertical}) {
          (common.*load).lower = std::max((common.*load).lower, (loads.*load).lower);
          (common.*load).upper = std::min((common.*load).upper, (loads.*load).upper);
          EXPECT_LT((common.*load).lower, (common.*load).upper) << force << " Q" << degree;
        }
      }
    }
}

// Without contact (f, w) = a(u, w) for the exact u, so that the middle of the interval is the error
// of v alone: of the order of eta^2 for w that are smooth, also where f pushes to one side.
TEST(LoadBounds, ContainZeroWithoutContact) {
  for (const std::string force : {"-1", "sin(z)", "-r^2*(2+sin(z))", "0"})
    for (const char* degree : {"1", "2", "4"}) {
      const Parameters parameters =
          parameters_of({"Cylinder/Radial force=" + force, std::string("Mesh/Degree=") + degree,
                         "Road/Distance=1.5", "Mesh/Radial cells=2", "Mesh/Angular cells=24"});
      const Result result = simulate(make_scene(parameters), parameters).result;
      const LoadBounds& loads = result.certified->loads;
      EXPECT_EQ(result.contact.active_nodes, 0u);
      EXPECT_EQ(loads.total.lower, 0) << force;
      EXPECT_EQ(loads.vertical.lower, 0) << force;
      EXPECT_GE(loads.total.upper, 0) << force;
      EXPECT_GE(loads.vertical.upper, 0) << force;
      EXPECT_LE(loads.total.upper, 4 * result.certified->energy_norm) << force;
      EXPECT_LE(loads.vertical.upper, 4 * result.certified->energy_norm) << force;
    }
}

// u = phi ln(r/a) / ln(b/a) with F = -2 pi phi / ln(b/a), and no vertical load.
TEST(LoadBounds, OfFullContactAreNarrow) {
  const double phi = -0.1, force = -2 * PI * phi / std::log(2.);
  for (const int degree : {1, 2, 8}) {
    const Parameters parameters = parameters_of(
        {"Mesh/Degree=" + std::to_string(degree), "Mesh/Radial cells=3", "Mesh/Angular cells=24"});
    const Scene scene = full_circle(0.5, 1, 0.5, phi);
    const CertifiedError certified = *simulate(scene, parameters).result.certified;
    expect_contained(certified, {force, 0, 0}, 1e-13);
    expect_narrow(certified, scene);
    EXPECT_LT(certified.loads.vertical.lower, 0); // no sign is known on the whole circle
    if (degree == 8) {
      EXPECT_LT(certified.loads.total.upper - certified.loads.total.lower, 1e-9);
    }
  }
}

} // namespace
