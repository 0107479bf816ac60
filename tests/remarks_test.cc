// Remarks say what the figures do not show, and are left out where there is nothing to say.
#include "rollwave/run/simulation.h"
#include "test_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

using namespace rollwave;

namespace {

/// The remarks on figure 4 with 8 x 100 cells and these settings.
std::vector<std::string> remarks_with(const std::vector<std::string>& settings) {
  const Parameters parameters =
      with(with(paper_scenes()[0].parameters(), {"Mesh/Radial cells=8", "Mesh/Angular cells=100"}),
           settings);
  return texts_of(simulate(make_scene(parameters), parameters).result.notes, Note::Kind::remark);
}

bool have(const std::vector<std::string>& remarks, const std::string& text) {
  return std::any_of(remarks.begin(), remarks.end(), [&](const std::string& remark) {
    return remark.find(text) != std::string::npos;
  });
}

TEST(Remarks, AreAbsentForOrdinaryScenes) {
  for (const char* distance : {"0.9", "0.95", "1.1"})
    EXPECT_TRUE(remarks_with({std::string("Road/Distance=") + distance}).empty()) << distance;
  // Wider than contact is, the zone changes nothing.
  EXPECT_TRUE(remarks_with({"Road/Distance=0.9", "Road/Contact zone=3.9, 5.6"}).empty());
  EXPECT_TRUE(remarks_with({"Cylinder/Outer radius=1 + 1/4", "Road/Distance=1.1",
                            "Cylinder/Angular velocity=1/(1 + 1/4)", "Road/Curvature=2"})
                  .empty());
}

TEST(Remarks, GiveThePenetrationOutsideOfTheZone) {
  // Where nothing presses on it the surface stays where it was: u = 0, phi = c - b at the lowest
  // point.
  const auto outside = remarks_with({"Road/Contact zone=5.5, 6"});
  EXPECT_TRUE(have(outside, "penetrates the road by 0.2 b"));
  const auto cut = remarks_with({"Road/Contact zone=4.5, 5"});
  EXPECT_TRUE(have(cut, "penetrates the road by"));
  EXPECT_TRUE(have(cut, "cuts the contact short"));
  // At one end of a zone that reaches beyond the tangent of a drum at the other.
  EXPECT_TRUE(have(remarks_with({"Road/Curvature=1", "Road/Contact zone=4.612, 6.1"}),
                   "cuts the contact short"));
}

TEST(Remarks, WarnBeyondTheLinearModel) {
  // The displacement is at least 1 - c at the lowest point; a quarter of the thickness is 0.125.
  for (const char* setting :
       {"Road/Distance=0.55", "Road/Distance=0.87", "Cylinder/Radial force=10"})
    EXPECT_TRUE(have(remarks_with({setting}), "linear model")) << setting;
  EXPECT_FALSE(have(remarks_with({"Road/Distance=0.88"}), "linear model"));
  EXPECT_TRUE(have(remarks_with({"Cylinder/Radial force=100"}), "the end of the automatic zone"));
}

TEST(Remarks, WarnWhereANumberIsLikelyToBeMeantOtherwise) {
  EXPECT_TRUE(have(remarks_with({"Road/Curvature=10.1"}), "one over the radius"));
  EXPECT_FALSE(have(remarks_with({"Road/Curvature=9.9"}), "one over the radius"));
  EXPECT_FALSE(have(remarks_with({"Road/Curvature=-0.9"}), "one over the radius"));
  const auto rounded_up = remarks_with(
      {"Cylinder/Outer radius=0.7", "Road/Distance=0.65", "Cylinder/Angular velocity=1.42857143"});
  EXPECT_TRUE(have(rounded_up, "1.42857142857")); // 1/0.7
}

TEST(Remarks, WarnIfTheMeshDoesNotResolveTheContact) {
  // Exact: F = 7.6e-7, half-width 2.3e-3; the cells are 0.6 long.
  const auto between = remarks_with({"Cylinder/Inner radius=0.9423", "Cylinder/Angular velocity=1",
                                     "Cylinder/Radial force=2.13", "Road/Distance=1.00361170949",
                                     "Road/Contact zone=3.875282589278516, 6.008407101703167",
                                     "Mesh/Radial cells=1", "Mesh/Angular cells=10"});
  EXPECT_TRUE(have(between, "the surface penetrates the road between nodes"));
  EXPECT_TRUE(have(between, "not resolved"));
  // Less than two cells.
  EXPECT_TRUE(have(remarks_with({"Road/Distance=0.995"}), "held by 3 nodes"));
}

TEST(Remarks, WarnIfTheForceIsMostOfTheBound) {
  const std::string remark = "the force expression makes up";
  EXPECT_TRUE(have(remarks_with({"Cylinder/Radial force=if(z > 4.5 && z < 5, 1, 0)"}), remark));
  // On edges of the cells, and without a jump.
  EXPECT_FALSE(
      have(remarks_with({"Cylinder/Radial force=if(z > 1.4*pi && z < 1.6*pi, 1, 0)"}), remark));
  EXPECT_FALSE(have(remarks_with({"Cylinder/Radial force=1"}), remark));
}

TEST(Remarks, WarnIfTheBoundCertifiesNoDigit) {
  const auto hairline = remarks_with({"Road/Distance=0.999999"});
  EXPECT_TRUE(have(hairline, "no digit is certified"));
  EXPECT_TRUE(have(hairline, "held by 1 node"));
}

} // namespace
