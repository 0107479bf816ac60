// A scene in the user's units is the scene with radius, shear modulus, wave speed and width 1.
#include "own_path.h"
#include "rollwave/base/errors.h"
#include "rollwave/output/screen_report.h"
#include "rollwave/run/quantities.h"
#include "rollwave/run/simulation.h"
#include "rollwave/scene/units.h"
#include "rollwave/study/study_csv.h"
#include "rollwave/study/study_runner.h"
#include "rollwave/verify/reference_solution.h"
#include "rollwave/verify/true_errors.h"
#include "test_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <regex>
#include <sstream>

using namespace rollwave;

namespace {

constexpr double b = 0.035, mu = 5e5, rho = 1100, width = 0.3; // in SI units
const double wave_speed = std::sqrt(mu / rho), force_unit = mu * width * b;

/// The cylinder with a = b / 2 on a small mesh in SI units, or with b = 1.
std::vector<std::string> cylinder(bool is_si, double omega_b) {
  std::vector<std::string> settings = {
      assignment("Cylinder/Inner radius", is_si ? b / 2 : 0.5),
      assignment("Cylinder/Outer radius", is_si ? b : 1),
      assignment("Cylinder/Angular velocity", is_si ? omega_b * wave_speed / b : omega_b),
      "Mesh/Radial cells=4", "Mesh/Angular cells=60"};
  if (is_si)
    settings.insert(settings.end(),
                    {assignment("Material/Shear modulus", mu), assignment("Material/Density", rho),
                     assignment("Material/Width", width), "Output/Unit names=m, s, N"});
  return settings;
}

using Values = std::map<std::string, double>;

Solution solve(std::vector<std::string> settings, const std::vector<std::string>& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  const Parameters parameters = parameters_of(settings);
  Solution solution = simulate(make_scene(parameters), parameters);
  if (const auto exact = find_exact_solution(solution.scene))
    solution.result.errors = measure_true_errors(solution, *exact);
  return solution;
}

Values values_of(const Solution& solution) {
  return rollwave::values_of(solution.result, solution.scene.units);
}

/// The SI unit of a quantity over that with b = mu = wave speed = width = 1.
double si_unit(Quantity quantity) {
  static const std::map<Quantity, double> units = {
      {Quantity::length, b},
      {Quantity::area, b * b},
      {Quantity::pressure, mu},
      {Quantity::pressure_norm, mu * std::sqrt(b)},
      {Quantity::force, force_unit},
      {Quantity::force_density, mu / b},
      {Quantity::stiffness, mu * width},
      {Quantity::energy, force_unit * b},
      {Quantity::energy_norm, std::sqrt(force_unit * b)}};
  const auto unit = units.find(quantity);
  return unit == units.end() ? 1 : unit->second;
}

/// Expects the same numbers in units of each other, small differences of large ones less
/// accurately.
void expect_same(const Values& si, const Values& one) {
  for (const auto& [name, value] : one) {
    if (std::regex_search(name, std::regex("^(work|seconds|peak_memory_mib|residuals)")))
      continue;
    const bool is_small = name.rfind("error.", 0) == 0;
    const double scale = std::abs(value) + (is_small ? 0 : std::abs(one.at("contact.force")));
    EXPECT_NEAR(si.at(name) / si_unit(result_quantity(name).quantity), value,
                (is_small ? 1e-6 : 1e-10) * scale)
        << name;
  }
}

TEST(Units, GiveTheSameSceneAtEverySpeed) {
  for (const double omega_b : {0., 0.5, 1.}) {
    SCOPED_TRACE(omega_b);
    expect_same(values_of(solve(cylinder(true, omega_b), {assignment("Road/Distance", 0.8 * b)})),
                values_of(solve(cylinder(false, omega_b), {"Road/Distance=0.8"})));
  }
}

TEST(Units, HoldForAForceThatIsAnExpression) {
  const std::string f = "0.3 + 0.5*r*cos(z)";
  const std::string in_si =
      shortest_text(mu / b) + " * (0.3 + 0.5*(r/" + shortest_text(b) + ")*cos(z))";
  expect_same(
      values_of(solve(cylinder(true, 0.5),
                      {assignment("Road/Distance", 0.8 * b), "Cylinder/Radial force=" + in_si})),
      values_of(solve(cylinder(false, 0.5), {"Road/Distance=0.8", "Cylinder/Radial force=" + f})));
}

TEST(Units, HoldForALoadOnADrum) {
  expect_same(values_of(solve(cylinder(true, 0.5), {assignment("Road/Load", 0.3 * force_unit),
                                                    assignment("Road/Curvature", 0.5 / b)})),
              values_of(solve(cylinder(false, 0.5), {"Road/Load=0.3", "Road/Curvature=0.5"})));
}

TEST(Units, HoldForUzawasStepLength) {
  const auto with_rho = [&](double rho, double distance) {
    return std::vector<std::string>{"Contact/Method=uzawa", assignment("Contact/Rho", rho),
                                    assignment("Road/Distance", distance)};
  };
  const Values si = values_of(solve(cylinder(true, 0.5), with_rho(2 * mu / b, 0.8 * b)));
  expect_same(si, values_of(solve(cylinder(false, 0.5), with_rho(2, 0.8))));
  EXPECT_NEAR(si.at("iterations.rho") / (mu / b), 2, 1e-14);
}

TEST(Units, HoldForTheRowsOfAStudy) {
  const auto rows = [](bool is_si) {
    auto settings = cylinder(is_si, 0.5);
    const double unit = is_si ? b : 1;
    settings.push_back("Study/Vary=Road/Distance = " + shortest_text(0.9 * unit) + " | " +
                       shortest_text(0.7 * unit));
    Parameters parameters = parameters_of(settings);
    parameters.output.directory = own_path().string();
    std::filesystem::remove_all(own_path());
    std::filesystem::create_directory(own_path());
    std::ostringstream out;
    Study study = plan_study(parameters);
    run_study(study, parameters, out);
    std::filesystem::remove_all(own_path());
    return study;
  };
  const Study si = rows(true), one = rows(false);
  for (unsigned int run = 0; run < 2; ++run)
    expect_same(si.runs[run]->values, one.runs[run]->values);
  EXPECT_NE(study_csv(si).find("contact.vertical_load [N]"), std::string::npos);
}

TEST(Units, NameTheCriticalSpeedThatIsExceeded) {
  const std::string distance = assignment("Road/Distance", 0.8 * b);
  auto settings = cylinder(true, 1);
  settings.push_back(distance);
  EXPECT_NO_THROW(make_scene(parameters_of(settings)));
  settings = cylinder(true, 1.0000001);
  settings.push_back(distance);
  try {
    make_scene(parameters_of(settings));
    FAIL();
  } catch (const BadValue& refused) {
    EXPECT_EQ(refused.key, "Angular velocity");
    std::ostringstream critical;
    critical.precision(9);
    critical << wave_speed / b;
    EXPECT_NE(refused.reason.find(critical.str().substr(0, 9)), std::string::npos)
        << refused.reason;
  }
}

TEST(Units, FollowTheNumbersOnTheScreen) {
  auto settings = cylinder(true, 0.5);
  settings.push_back(assignment("Road/Distance", 0.8 * b));
  const Parameters parameters = parameters_of(settings);
  const Scene scene = make_scene(parameters);
  std::ostringstream screen;
  report_scene(screen, scene, parameters);
  report_result(screen, solve(settings, {}).result, scene.units);
  for (const char* const part :
       {"b = 0.035 m", " rad/s", " N/m^2\n", " N/m\n", " N m\n", "(N m)^(1/2)"})
    EXPECT_NE(screen.str().find(part), std::string::npos) << part << '\n' << screen.str();
}

TEST(Units, AreRefusedUnlessPositiveAndFinite) {
  for (const char* const key : {"Shear modulus", "Density", "Width"})
    for (const char* const value : {"0", "-1", "inf", "nan", "1e31"})
      EXPECT_THROW(parameters_of({std::string("Material/") + key + '=' + value}), BadInput);
  for (const char* const names : {"m", "m, s, N, K", "m, , N", "m, s, <N>"})
    EXPECT_THROW(parameters_of({std::string("Output/Unit names=") + names}), BadInput);
}

TEST(Units, NamesOfFieldsHaveLettersThatAllReadersTake) {
  Units units;
  units.material.unit_names = {"mm", "s", "N"};
  for (const Quantity quantity :
       {Quantity::angle, Quantity::length, Quantity::pressure, Quantity::angular_velocity,
        Quantity::force, Quantity::energy, Quantity::energy_norm, Quantity::number})
    EXPECT_TRUE(std::regex_match(units.as_suffix(quantity), std::regex("(_[A-Za-z0-9]+)*")))
        << units.as_suffix(quantity);
  EXPECT_EQ(units.as_suffix(Quantity::pressure), "_N_per_mm2");
  EXPECT_EQ(units.as_suffix(Quantity::energy_norm), "_root_N_mm");
  EXPECT_EQ(Units().as_suffix(Quantity::length), "");
}

} // namespace
