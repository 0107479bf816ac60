// The ends of contact lie between nodes, and resultants are sums over the nodes.
#include "rollwave/contact/contact_patch.h"
#include "rollwave/run/simulation.h"
#include "rollwave/scene/scene.h"
#include "test_scenes.h"

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace rollwave;

namespace {

/// Contact between @p left and @p right with the exact end laws of exponent s.
ContactResultants patch_of(double left, double right, double s, double omega, double begin,
                           double end, unsigned int n, double curvature = 0) {
  const Scene scene{0.5, 1, omega, {}, {}, begin, end};
  ContactProblem problem;
  ContactSolution solution;
  problem.road = {1, 0.8, curvature};
  problem.phi.reinit(n);
  problem.weight.reinit(n);
  solution.state.displacement.reinit(n);
  solution.state.force.reinit(n);
  for (unsigned int i = 0; i < n; ++i) {
    const double z = begin + (end - begin) * i / (n - 1);
    problem.weight(i) = 0.1;
    problem.x.push_back(from_lowest_point(z));
    problem.cell_ratio.push_back(1);
    const double outside = std::max(left - z, z - right);
    solution.active.push_back(outside < 0);
    if (outside < 0)
      solution.state.force(i) = 0.1 * std::pow(std::min(z - left, right - z), 1 - s);
    else
      solution.state.displacement(i) = -std::pow(outside, 1 + s);
  }
  return measure_contact(scene, problem, solution, 1);
}

// A contact that grows from one node to the next: the laws at the nodes themselves are not those of
// a mesh, so that the ends are off by a part of an edge, but they grow with it.
TEST(ContactPatch, EndsGrowWithTheContact) {
  const double edge = 2.2 / 59;
  for (const auto& [s, omega] : {std::pair(1. / 2, 0.5), {1. / 3, 1.}})
    for (double moved = 0, before = 0; moved < edge; moved += edge / 50) {
      const auto patch = patch_of(4.2137 - moved, 5.031 + moved, s, omega, 3.6, 5.8, 60);
      EXPECT_NEAR(patch.ends->first, 4.2137 - moved, 0.35 * edge);
      EXPECT_NEAR(patch.ends->second, 5.031 + moved, 0.35 * edge);
      EXPECT_GT(patch.half_width(), before);
      if (before > 0) {
        EXPECT_LT(patch.half_width() - before, edge / 5);
      }
      before = patch.half_width();
    }
}

TEST(ContactPatch, LawNearTheCriticalSpeedDependsOnTheNodeDistance) {
  const auto end_at = [](double omega) {
    return patch_of(4.2137, 5.031, 0.5, omega, 3.6, 5.8, 60).ends->first;
  };
  // The nodes are 0.04 apart; (2 e)^(3/2) is 0.09 for e = 0.1 and 9e-5 for e = 0.001.
  EXPECT_EQ(end_at(0.9), end_at(0.5));
  EXPECT_EQ(end_at(0.999), end_at(1));
  EXPECT_NE(end_at(0.999), end_at(0.5));
}

// One free node is left, so that pressures alone place the end. At the critical speed they fall
// faster towards it, and the same pressures have their end farther out.
TEST(ContactPatch, SamePressuresEndFartherOutAtTheCriticalSpeed) {
  const auto end_at = [](double omega) {
    return patch_of(4.2137, 5.78, 0.5, omega, 3.6, 5.8, 60).ends->second;
  };
  EXPECT_GT(end_at(1), end_at(0.5));
}

TEST(ContactPatch, EndsWithTheZoneWhereItCutsContactShort) {
  const auto patch = patch_of(3, 4.9, 0.5, 0.5, 3.6, 5.8, 60);
  EXPECT_EQ(patch.ends->first, 3.6);
  EXPECT_NEAR(patch.ends->second, 4.9, 0.35 * 2.2 / 59);
}

TEST(ContactPatch, OneNodeHasEndsAroundIt) {
  const auto patch = patch_of(4.69, 4.71, 0.5, 0.5, 3.7, 5.7, 11);
  EXPECT_EQ(patch.active_nodes, 1u);
  EXPECT_GT(patch.half_width(), 0);
  EXPECT_LT(patch.half_width(), 0.2);
}

// A flat road, two drums, and a drum around the cylinder, more than half of which is in contact.
TEST(ContactPatch, LengthOnTheRoadIsThatOfItsArc) {
  const ContactPatch flat = patch_of(4.2137, 5.031, 0.5, 0.5, 3.6, 5.8, 60).patches[0];
  EXPECT_NEAR(flat.length,
              0.8 *
                  (std::tan(from_lowest_point(flat.end)) - std::tan(from_lowest_point(flat.begin))),
              1e-11);
  for (const double kappa : {1e-6, 5., 20., -0.5}) {
    const Road road = {1, 0.8, kappa};
    const auto x = [&](double z) {
      return (1 + road.displacement(from_lowest_point(z))) * std::cos(z);
    };
    const auto y = [&](double z) {
      return (1 + road.displacement(from_lowest_point(z))) * std::sin(z);
    };
    const ContactPatch patch = patch_of(4.67, 4.76, 0.5, 0.5, 4.6, 4.83, 60, kappa).patches[0];
    const double chord = std::hypot(x(patch.end) - x(patch.begin), y(patch.end) - y(patch.begin));
    EXPECT_NEAR(patch.length, 2 / std::abs(kappa) * std::asin(std::abs(kappa) * chord / 2),
                1e-9 * chord)
        << kappa;
  }
  // The axle is the centre of the drum.
  const ContactPatch around = patch_of(3.1, 6.3, 0.5, 0.5, 2.8, 6.6, 200, -1 / 0.8).patches[0];
  EXPECT_NEAR(around.length, 0.8 * (around.end - around.begin), 1e-11);
}

/// The contact of figure 4 with other @p settings.
ContactResultants contact_with(const std::vector<std::string>& settings) {
  const Parameters parameters = with(paper_scenes()[0].parameters(), settings);
  return simulate(make_scene(parameters), parameters).result.contact;
}

/// The nip with its estimated error.
std::pair<double, double> nip_with(const std::vector<std::string>& settings) {
  const ContactResultants contact = contact_with(settings);
  return {contact.sum(&ContactPatch::length), contact.sum(&ContactPatch::length_uncertainty)};
}

// The meshes are the same, the automatic zones are not. The exact nip is that of the half-width.
TEST(ContactPatch, OneMeshHasOneNip) {
  const double exact = 2 * 0.8 * std::tan(paper_scenes()[0].half_width);
  const auto [nip, uncertainty] =
      nip_with({"Mesh/Degree=1", "Mesh/Radial cells=8", "Mesh/Angular cells=40"});
  EXPECT_NEAR(nip, exact, uncertainty);
  EXPECT_LT(uncertainty, 0.2 * exact);
  const std::vector<std::vector<std::string>> others = {
      {"Mesh/Radial cells=4", "Mesh/Angular cells=20", "Mesh/Global refinements=1"},
      {"Mesh/Radial cells=8", "Mesh/Angular cells=40", "Cylinder/Radial force=0*r"}};
  for (std::vector<std::string> settings : others) {
    settings.push_back("Mesh/Degree=1");
    EXPECT_NEAR(nip_with(settings).first, nip, 1e-9 * nip);
  }
}

// The exact nips are those of the semi-analytic solution.
TEST(ContactPatch, NipOnADrumIsWithinItsUncertainty) {
  for (const auto& [distance, exact] : {std::pair(0.83, 0.238203), {0.8325, 0.236418}}) {
    const auto [nip, uncertainty] = nip_with(
        {"Cylinder/Angular velocity=0.9", assignment("Road/Distance", distance), "Road/Curvature=8",
         "Mesh/Degree=3", "Mesh/Radial cells=2", "Mesh/Angular cells=120"});
    EXPECT_NEAR(nip, exact, uncertainty) << distance;
    EXPECT_LT(uncertainty, 0.6 * exact) << distance; // two rows of tall cells
  }
}

// No node lies between the contact and the tangent. The exact nip is that of the semi-analytic
// solution.
TEST(ContactPatch, NipUpToATangentIsWithinItsUncertainty) {
  for (const char* cells : {"22", "36", "60", "100", "200"}) {
    const auto [nip, uncertainty] = nip_with(
        {"Cylinder/Inner radius=0.3", "Road/Distance=0.37", "Road/Curvature=5", "Mesh/Degree=3",
         "Mesh/Radial cells=4", std::string("Mesh/Angular cells=") + cells});
    EXPECT_NEAR(nip, 0.439009, uncertainty) << cells;
    EXPECT_LT(uncertainty, 0.2) << cells;
  }
}

// A node without pressure may as well be one without gap.
TEST(ContactPatch, EndMovesContinuouslyWhenANodeEntersContact) {
  const auto half_width = [](bool active, double pressure, double gap) {
    const Scene scene{0.5, 1, 0.5, {}, {}, 4.5, 5.1};
    ContactProblem problem;
    problem.road = {1, 0.8, 0};
    ContactSolution solution;
    const std::vector<double> pressures = {0.6, 0.5, pressure, 0, 0, 0},
                              gaps = {0, 0, gap, 0.02, 0.05, 0.1};
    problem.phi.reinit(6);
    problem.weight.reinit(6);
    solution.state.displacement.reinit(6);
    solution.state.force.reinit(6);
    for (unsigned int i = 0; i < 6; ++i) {
      problem.weight(i) = 0.1;
      problem.x.push_back(0.1 * i);
      problem.cell_ratio.push_back(1);
      solution.active.push_back(i < 2 || (i == 2 && active));
      solution.state.force(i) = 0.1 * pressures[i];
      solution.state.displacement(i) = -gaps[i];
    }
    return measure_contact(scene, problem, solution, 1).half_width();
  };
  EXPECT_NEAR(half_width(true, 1e-12, 0), half_width(false, 0, 1e-12), 1e-9);
  EXPECT_GT(half_width(true, 0.1, 0), half_width(true, 1e-12, 0));
  EXPECT_GT(half_width(false, 0, 1e-12), half_width(false, 0, 1e-3));
}

// Nearly square cells; the mean over scenes and meshes, on which the ends lie anywhere in an edge.
TEST(ContactPatch, EndsAreWithinATenthOfAnEdge) {
  for (const int degree : {1, 2, 4}) {
    double sum = 0;
    int n = 0;
    for (const PaperScene& paper : paper_scenes())
      for (const int cells : {180, 184, 188, 192, 196, 200}) {
        const Parameters parameters =
            with(paper.parameters(), {"Mesh/Degree=" + std::to_string(degree),
                                      "Mesh/Radial cells=" + std::to_string(20 / degree),
                                      "Mesh/Angular cells=" + std::to_string(cells / degree),
                                      "Certificate/Error bound=false"});
        const ContactResultants contact =
            simulate(make_scene(parameters), parameters).result.contact;
        sum +=
            std::abs(contact.half_width() - paper.half_width) * cells / (2 * dealii::numbers::PI);
        ++n;
      }
    EXPECT_LT(sum / n, 0.1) << degree;
  }
}

TEST(ContactPatch, EstimatesCoverTheErrorsOfThePaperScenes) {
  std::vector<double> ratios; // of an estimate to its error
  const auto add = [&ratios](double number, double exact, double uncertainty) {
    ratios.push_back(uncertainty / std::abs(number - exact));
  };
  for (const PaperScene& paper : paper_scenes())
    for (const char* degree : {"1", "2", "4"})
      for (const auto& [radial, angular] : {std::pair("3", "60"), {"8", "96"}}) {
        const Parameters parameters =
            with(paper.parameters(),
                 {std::string("Mesh/Degree=") + degree, std::string("Mesh/Radial cells=") + radial,
                  std::string("Mesh/Angular cells=") + angular, "Certificate/Error bound=false"});
        const ContactResultants contact =
            simulate(make_scene(parameters), parameters).result.contact;
        ASSERT_EQ(contact.patches.size(), 1u);
        const ContactPatch& patch = contact.patches[0];
        add(patch.half_width(), paper.half_width, patch.half_width_uncertainty());
        add(contact.peak_pressure, paper.peak_pressure, contact.peak_pressure_uncertainty.value());
      }
  std::sort(ratios.begin(), ratios.end());
  EXPECT_GE(ratios[ratios.size() / 20], 1);
  EXPECT_LE(ratios[ratios.size() / 2], 10);
}

TEST(ContactPatch, EndsThatTheZoneCutsAreExactAndThePeakIsUnbounded) {
  const ContactResultants contact =
      contact_with({"Road/Contact zone=4.5, 4.9247779607693793", "Mesh/Radial cells=8"});
  EXPECT_EQ(contact.sum(&ContactPatch::half_width_uncertainty), 0);
  EXPECT_FALSE(contact.peak_pressure_uncertainty);
  // The value is that of the semi-analytic solution.
  const double exact = 1.383681;
  EXPECT_NEAR(contact.stiffness->vertical, exact,
              contact.relative_stiffness_uncertainty * contact.stiffness->vertical);
}

/// Half the width of contact in the scene of figure 4 with other @p settings.
double half_width_with(const std::vector<std::string>& settings) {
  return contact_with(settings).half_width();
}

TEST(ContactPatch, EndsAreWithinAThirdOfACellOnFewNodes) {
  // Three nodes in contact, 0.52 apart.
  EXPECT_NEAR(half_width_with({"Mesh/Degree=1", "Mesh/Radial cells=2", "Mesh/Angular cells=12"}),
              paper_scenes()[0].half_width, 0.17);
  // The value is that of the semi-analytic solution; the nodes are 0.016 apart.
  EXPECT_NEAR(half_width_with({"Road/Curvature=10", "Road/Distance=0.7"}), 0.121624, 0.006);
}

// The first node without contact is next to the tangent. The value is that of the semi-analytic
// solution; the nodes are 0.0065 apart.
TEST(ContactPatch, EndsWithinTheTangentOfADrum) {
  const double half_width =
      half_width_with({"Road/Curvature=5", "Road/Distance=0.5001", "Mesh/Degree=2",
                       "Mesh/Radial cells=12", "Mesh/Angular cells=480"});
  EXPECT_LE(half_width, std::asin(1 / (1 + 5 * 0.5001)) + 1e-15);
  EXPECT_NEAR(half_width, 0.2860, 0.0065);
}

TEST(ContactPatch, LooseUzawaFindsOnePatch) {
  for (const PaperScene& paper : paper_scenes()) {
    const Parameters parameters =
        with(paper.parameters(), {"Mesh/Radial cells=4", "Certificate/Error bound=false"});
    const Scene scene = make_scene(parameters);
    const ContactResultants exact = simulate(scene, parameters).result.contact;
    const Parameters by_uzawa =
        with(parameters, {"Contact/Method=uzawa", "Contact/Tolerance=1e-4"});
    const ContactResultants contact = simulate(scene, by_uzawa).result.contact;
    EXPECT_EQ(contact.patches.size(), 1u) << "figure " << paper.figure;
    EXPECT_NEAR(contact.half_width(), exact.half_width(), 1e-2) << "figure " << paper.figure;
  }
}

TEST(ContactPatch, ResultantsAreSumsOverTheNodes) {
  const double left = 4.2, right = 5.1, begin = 3.6, end = 5.8;
  const unsigned int n = 60;
  double force = 0, vertical = 0, on_distance = 0;
  for (unsigned int i = 0; i < n; ++i) {
    const double z = begin + (end - begin) * i / (n - 1);
    if (z <= left || z >= right)
      continue;
    const double nodal_force = 0.1 * std::sqrt(std::min(z - left, right - z));
    force += nodal_force;
    vertical += nodal_force * -std::sin(z); // cos(z - 3 pi/2)
    on_distance += nodal_force / -std::sin(z);
  }
  const auto patch = patch_of(left, right, 0.5, 0.5, begin, end, n);
  EXPECT_NEAR(patch.loads.total, force, 1e-14 * force);
  EXPECT_NEAR(patch.loads.vertical, vertical, 1e-14 * vertical);
  EXPECT_NEAR(*patch.loads.work_conjugate, on_distance, 1e-14 * on_distance);
}

} // namespace
