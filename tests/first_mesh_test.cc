// Refinement ends, from every first mesh, with the best of its meshes.
#include "rollwave/mesh/ring_mesh.h"
#include "rollwave/run/simulation.h"

#include "test_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace rollwave;

namespace {

Result refined(const std::vector<std::string>& settings) {
  const Parameters parameters = parameters_of(settings);
  return simulate(make_scene(parameters), parameters).result;
}

TEST(FirstMesh, HasTheGradingThatItsHubNeeds) {
  for (const std::string hub : {"1e-2", "1e-4", "1e-6", "1e-12", "1e-150"}) {
    const Result result = refined({"Cylinder/Inner radius=" + hub, "Mesh/Radial cells=2",
                                   "Mesh/Angular cells=24", "Mesh/Wanted relative error=0.03"});
    EXPECT_LE(result.certified->relative, 0.03) << hub;
    EXPECT_LE(result.mesh.n_unknowns, 300000u) << hub;
    EXPECT_FALSE(texts_of(result.notes, Note::Kind::remark).empty()) << hub;
  }
}

TEST(FirstMesh, IsTheOneGivenWhereItsCellsAreEnough) {
  for (const std::string hub : {"0.5", "0.3", "0.01"}) {
    const Parameters parameters =
        parameters_of({"Cylinder/Inner radius=" + hub, "Mesh/Radial cells=8"});
    EXPECT_EQ(with_enough_cells(make_scene(parameters), parameters.mesh).radial_cells, 8u) << hub;
  }
  const Parameters parameters = parameters_of({"Mesh/Radial cells=1", "Mesh/Angular cells=3"});
  EXPECT_TRUE(with_enough_cells(make_scene(parameters), parameters.mesh) ==
              static_cast<const MeshOptions&>(parameters.mesh));
}

TEST(FirstMesh, HasColumnsEnoughForANarrowZone) {
  for (const std::string degree : {"1", "2"}) {
    const Result result =
        refined({"Road/Contact zone=4.7123, 4.7124", "Mesh/Degree=" + degree, "Mesh/Radial cells=2",
                 "Mesh/Angular cells=3", "Mesh/Wanted relative error=0.02"});
    EXPECT_LE(result.certified->relative, 0.02) << degree;
    EXPECT_LE(result.cycles.size(), 20u) << degree;
  }
}

// A force that is not square-integrable has no finite bound.
TEST(Refinement, EndsWithoutAFiniteBound) {
  const Result result = refined({"Cylinder/Radial force=abs(z-4.7)^(-0.7)", "Mesh/Radial cells=2",
                                 "Mesh/Angular cells=24", "Mesh/Wanted relative error=0.02",
                                 "Mesh/Marked fraction=0.01"});
  EXPECT_LE(result.cycles.size(), 40u);
  EXPECT_NE(shortfall_text(result.notes), "");
}

// Contact through the tangent of a needle, where the bound goes up and down.
TEST(Refinement, EndsWithItsBestMesh) {
  const Result result =
      refined({"Cylinder/Inner radius=0.5263157894736842", "Cylinder/Angular velocity=0.05347",
               "Road/Curvature=8550", "Road/Load=0.0523", "Mesh/Radial cells=4",
               "Mesh/Angular cells=60", "Mesh/Wanted relative error=1e-3"});
  EXPECT_TRUE(std::isfinite(result.certified->relative));
  EXPECT_LE(result.cycles.size(), 60u);
  for (const CycleFigures& cycle : result.cycles)
    EXPECT_LE(result.certified->relative, 1.05 * *cycle.certified);
}

} // namespace
