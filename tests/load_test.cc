// A prescribed load: the distance that gives it, against the exact answer.
#include "rollwave/base/errors.h"
#include "rollwave/run/quantities.h"
#include "rollwave/run/simulation.h"
#include "rollwave/study/study.h"
#include "rollwave/verify/reference_solution.h"

#include "test_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace rollwave;

namespace {

Solution solve_for(const std::vector<std::string>& settings) {
  const Parameters parameters = parameters_of(settings);
  return simulate(make_scene(parameters), parameters);
}

TEST(Load, GivesBackTheDistanceOfTheExactAnswer) {
  for (const auto& [force, omega] : {std::pair("0", "1"), {"1", "0"}}) {
    const std::vector<std::string> settings = {std::string("Cylinder/Radial force=") + force,
                                               std::string("Cylinder/Angular velocity=") + omega};
    const auto exact = *find_exact_solution(make_scene(parameters_of(settings)));
    for (const auto& [kind, load] :
         {std::pair("vertical", exact.loads.vertical), {"total", exact.loads.total}}) {
      std::vector<std::string> with_load = settings;
      with_load.insert(with_load.end(),
                       {"Road/Load=" + shortest_text(load), std::string("Road/Load kind=") + kind,
                        "Mesh/Radial cells=6", "Mesh/Angular cells=120"});
      const Solution solution = solve_for(with_load);
      EXPECT_NEAR(solution.result.road_distance, 0.8, 1e-4) << kind;
      EXPECT_NEAR(solution.result.contact.loads.of(solution.scene.load->kind), load, 1e-9 * load);
      const DistanceStep& last_step = solution.result.distance_history.back();
      EXPECT_NEAR(last_step.load, load, 1e-9 * load);
      EXPECT_NEAR(last_step.distance, solution.result.road_distance, 1e-12);
      if (kind == std::string("vertical") && force == std::string("1")) {
        EXPECT_NEAR(find_exact_distance(solution.scene).value_or(0), 0.8, 8e-9);
      }
    }
  }
}

TEST(Load, TakesNoFurtherFactorisation) {
  const auto factorisations = [](const std::string& setting) {
    return solve_for({setting, "Mesh/Radial cells=4", "Mesh/Angular cells=48",
                      "Certificate/Error bound=false"})
        .result.statistics.factorisations;
  };
  EXPECT_EQ(factorisations("Road/Load=0.3"), factorisations("Road/Distance=0.8"));
}

// The exact answer has no contact at the distance of this coarse mesh.
TEST(Load, HasAnExactDistanceFarFromThatOfTheMesh) {
  const Scene scene = make_scene(parameters_of({"Cylinder/Radial force=-1", "Road/Load=1e-3"}));
  for (const double start : {0.86010685269559, 0.83, 0.7}) {
    const double c = find_exact_distance(with_distance(scene, start)).value_or(0);
    EXPECT_NEAR(find_exact_solution(with_distance(scene, c))->loads.vertical, 1e-3, 1e-12) << start;
  }
}

TEST(Load, IsMetOnEveryMeshAndByEveryMethod) {
  for (const std::string setting :
       {"Mesh/Wanted relative error=1e-2", "Contact/Method=uzawa", "Cylinder/Inner radius=0.99",
        "Road/Load=1e-5", "Road/Curvature=1", "Cylinder/Radial force=cos(3*z)",
        "Road/Contact zone=4.5, 5"}) {
    const Solution solution =
        solve_for({"Road/Load=0.02", "Mesh/Radial cells=3", "Mesh/Angular cells=60", setting});
    const double load = solution.scene.load->value;
    EXPECT_NEAR(solution.result.contact.loads.vertical / load, 1, 1e-6) << setting;
    EXPECT_EQ(shortfall_text(solution.result.notes), "");
  }
}

TEST(Load, IsRefusedWithTheLargestIfNoDistanceGivesIt) {
  try {
    solve_for({"Road/Load=30", "Mesh/Radial cells=4", "Mesh/Angular cells=48"});
    FAIL();
  } catch (const BadValue& refused) {
    EXPECT_EQ(refused.key, "Load");
    EXPECT_NE(refused.reason.find(" 0.5,"), std::string::npos) << refused.reason;
  }
}

TEST(Load, IsRefusedIfTheFreeSurfaceLiesInsideTheHub) {
  // u_f(b) = -0.509: the surface lies inside of the hub's radius, where no road touches it.
  for (const std::string kind : {"vertical", "total"})
    for (const std::string curvature : {"-0.5", "0", "1"})
      try {
        solve_for({"Cylinder/Radial force=-3.2", "Road/Load=0.1", "Road/Load kind=" + kind,
                   "Road/Curvature=" + curvature, "Mesh/Radial cells=4", "Mesh/Angular cells=48"});
        FAIL() << kind << ' ' << curvature;
      } catch (const BadValue& refused) {
        EXPECT_EQ(refused.key, "Load");
      }
}

TEST(Load, IsMetToNineDigitsOrIsAShortfall) {
  for (const std::string load : {"1e-3", "1e-6", "1e-9", "1e-12"}) {
    const Solution solution = solve_for(
        {"Road/Load=" + load, "Mesh/Radial cells=4", "Mesh/Angular cells=60", "Mesh/Degree=1"});
    const double wanted = solution.scene.load->value;
    EXPECT_TRUE(std::abs(solution.result.contact.loads.vertical / wanted - 1) <= 1e-9 ||
                !shortfall_text(solution.result.notes).empty())
        << load;
  }
}

TEST(Stiffness, IsThatOfTheExactAnswerAndFallsSteadily) {
  // At a fixed set of nodes it would jump by 2.5 % within this range.
  const std::vector<double> distances = {0.795, 0.8, 0.805};
  std::vector<Loads> exact;
  for (const double c : distances) {
    constexpr double h = 1e-3;
    const Scene scene = make_scene(parameters_of({}));
    const ExactSolution near = *find_exact_solution(with_distance(scene, c - h)),
                        far = *find_exact_solution(with_distance(scene, c + h));
    exact.push_back({(near.loads.total - far.loads.total) / (2 * h),
                     (near.loads.vertical - far.loads.vertical) / (2 * h),
                     (*near.loads.work_conjugate - *far.loads.work_conjugate) / (2 * h)});
  }
  for (const auto& mesh : {std::pair("1", 1e-3), {"2", 1e-3}, {"4", 2e-3}}) {
    const auto& [degree, tolerance] = mesh;
    SCOPED_TRACE(degree);
    double last = std::numeric_limits<double>::infinity();
    for (double c = 0.795; c < 0.8051; c += 0.00125) {
      const Solution solution = solve_for(
          {assignment("Road/Distance", c), std::string("Mesh/Degree=") + degree,
           "Mesh/Radial cells=10", "Mesh/Angular cells=200", "Certificate/Error bound=false"});
      const Loads stiffness = *solution.result.contact.stiffness;
      EXPECT_LT(stiffness.vertical, last);
      last = stiffness.vertical;
      for (unsigned int i = 0; i < distances.size(); ++i)
        if (std::abs(c - distances[i]) < 1e-9) {
          EXPECT_NEAR(stiffness.total / exact[i].total, 1, tolerance);
          EXPECT_NEAR(stiffness.vertical / exact[i].vertical, 1, tolerance);
          EXPECT_NEAR(*stiffness.work_conjugate / *exact[i].work_conjugate, 1, 2e-3);
        }
    }
  }
}

TEST(Drum, PressedInUpToItsTangentHasNoWorkConjugateLoad) {
  // dphi/dc is singular at the tangent. The energies at c - 1e-3 and c + 1e-3 give G = 0.4138, the
  // sum over the nodes 0.4105. At kappa = 50 the energies give 0.21218, the series 0.21231.
  const Solution solution =
      solve_for({"Cylinder/Angular velocity=1", "Road/Curvature=10", "Road/Distance=0.55",
                 "Mesh/Radial cells=8", "Mesh/Angular cells=200"});
  EXPECT_FALSE(solution.result.contact.loads.work_conjugate);
  EXPECT_FALSE(solution.result.contact.stiffness);
  EXPECT_FALSE(texts_of(solution.result.notes, Note::Kind::remark).empty());
  EXPECT_GT(solution.result.contact.loads.total, 0.3);
  EXPECT_FALSE(find_exact_solution(solution.scene));
  EXPECT_FALSE(
      find_exact_solution(make_scene(parameters_of({"Road/Curvature=50", "Road/Distance=0.7"}))));
}

// The drum lies between the neighbours of the node.
TEST(Drum, HeldByOneNodeHasNoWorkConjugateLoad) {
  const Result result = solve_for({"Road/Curvature=30", "Road/Distance=0.7", "Mesh/Radial cells=4",
                                   "Mesh/Angular cells=24"})
                            .result;
  EXPECT_EQ(result.contact.active_nodes, 1u);
  EXPECT_FALSE(result.contact.loads.work_conjugate);
  EXPECT_FALSE(result.contact.stiffness);
}

// Only one node lies on the drum at first, which carries less than the load at every distance.
TEST(Load, IsFoundOnAFinerMeshIfTheFirstOneDoesNotReachIt) {
  const std::vector<std::string> coarse = {"Road/Curvature=30", "Road/Load=0.3705",
                                           "Mesh/Radial cells=2", "Mesh/Angular cells=24"};
  std::vector<std::string> adaptive = coarse;
  adaptive.push_back("Mesh/Wanted relative error=0.02");
  const Solution solution = solve_for(adaptive);
  EXPECT_NEAR(solution.result.road_distance, 0.5481, 2e-3);
  EXPECT_NEAR(solution.result.contact.loads.vertical, 0.3705, 1e-9);
  EXPECT_EQ(shortfall_text(solution.result.notes), "");
  EXPECT_EQ(solution.result.cycles.front().road_distance, solution.scene.least_distance);
  try {
    solve_for(coarse);
    FAIL();
  } catch (const BadValue& refused) {
    EXPECT_EQ(refused.key, "Load");
    EXPECT_NE(refused.reason.find("Mesh/Angular cells"), std::string::npos) << refused.reason;
  }
}

// The load of a drum jumps where a node passes the tangent.
TEST(Load, IsMetByMoreAngularCellsWhereItJumps) {
  const std::vector<std::string> scene = {"Cylinder/Inner radius=0.01",
                                          "Cylinder/Angular velocity=0.8",
                                          "Road/Curvature=30",
                                          "Road/Load=0.4425",
                                          "Mesh/Degree=3",
                                          "Mesh/Radial cells=2"};
  std::vector<std::string> coarse = scene, fine = scene;
  coarse.push_back("Mesh/Angular cells=12");
  fine.push_back("Mesh/Angular cells=384");
  const Result jump = solve_for(coarse).result;
  EXPECT_NE(shortfall_text(jump.notes).find("raise Mesh/Angular cells"), std::string::npos);
  EXPECT_EQ(shortfall_text(solve_for(fine).result.notes), "");
}

TEST(Load, OutOfReachMayBeInAnotherUnit) {
  for (const auto& [material, advice] : {std::pair("Material/Shear modulus=1", "section Material"),
                                         {"Material/Shear modulus=2", "Material/Shear modulus"}})
    try {
      solve_for({material, "Road/Load=30", "Mesh/Radial cells=4", "Mesh/Angular cells=48"});
      FAIL();
    } catch (const BadValue& refused) {
      EXPECT_EQ(refused.section + '/' + refused.key, "Road/Load");
      EXPECT_NE(refused.reason.find(advice), std::string::npos) << refused.reason;
    }
}

TEST(Patches, AreReportedSeparately) {
  const Solution solution = solve_for({"Cylinder/Radial force=-8*exp(-((z-4.71238898)/0.12)^2)",
                                       "Mesh/Radial cells=6", "Mesh/Angular cells=180"});
  const ContactResultants& contact = solution.result.contact;
  ASSERT_EQ(contact.patches.size(), 2u);
  const auto &left = contact.patches[0], &right = contact.patches[1];
  EXPECT_LT(left.end, 4.71238898);
  EXPECT_GT(right.begin, 4.71238898);
  EXPECT_NEAR(left.force + right.force, contact.loads.total, 1e-12);
  EXPECT_NEAR(left.force, right.force, 1e-6);
  EXPECT_NEAR(left.centroid + right.centroid, 3 * M_PI, 1e-5);
  EXPECT_LT(left.begin, left.centroid);
  EXPECT_LT(left.centroid, left.end);
  EXPECT_GT(contact.stiffness->total, contact.stiffness->vertical);
  const auto values = values_of(solution.result, {});
  EXPECT_EQ(values.at("contact.patch_count"), 2);
  EXPECT_EQ(values.count("contact.half_width"), 0u);
}

} // namespace
