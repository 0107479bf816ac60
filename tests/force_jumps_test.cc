// Jumps of a force along straight lines, and the kinks of the potential that follow from them.
#include "force_jumps.h"
#include "force_on_mesh.h"
#include "potential_kinks.h"
#include "simulation.h"
#include "straight_jump.h"

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

using namespace rollwave;
using dealii::numbers::PI;

namespace {

std::optional<double> find_jump(const std::string& force, unsigned int direction) {
  const Scene scene =
      make_scene(with(paper_scenes()[0].parameters(), {"Cylinder/Radial force=" + force}));
  return straight_jump(scene, {scene.inner_radius, 0}, {scene.outer_radius, 2 * PI}, direction);
}

} // namespace

TEST(StraightJump, IsFoundBetweenNeighbouringNumbers) {
  EXPECT_EQ(find_jump("if(z<2,1,-1)", 1), 2.);
  EXPECT_EQ(find_jump("if(z<=2,1,-1)", 1), std::nextafter(2., 3.));
  EXPECT_EQ(find_jump("if(r<0.7123,1,0)+sin(z)", 0), 0.7123);
  // On a part of the panel, and beside what is smooth.
  EXPECT_EQ(find_jump("if(z>=4.4,r,0)*if(r>0.65,1,0)", 1), 4.4);
  EXPECT_EQ(find_jump("r*cos(z)+if(z<5.1,0,3)", 1), 5.1);
  // The greater one of two
  EXPECT_EQ(find_jump("if(z<2,0,1)+if(z<5,0,2)", 1), 5.);
  // Where f is the mean of both sides at the place itself, and two between the same points
  EXPECT_NEAR(find_jump("sign(2-z)", 1).value(), 2, 1e-15);
  EXPECT_TRUE(find_jump("if(z<2,0,1)+if(z<2.01,0,1)", 1));
  // The middle one of many
  EXPECT_EQ(find_jump("floor(z)", 1), 3.);
}

TEST(StraightJump, IsNoneWhereAForceIsContinuousOrJumpsOnACurve) {
  for (const unsigned int direction : {0, 1})
    for (const std::string force :
         {"1+0*z", "r*sin(3*z)", "abs(z-2)+abs(r-0.7)", "exp(50*(r-1))*cos(40*z)",
          "if(r<0.7+0.1*sin(3*z),1,0)", "if(z<2+r,1,-1)", "if((r-0.7)^2+(z-2)^2<0.01,1,0)"})
      EXPECT_FALSE(find_jump(force, direction)) << force << " " << direction;
  // Only across the direction
  EXPECT_FALSE(find_jump("if(z<2,1,-1)", 0));
  EXPECT_FALSE(find_jump("if(r<0.7,1,-1)", 1));
}

TEST(ForceJumps, AreWhereTheForceJumpsAlongZ) {
  const auto jumps_of = [](const std::string& force) {
    const Force on_mesh(force, 8, 96);
    return on_mesh.interpolant.jumps(on_mesh.scene);
  };
  EXPECT_EQ(jumps_of("if(z<2,1,-1)"), std::vector<double>({0, 2}));
  // Where panels end anyway
  EXPECT_EQ(jumps_of("if(abs(z-pi)<=1,if(z<pi,1,2),0)").size(), 3u);
  EXPECT_EQ(jumps_of("z"), std::vector<double>({0}));
  // Near the surface only, where panels were halved
  EXPECT_EQ(jumps_of("if(r>0.96,z,0)"), std::vector<double>({0}));
  EXPECT_EQ(jumps_of("r^20*if(z<pi,1,-1)"), std::vector<double>({0, PI}));
  for (const std::string force : {"sin(3*z)*r", "if(r<0.7123,1,0)", "if(r<0.7+0.1*sin(3*z),1,0)"})
    EXPECT_TRUE(jumps_of(force).empty()) << force;
}

TEST(ForceJumps, LeaveNothingOutOfAForceThatIsSmoothBetweenThem) {
  for (const std::string force : {"if(z<2,1,-1)", "if(r<0.7123,1,r)", "if(abs(z-3.3)<0.4,r,z/9)"})
    EXPECT_LT(Force(force, 4, 48).interpolant.error(), 1e-8) << force;
}

TEST(PotentialKinks, TakeTheJumpOfG) {
  const Force force("if(z<2,1,-1)", 8, 96);
  const ForceJumps jumps(force.interpolant, force.scene, force.extents);
  const std::vector<double> radii = {0.5, 0.6, 0.8, 1};
  // Cells much shorter than the ring is high: nearly all.
  ASSERT_EQ(jumps.within(1.9, 2.1).size(), 1u);
  const double share = jumps.within(1.9, 2.1)[0].second->share;
  EXPECT_GT(share, 0.99);
  EXPECT_LE(share, 1);
  for (const double turn : {0., 2 * PI}) {
    const double begin = turn + 1.95, end = turn + 2.02;
    const PotentialKinks kinks(jumps, begin, end, radii);
    const auto derivatives_at = [&](double t) {
      std::vector<double> values(4), derivatives(4);
      kinks.add_to(t, values.data(), derivatives.data());
      return derivatives;
    };
    const double t = (2 - 1.95) / 0.07;
    const auto before = derivatives_at(t - 1e-6), after = derivatives_at(t + 1e-6);
    for (unsigned int i = 0; i < radii.size(); ++i)
      EXPECT_NEAR(after[i] - before[i], -share * (1 - radii[i] * radii[i]), 1e-12);
    for (const double end_of_cell : {0., 1.}) {
      std::vector<double> values(4), derivatives(4);
      kinks.add_to(end_of_cell, values.data(), derivatives.data());
      for (const double value : values)
        EXPECT_NEAR(value, 0, 1e-15);
    }
  }
}

TEST(PotentialKinks, DifferFromThoseOfAHalfByALinearFunction) {
  const Force force("if(z<2,1,-1)+if(z<2.03,r,0)", 8, 96);
  const ForceJumps jumps(force.interpolant, force.scene, force.extents);
  const auto value = [&](double z, double begin, double end) {
    double values = 0, derivatives = 0;
    PotentialKinks(jumps, begin, end, {0.6})
        .add_to((z - begin) / (end - begin), &values, &derivatives);
    return values;
  };
  for (const double begin : {1.9, 2., 2.1}) { // of the halves
    const double end = begin + 0.1;
    for (const double whole_begin : {begin - 0.1, begin}) {
      const auto difference = [&](double z) {
        return value(z, whole_begin, whole_begin + 0.2) - value(z, begin, end);
      };
      for (const double share : {0.2, 0.5, 0.7})
        EXPECT_NEAR(difference(begin + share * 0.1),
                    (1 - share) * difference(begin) + share * difference(end), 1e-15);
    }
  }
}

// On cells of a thin ring that are much longer than it is high a kink costs more than it saves.
TEST(PotentialKinks, TakeLittleInLongCells) {
  const Parameters parameters =
      parameters_of({"Cylinder/Inner radius=0.999", "Cylinder/Radial force=if(z<2,1,-1)",
                     "Road/Distance=1.1", "Mesh/Radial cells=2", "Mesh/Angular cells=50"});
  const Scene scene = make_scene(parameters);
  const Discretisation mesh(scene, parameters);
  const RadialExtents extents(mesh.space);
  const ForceInterpolant interpolant(mesh.space, scene, assemble_load(mesh.space, scene).moments,
                                     extents);
  const ForceJumps jumps(interpolant, scene, extents);
  ASSERT_EQ(jumps.within(1.9, 2.1).size(), 1u);
  EXPECT_LT(jumps.within(1.9, 2.1)[0].second->share, 0.01);
}

// On uniform meshes, and where cells of different lengths meet on the line of the jump.
TEST(PotentialKinks, MakeTheBoundSharp) {
  const auto certify = [](const std::vector<std::string>& settings) {
    Parameters parameters =
        with(paper_scenes()[0].parameters(), {"Cylinder/Radial force=if(z<2,1,-1)"});
    parameters = with(parameters, settings);
    return *simulate(make_scene(parameters), parameters).result.certified;
  };
  const CertifiedError fine =
      certify({"Mesh/Degree=3", "Mesh/Radial cells=8", "Mesh/Angular cells=240",
               "Mesh/Adaptive cycles=30", "Mesh/Most unknowns=60000"});
  for (const std::string degree : {"1", "2"})
    for (const std::string cycles : {"0", "2", "4", "6"}) {
      const CertifiedError coarse =
          certify({"Mesh/Degree=" + degree, "Mesh/Radial cells=4", "Mesh/Angular cells=50",
                   "Mesh/Adaptive cycles=" + cycles});
      EXPECT_LE(coarse.lower_bound, fine.upper_bound);
      EXPECT_GE(coarse.upper_bound, fine.lower_bound);
      const double gap = coarse.upper_bound - fine.upper_bound;
      const double effectivity = coarse.energy_norm / std::sqrt(2 * gap);
      EXPECT_LT(effectivity, 1.5);
    }
}
