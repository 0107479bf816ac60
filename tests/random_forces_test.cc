// Enclosures of J under forces that are expressions, with strips, spots, jumps and kinks: what two
// meshes certify about one scene cannot be disjoint.
#include "draw.h"
#include "rollwave/run/simulation.h"
#include "test_scenes.h"

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

using namespace rollwave;

namespace {

std::string format(const char* pattern, const std::vector<double>& numbers) {
  std::string text;
  auto number = numbers.begin();
  for (const char* c = pattern; *c; ++c) {
    char digits[32] = {*c, 0};
    if (*c == '#')
      std::snprintf(digits, sizeof digits, "%.6g", *number++);
    text += digits;
  }
  return text;
}

/// A force on [a, 1], of which nothing is smaller than a cell of this height and length.
std::string draw_term(Draw& draw, double a, double height, double length) {
  const double factor = draw.one_of<double>({1, -1, 0.3, 3});
  const double r = draw.number(a, 1), z = draw.number(0, 2 * dealii::numbers::PI);
  const double half_height = draw.number(height, 0.5 * (1 - a) + height);
  const double half_length = length * std::pow(10, draw.number(0, 1));
  switch (draw.count(0, 6)) {
  case 0:
    return format("#*if(abs(z-#)<#,1,0)", {factor, z, half_length});
  case 1:
    return format("#*if(r<#,1,0)", {factor, r});
  case 2:
    return format("#*if(((r-#)/#)^2+((z-#)/#)^2<1,1,0)", {factor, r, half_height, z, half_length});
  case 3:
    return format("#*if(r<#+#*sin(#*z),1,0)",
                  {factor, (1 + a) / 2, (1 - a) / 4, double(draw.count(1, 5))});
  case 4:
    return format("#*abs(sin(#*z+r))*r", {factor, double(draw.count(1, 6))});
  case 5:
    return format("#*exp(-((z-#)/#)^2)", {factor, z, half_length});
  default:
    return format("#*floor(#*r)/5", {factor, double(draw.count(2, 9))});
  }
}

} // namespace

TEST(RandomForces, HaveEnclosuresOfTheEnergyThatMeet) {
  Draw draw(3);
  double narrowed = 0;
  const int n_scenes = n_random_scenes(24);
  for (int i = 0; i < n_scenes; ++i) {
    const double a = draw.one_of<double>({0.05, 0.2, 0.5, 0.5, 0.9, 0.99});
    const int degree = draw.count(1, 4), radial = draw.count(3, 16) / degree + 1,
              angular = draw.count(24, 160) / degree + 8;
    std::string force = a < 0.9 ? "0" : "10*(0";
    for (int term = draw.count(1, 3); term > 0; --term)
      force += "+" + draw_term(draw, a, (1 - a) / radial, 2 * dealii::numbers::PI / angular);
    force += a < 0.9 ? "" : ")";
    const std::vector<std::string> common = {
        "Cylinder/Inner radius=" + std::to_string(a),
        "Cylinder/Angular velocity=" + draw.one_of<std::string>({"0", "0.5", "0.9", "1"}),
        "Road/Distance=" + draw.one_of<std::string>({a < 0.8 ? "0.85" : "0.995", "1", "1.3"}),
        "Mesh/Degree=" + std::to_string(degree), "Cylinder/Radial force=" + force};
    const int cycles = draw.count(0, 3);
    const auto certify = [&](int factor) {
      std::vector<std::string> settings = common;
      settings.push_back("Mesh/Adaptive cycles=" + std::to_string(cycles));
      settings.push_back("Mesh/Radial cells=" + std::to_string(factor * radial));
      settings.push_back("Mesh/Angular cells=" + std::to_string(factor * angular + factor - 1));
      const Parameters parameters = parameters_of(settings);
      return *simulate(make_scene(parameters), parameters).result.certified;
    };
    const CertifiedError coarse = certify(1), fine = certify(4);
    EXPECT_LE(coarse.lower_bound, fine.upper_bound) << i << " a = " << a << " " << force;
    EXPECT_GE(coarse.upper_bound, fine.lower_bound) << i << " a = " << a << " " << force;
    // delta goes with h^(1/2) where a force jumps along z: to a half.
    narrowed +=
        (fine.upper_bound - fine.lower_bound) < 0.6 * (coarse.upper_bound - coarse.lower_bound);
  }
  EXPECT_GT(narrowed, 0.75 * n_scenes);
}
