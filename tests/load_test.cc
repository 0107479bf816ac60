// The load of forces that jump on straight lines is exact, and what follows from that.
#include "assembly.h"
#include "errors.h"
#include "floating_point.h"
#include "load_breaks.h"
#include "scene.h"
#include "test_scenes.h"

#include <deal.II/base/function_lib.h>
#include <deal.II/base/numbers.h>
#include <deal.II/numerics/vector_tools.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace rollwave;
using dealii::numbers::PI;

namespace {

constexpr double hub = 0.5, surface = 1;

/// Figure 4 under another force.
Parameters under(const std::string& force, const std::vector<std::string>& settings) {
  return with(with(paper_scenes()[0].parameters(), {"Cylinder/Radial force=" + force}), settings);
}

LoadBreaks breaks_of(const std::string& force, unsigned int n_cells = 960) {
  return find_load_breaks(make_scene(under(force, {})), n_cells, MPI_COMM_SELF);
}

using Places = std::vector<double>;

} // namespace

TEST(LoadBreaks, AreWhereTheForceJumpsOnStraightLines) {
  for (const unsigned int n_cells : {48, 960, 100000}) {
    const LoadBreaks breaks =
        breaks_of("if(z<2,1,-1)+if(r<0.7123,0,r)+if(r<0.875,2,0)*if(z<5.1,1,3)", n_cells);
    EXPECT_EQ(breaks.radii, Places({0.7123, 0.875}));
    EXPECT_EQ(breaks.angles, Places({0, 2, 5.1}));
  }
  // Only on a part of the ring
  const LoadBreaks sector = breaks_of("if(r<0.7,0,if(abs(z-3)<0.5,1,0))", 10000);
  EXPECT_EQ(sector.radii, Places({0.7}));
  EXPECT_EQ(sector.angles.size(), 2u);
  // In a skin of two cells, and beside the period
  EXPECT_EQ(breaks_of("if(r>0.9,z,0)", 1200).angles, Places({0}));
  EXPECT_EQ(breaks_of("if(z<6.28,1,-5)", 1200).angles, Places({0, 6.28}));
}

TEST(LoadBreaks, AreNoneWhereNothingJumpsOrOnACurve) {
  for (const std::string force : {"r + sin(z)", "cos(z)", "abs(z-pi)+abs(r-0.7)", "1+0*z",
                                  "if(r<0.7+0.1*sin(3*z),1,0)", "if((r-0.7)^2+(z-2)^2<0.01,1,0)"}) {
    const LoadBreaks breaks = breaks_of(force);
    EXPECT_TRUE(breaks.radii.empty()) << force;
    EXPECT_TRUE(breaks.angles.empty()) << force;
  }
}

// Lines of the mesh, its seam and the period of f as well.
TEST(LoadBreaks, AreFoundWhereverTheyAre) {
  for (int i = 1; i < 96; ++i)
    for (const double offset : {1e-15, 1e-9, 0.01}) {
      const double place = 2 * PI * i / 96 + offset;
      const Places angles =
          breaks_of("if(z<" + dealii::Utilities::to_string(place) + ",1,-1)").angles;
      ASSERT_EQ(angles.size(), 2u) << place;
    }
}

TEST(LoadBreaks, CutIntervals) {
  const LoadBreaks breaks = {{0.7, 0.8}, {0, 2}};
  EXPECT_EQ(breaks.radial_ends(0.5, 1), Places({0.5, 0.7, 0.8, 1}));
  EXPECT_EQ(breaks.radial_ends(0.7, 0.8), Places({0.7, 0.8}));
  EXPECT_EQ(breaks.angular_ends(1, 1.5), Places({1, 1.5}));
  // A ring from pi/2 to 5 pi/2
  EXPECT_EQ(breaks.angular_ends(1.9, 2 * PI + 2.5),
            Places({1.9, 2, 2 * PI, 2 * PI + 2, 2 * PI + 2.5}));
}

// (f, w) = int r f w dr dz for w = r - hub, for which the rule is exact on parts without a jump.
TEST(Load, IsExactWhereTheForceJumps) {
  const auto moment = [](double begin, double end) { // int r (r - hub) dr
    return (std::pow(end, 3) - std::pow(begin, 3)) / 3 - hub * (end * end - begin * begin) / 2;
  };
  for (const std::string degree : {"1", "2", "3"})
    for (const std::string cells : {"3", "10", "17"}) {
      const Parameters parameters =
          under("if(z<2.3,1,-1)*if(r<0.7123,1,3)",
                {"Mesh/Degree=" + degree, "Mesh/Radial cells=" + cells, "Mesh/Angular cells=50"});
      const Scene scene = make_scene(parameters);
      const Discretisation ring(scene, parameters);
      FieldVector w = ring.space.make_field();
      dealii::VectorTools::interpolate(
          ring.space.mapping(), ring.space.dof_handler(),
          dealii::ScalarFunctionFromFunctionObject<2>([](const auto& x) { return x[0] - hub; }), w);
      const double expected =
          (2.3 - (2 * PI - 2.3)) * (moment(hub, 0.7123) + 3 * moment(0.7123, surface));
      EXPECT_NEAR(assemble_load(ring.space, scene).vector * w / expected, 1, 1e-13);
    }
}

TEST(Load, IsRefusedWithThePlaceOfAForceThatIsNotFinite) {
  const UntrappedFloatingPoint untrapped;
  const Parameters parameters = under("if(z<3,1/(r-r),1)", {});
  try {
    simulate(make_scene(parameters), parameters);
    ADD_FAILURE() << "accepted";
  } catch (const BadInput& error) {
    EXPECT_NE(
        std::string(error.what())
            .find("key \"Radial force\", value \"if(z<3,1/(r-r),1)\": it is not finite at r = "),
        std::string::npos)
        << error.what();
  }
}

TEST(Load, RefusesAForceThatIsNotFiniteOnAPartOfACell) {
  const UntrappedFloatingPoint root_of_a_negative_number;
  const Parameters parameters = under("if(z<2,1,-1)+if(abs(z-1.9948)<1e-4,sqrt(-1),0)",
                                      {"Mesh/Radial cells=20", "Mesh/Angular cells=480"});
  const Scene scene = make_scene(parameters);
  const Discretisation ring(scene, parameters);
  EXPECT_THROW(assemble_load(ring.space, scene), BadInput);
}

// The solution's second derivatives jump with the force: quadratic elements are of order 3/2 in the
// energy norm on meshes whose lines the jump never meets, and the bound shows it.
TEST(Load, KeepsTheOrderOfUniformMeshes) {
  for (const std::string force : {"if(z<2,1,-1)", "if(r<0.7123,1,r)"}) {
    const auto error_with = [&](int cells) {
      const Parameters parameters =
          under(force,
                {"Mesh/Degree=2", "Road/Distance=1.5", "Mesh/Radial cells=" + std::to_string(cells),
                 "Mesh/Angular cells=" + std::to_string(12 * cells)});
      return simulate(make_scene(parameters), parameters).result.certified->energy_norm;
    };
    // Over enough meshes that it hardly matters where in a cell the jump is.
    EXPECT_GT(std::log(error_with(5) / error_with(80)) / std::log(16), 1.4) << force;
  }
}
