// A prescribed nip: the distance that gives it, and the shear modulus that it calibrates.
#include "rollwave/base/errors.h"
#include "rollwave/parameters/parameters.h"
#include "rollwave/run/simulation.h"
#include "rollwave/verify/reference_solution.h"

#include "test_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace rollwave;

namespace {

Solution solved(const std::vector<std::string>& settings) {
  const Parameters parameters = parameters_of(settings);
  return simulate(make_scene(parameters), parameters);
}

double exact_nip(const Scene& scene) {
  return 2 * scene.road.arc_length(find_exact_solution(scene)->half_width);
}

TEST(Nip, GivesBackTheDistanceOfTheExactAnswer) {
  for (const PaperScene& paper : paper_scenes()) {
    const double nip = exact_nip(make_scene(paper.parameters()));
    const Parameters parameters =
        with(paper.parameters(),
             {"Road/Distance=none", "Road/Nip=" + shortest_text(nip), "Mesh/Radial cells=4",
              "Mesh/Angular cells=60", "Mesh/Wanted relative error=2e-3"});
    const Solution solution = simulate(make_scene(parameters), parameters);
    const double uncertainty = solution.result.contact.sum(&ContactPatch::length_uncertainty);
    EXPECT_NEAR(solution.result.road_distance, paper.distance, uncertainty / 2) << paper.figure;
    EXPECT_LT(uncertainty, 1e-2) << paper.figure;
    EXPECT_NEAR(solution.result.contact.length(), nip, 1e-6 * nip) << paper.figure;
    EXPECT_EQ(shortfall_text(solution.result.notes), "") << paper.figure;
    EXPECT_NEAR(find_exact_distance(solution.scene).value_or(0), paper.distance, 1e-8);
  }
}

TEST(Nip, OfARunGivesItsDistanceAgain) {
  for (const std::string setting :
       {"Road/Curvature=1", "Road/Curvature=-0.3", "Cylinder/Radial force=cos(3*z)",
        "Contact/Method=uzawa", "Cylinder/Inner radius=0.9", "Mesh/Degree=4"}) {
    const std::vector<std::string> scene = {"Cylinder/Inner radius=0.5", "Mesh/Radial cells=4",
                                            "Mesh/Angular cells=80", setting};
    std::vector<std::string> by_distance = scene, by_nip = scene;
    by_distance.push_back("Road/Distance=0.93");
    const Result first = solved(by_distance).result;
    by_nip.push_back("Road/Nip=" + shortest_text(first.contact.length()));
    const Result again = solved(by_nip).result;
    EXPECT_NEAR(again.road_distance, 0.93, 1e-6) << setting;
    EXPECT_EQ(again.distance_history.back().distance, again.road_distance);
  }
}

TEST(Nip, IsRefusedIfNoDistanceGivesIt) {
  for (const std::string nip : {"1.8", "50"})
    try {
      solved({"Road/Nip=" + nip, "Mesh/Radial cells=4", "Mesh/Angular cells=48"});
      FAIL() << nip;
    } catch (const BadValue& refused) {
      EXPECT_EQ(refused.section + '/' + refused.key, "Road/Nip");
    }
}

const std::vector<std::string> roller = {"Cylinder/Inner radius=45",
                                         "Cylinder/Outer radius=57",
                                         "Cylinder/Angular velocity=3000/57",
                                         "Material/Width=320",
                                         "Material/Shear modulus=4.5/2.98",
                                         "Material/Density=1.2e-9",
                                         "Road/Nip=14"};

TEST(Nip, AndLoadCalibrateTheShearModulus) {
  const auto plus = [](std::vector<std::string> settings, const std::vector<std::string>& more) {
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
  };
  // The loads are proportional to the shear modulus at the distance of the exact nip.
  Scene exact = make_scene(parameters_of(roller));
  exact = with_distance(exact, *find_exact_distance(exact));
  EXPECT_NEAR(exact_nip(exact) * exact.units.length, 14, 1e-8);
  const double load = find_exact_solution(exact)->loads.vertical * exact.units.of(Quantity::force),
               wanted = 1500 / load * exact.units.material.shear_modulus;
  EXPECT_NEAR(wanted, 3.25, 0.03);

  for (const std::string setting : {"Mesh/Angular cells=400", "Contact/Method=uzawa"}) {
    const Solution solution = solved(
        plus(roller, {"Road/Load=1500", "Mesh/Radial cells=6", "Mesh/Angular cells=300", setting}));
    const MaterialOptions& material = solution.scene.units.material;
    // The load is in proportion to about the square of the nip.
    const ContactResultants& contact = solution.result.contact;
    EXPECT_NEAR(material.shear_modulus / wanted, 1,
                2 * contact.sum(&ContactPatch::length_uncertainty) / contact.length())
        << setting;
    EXPECT_NEAR(material.density / material.shear_modulus, 1.2e-9 * 2.98 / 4.5, 1e-15) << setting;
    EXPECT_NEAR(contact.loads.vertical * solution.scene.units.of(Quantity::force), 1500, 1e-6);
    EXPECT_NEAR(contact.length() * solution.scene.units.length, 14, 1e-4);
    EXPECT_NEAR(*solution.result.modulus_ratio, material.shear_modulus * 2.98 / 4.5, 1e-9);
  }
  const Solution fine =
      solved(plus(roller, {"Road/Load=1500", "Mesh/Radial cells=4", "Mesh/Angular cells=60",
                           "Mesh/Wanted relative error=1e-3"}));
  EXPECT_NEAR(fine.scene.units.material.shear_modulus / wanted, 1, 1e-3);
}

TEST(Nip, AndLoadDoNotCalibrateUnderAForce) {
  EXPECT_THROW(
      make_scene(parameters_of({"Road/Nip=0.3", "Road/Load=0.1", "Cylinder/Radial force=1"})),
      BadValue);
}

TEST(Nip, ReplacesADistanceAndIsReplacedByIt) {
  const auto road_of = [](const std::vector<std::string>& settings) {
    return parameters_of(settings).road;
  };
  EXPECT_FALSE(road_of({"Road/Nip=0.3"}).has_distance());
  EXPECT_TRUE(road_of({"Road/Nip=none", "Road/Distance=0.8"}).has_distance());
  EXPECT_TRUE(road_of({"Road/Nip=0.3", "Road/Load=0.1"}).load);
  const Parameters by_nip = parameters_of({"Road/Nip=0.3", "Road/Load=0.1"});
  Setting distance = {"Road", "Distance", "0.9", "a study"};
  const RoadOptions replaced = with_values(by_nip, {read(distance)}).road;
  EXPECT_TRUE(replaced.has_distance());
  EXPECT_EQ(replaced.distance, 0.9);
  const RoadOptions again =
      with_values(with_values(by_nip, {read(distance)}), {read({"Road", "Nip", "0.2", "a run"})})
          .road;
  EXPECT_EQ(again.nip, 0.2);
  EXPECT_FALSE(again.load);
}

} // namespace
