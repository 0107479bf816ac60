// Drums in which contact runs into the tangent, where phi is vertical: all guaranteed intervals of
// one scene have a number in common, whatever the mesh.
#include "rollwave/error_bound/admissible_road.h"

#include "draw.h"
#include "rollwave/run/simulation.h"
#include "test_scenes.h"

#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace rollwave;

namespace {

/// What is left when intervals of one number are intersected.
struct Common {
  double lower = -std::numeric_limits<double>::infinity(),
         upper = std::numeric_limits<double>::infinity();

  void intersect(double low, double high) {
    lower = std::max(lower, low);
    upper = std::min(upper, high);
  }
};

TEST(DeepDrums, HaveIntervalsThatMeet) {
  Draw draw(20261128);
  for (int i = 0; i < n_random_scenes(12); ++i) {
    const double a = draw.number(0.2, 0.6), omega = draw.one_of<double>({0, draw.number(0, 1), 1}),
                 curvature = 2 * std::pow(25, draw.number(0, 1)),
                 distance = a + (1 - a) * draw.number(0.05, 0.3);
    const std::vector<std::string> scene = {
        assignment("Cylinder/Inner radius", a), assignment("Cylinder/Angular velocity", omega),
        assignment("Road/Curvature", curvature), assignment("Road/Distance", distance)};
    SCOPED_TRACE(testing::PrintToString(scene));
    Common energy, force, vertical;
    for (int degree = 1; degree <= 4; ++degree)
      for (const auto& [radial, angular] :
           {std::pair(1, 6), {2, 22}, {4, 36}, {3, 100}, {6, 200}}) {
        const Parameters parameters =
            with(parameters_of(scene), {"Mesh/Degree=" + std::to_string(degree),
                                        "Mesh/Radial cells=" + std::to_string(radial),
                                        "Mesh/Angular cells=" + std::to_string(angular)});
        const CertifiedError certified =
            *simulate(make_scene(parameters), parameters).result.certified;
        energy.intersect(certified.lower_bound, certified.upper_bound);
        force.intersect(certified.loads.total.lower, certified.loads.total.upper);
        vertical.intersect(certified.loads.vertical.lower, certified.loads.vertical.upper);
      }
    for (const Common& common : {energy, force, vertical})
      EXPECT_LE(common.lower, common.upper);
  }
}

// A case in which phi_v = phi up to the tangent has an energy without end, and J(v) by a rule of
// finitely many points is below J(u).
TEST(DeepDrums, HaveAnUpperBoundOfTheEnergy) {
  constexpr double exact = 0.235388; // by a mesh of 400 cells of degree 4
  for (const int angular : {22, 36}) {
    const Parameters parameters = parameters_of(
        {"Cylinder/Inner radius=0.3", "Road/Distance=0.37", "Road/Curvature=5", "Mesh/Degree=3",
         "Mesh/Radial cells=4", "Mesh/Angular cells=" + std::to_string(angular)});
    const CertifiedError certified = *simulate(make_scene(parameters), parameters).result.certified;
    EXPECT_LE(certified.lower_bound, exact);
    EXPECT_GE(certified.upper_bound, exact);
  }
}

TEST(AdmissibleRoad, EnclosesTheRoad) {
  for (const double curvature : {-0.9, 0., 0.3, 5., 50., 1e4}) {
    const Road road = {1, 0.8, curvature};
    const AdmissibleRoad admissible(road, make_obstacle(road), 0.1);
    const double last = std::min(1.5, 3 * road.tangent_angle());
    for (int i = -1000; i <= 1000; ++i) {
      const double z = lowest_point + last * i / 1000,
                   phi = road.displacement(from_lowest_point(z));
      EXPECT_LE(admissible.limit(z).value, phi + 1e-14) << curvature << " " << z;
      EXPECT_GE(admissible.upper(z), phi - 1e-14) << curvature << " " << z;
    }
  }
}

// 11 points, as for degree 1, against 60. For larger curvatures the rounding of z is larger.
TEST(AdmissibleRoad, IsResolvedWhereItSaysSo) {
  const dealii::QGauss<1> few(11), many(60);
  int n_checked = 0;
  for (const double curvature : {-1., -0.9, 0., 0.3, 5., 50.}) {
    const Road road = {1, 0.8, curvature};
    const double last = std::min(1.57, road.tangent_angle());
    const AdmissibleRoad admissible(road, make_obstacle(road), 1e-3 * last);
    const auto integral = [&](const dealii::Quadrature<1>& rule, double begin, double end) {
      double sum = 0;
      for (unsigned int q = 0; q < rule.size(); ++q) {
        const double z = begin + (end - begin) * rule.point(q)[0];
        sum += rule.weight(q) * std::pow(admissible.limit(z).slope, 2);
      }
      return sum;
    };
    Draw draw(11);
    for (int i = 0; i < 1000; ++i) {
      const double begin = lowest_point + 0.9998 * last * draw.number(-1, 1),
                   end = begin + last * draw.power_of_ten(-4, 0.5);
      if (end > lowest_point + 0.9998 * last || !admissible.is_resolved(begin, end))
        continue;
      ++n_checked;
      const double exact = integral(many, begin, end);
      EXPECT_NEAR(integral(few, begin, end), exact, 1e-12 * exact + 1e-16)
          << curvature << " " << begin << " " << end;
    }
  }
  EXPECT_GT(n_checked, 1000);
}

} // namespace
