// Every number of a result is the same by both contact methods, by both kinds of linear solver and
// on many processes.
#include "quantities.h"

#include "rollwave/base/text.h"
#include "rollwave/output/summary_json.h"
#include "test_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace rollwave;

namespace {

struct NamedScene {
  std::string name;
  std::vector<std::string> settings;
};

std::vector<NamedScene> scenes() {
  std::vector<NamedScene> scenes = {
      {"drum", {"Road/Curvature=1"}},
      {"inside of a drum", {"Road/Curvature=-0.5"}},
      {"two patches",
       {"Cylinder/Radial force=-8*exp(-((z-4.71238898)/0.12)^2)", "Mesh/Angular cells=120"}},
      {"cut zone", {"Road/Contact zone=4.5, 4.9", "Mesh/Degree=1"}},
      {"vertical load", {"Road/Load=0.25", "Mesh/Degree=3"}},
      {"total load", {"Road/Load=0.25", "Road/Load kind=total"}},
      {"units",
       {"Material/Density=1.1e-9", "Material/Width=200", "Cylinder/Inner radius=17.5",
        "Cylinder/Outer radius=35", "Cylinder/Angular velocity=86", "Road/Load=800"}},
      {"adaptive mesh", {"Mesh/Adaptive cycles=2"}},
      {"no contact", {"Road/Distance=1.2", "Cylinder/Radial force=0.1"}}};
  for (const PaperScene& paper : paper_scenes())
    scenes.push_back({"figure " + std::to_string(paper.figure),
                      {assignment("Cylinder/Angular velocity", paper.angular_velocity),
                       assignment("Cylinder/Radial force", paper.force_density),
                       assignment("Road/Distance", paper.distance)}});
  return scenes;
}

nlohmann::json summary_of(const Parameters& parameters) {
  const Scene scene = make_scene(parameters);
  const Result result = simulate(scene, parameters).result;
  return quantities_of(nlohmann::json::parse(summary_json(scene, parameters, result)));
}

TEST(Quantities, AreThoseOfEveryMethod) {
  for (const auto& [name, settings] : scenes()) {
    const Parameters parameters =
        with(parameters_of({"Mesh/Radial cells=3", "Mesh/Angular cells=60"}), settings);
    const nlohmann::json expected = summary_of(parameters);
    SCOPED_TRACE(name + ", Uzawa");
    expect_same_quantities(summary_of(with(parameters, {"Contact/Method=uzawa"})), expected,
                           tolerance_of_uzawa);
  }
}

// The steps of the active set method have no residual.
TEST(Quantities, ComeWithTheHistoryOfTheContactSteps) {
  for (const char* method : {"active set", "uzawa"}) {
    const Parameters parameters = parameters_of(
        {"Mesh/Radial cells=3", "Mesh/Angular cells=60", std::string("Contact/Method=") + method});
    const Scene scene = make_scene(parameters);
    const Result result = simulate(scene, parameters).result;
    const nlohmann::json summary = nlohmann::json::parse(summary_json(scene, parameters, result)),
                         iterations = summary["iterations"], history = iterations["history"];
    const std::size_t n = iterations["contact"];
    EXPECT_EQ(history["active"].size(), n);
    EXPECT_EQ(history["changed"].size(), n);
    EXPECT_EQ(history["active"].back(), summary["contact"]["active_nodes"]);
    EXPECT_EQ(history["changed"].back(), 0);
    const bool is_uzawa = method == std::string("uzawa");
    EXPECT_EQ(history.contains("residual"), is_uzawa);
    EXPECT_EQ(iterations["largest_rho"].is_null(), !is_uzawa);
    if (is_uzawa) {
      EXPECT_LE(history["residual"].back(), parameters.contact.tolerance);
      EXPECT_LT(iterations["rho"], iterations["safe_rho"]);
      EXPECT_LT(iterations["safe_rho"], iterations["largest_rho"]);
    }
  }
}

// A bound of few digits is still a bound, and no further away than its last digit.
TEST(Rounding, KeepsBounds) {
  for (const double number :
       {1886.724657, 1886.7255941, 0.00070525, 0.001, 5e-9, 1., 9.9999, 123e10})
    for (const double sign : {1., -1.})
      for (const int digits : {1, 3, 9}) {
        const double x = sign * number, up = std::stod(rounded_up(x, digits)),
                     down = std::stod(rounded_down(x, digits)),
                     last_digit = std::pow(10., std::floor(std::log10(number)) + 1 - digits);
        EXPECT_LE(x, up);
        EXPECT_GE(x, down);
        EXPECT_LE(up - down, last_digit * (1 + 1e-6));
      }
  EXPECT_EQ(rounded_up(0.001, 3), "0.001");
  EXPECT_EQ(rounded_down(0, 3), "0");
}

// What is left out is less than half of the uncertainty, and the uncertainty does not shrink.
TEST(Rounding, FollowsTheUncertainty) {
  for (const double number : {0.8937, 1886.724657, 5.4e-13, 3.2e21, 0.})
    for (const double relative : {1.2, 0.096, 0.0153, 1e-4, 9.99e-6})
      for (const double sign : {1., -1.}) {
        const double x = sign * number, uncertainty = relative * std::max(number, 1e-20);
        const std::string text = with_uncertainty(x, uncertainty);
        const double shown = std::stod(text.substr(text.find("+-") + 2));
        EXPECT_GE(shown, uncertainty * (1 - 1e-12)) << text;
        EXPECT_LE(shown, uncertainty * 1.5) << text;
        EXPECT_NEAR(std::stod(text), x, uncertainty / 2) << text;
        EXPECT_EQ(text.find(rounded_by(x, uncertainty)), 0u) << text;
      }
  EXPECT_EQ(with_uncertainty(0.8937, 0.053), "0.89 +- 0.06");
  EXPECT_EQ(with_uncertainty(0.8937, 0.0123), "0.894 +- 0.013");
  EXPECT_EQ(with_uncertainty(5147, 213), "5100 +- 300");
  EXPECT_EQ(with_uncertainty(0.8, 0.006), "0.800 +- 0.006");
}

} // namespace
