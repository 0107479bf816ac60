// The mesh is periodic, and the contact rule integrates as Gauss-Lobatto's.
#include "test_scenes.h"

#include <deal.II/base/numbers.h>
#include <deal.II/dofs/dof_tools.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace rollwave;
using dealii::numbers::PI;

namespace {

class Space : public testing::TestWithParam<int> {
protected:
  Parameters parameters = parameters_of({"Mesh/Degree=" + std::to_string(GetParam()),
                                         "Mesh/Radial cells=3", "Mesh/Angular cells=10"});
};

TEST_P(Space, HasOneUnknownForEachNodeOffTheHub) {
  const Scene scene = make_scene(parameters);
  const MeshAndSpace ring(scene, parameters);
  const unsigned int p = GetParam();
  EXPECT_EQ(ring.space.n_unknowns(), 3 * p * 10 * p);
  EXPECT_EQ(ring.space.surface_nodes().size(), 10 * p);
}

TEST_P(Space, WeightsArePositiveAndIntegrateLikeGaussLobatto) {
  const Scene scene = full_circle(0.4, 2, 0.1, -0.1);
  const MeshAndSpace ring(scene, parameters);
  // On each cell the rule with p + 1 points is exact up to degree 2 p - 1.
  const unsigned int p = GetParam();
  double length = 0, moment = 0;
  for (const SurfaceNode& node : ring.space.surface_nodes()) {
    EXPECT_GT(node.weight, 0);
    length += node.weight;
    // A function that is a polynomial on each cell and continuous over the seam.
    const double local = std::fmod((node.angle - PI / 2) / (2 * PI / 10) + 1e-9, 1.);
    moment += node.weight * (local < 1e-6 ? 0 : std::pow(local * (1 - local), p - 1.));
  }
  EXPECT_NEAR(length, 2 * 2 * PI, 1e-12);
  if (p == 2) {
    EXPECT_NEAR(moment, 2 * 2 * PI / 6, 1e-12);
  }
}

TEST_P(Space, ListsTheContactNodesOfTheZoneInOrder) {
  const Scene scene = make_scene(parameters);
  const MeshAndSpace ring(scene, parameters);
  double previous = scene.zone_begin - 1e-12;
  for (const SurfaceNode& node : ring.space.contact_nodes()) {
    EXPECT_GT(node.angle, previous);
    EXPECT_LE(node.angle, scene.zone_end + 1e-12);
    previous = node.angle;
  }
}

// On a long ring: each half, then the line between them with the seam, on a refined mesh too.
TEST_P(Space, IsDissected) {
  parameters = parameters_of({"Mesh/Degree=" + std::to_string(GetParam()), "Mesh/Radial cells=1",
                              "Mesh/Angular cells=16"});
  const Scene scene = make_scene(parameters);
  MeshAndSpace ring(scene, parameters);
  for (int level = 0; level < 3; ++level) {
    for (const auto& cell : ring.triangulation->active_cell_iterators())
      if (std::abs(cell->center()[1] - 3 * PI / 2) < PI / (1 << level))
        cell->set_refine_flag();
    ring.triangulation->execute_coarsening_and_refinement();
  }
  const RingSpace space(*ring.triangulation, scene, GetParam());
  std::vector<dealii::Point<2>> points(space.dof_handler().n_dofs());
  dealii::DoFTools::map_dofs_to_support_points(space.mapping(), space.dof_handler(), points);
  auto dofs = space.elimination_order();
  int previous = 0;
  for (const auto dof : dofs) {
    const double turns = (points[dof][1] - PI / 2) / (2 * PI);
    const auto lies_at = [turns](double place) { return std::abs(turns - place) < 1e-12; };
    const int part = lies_at(0) || lies_at(1) || lies_at(0.5) ? 2 : turns > 0.5;
    EXPECT_GE(part, previous);
    previous = part;
  }
  EXPECT_EQ(previous, 2);
  std::sort(dofs.begin(), dofs.end());
  ASSERT_EQ(dofs.size(), points.size());
  for (unsigned int i = 0; i < dofs.size(); ++i)
    EXPECT_EQ(dofs[i], i);
}

TEST_P(Space, AdmitsAZoneAcrossTheSeam) {
  Scene scene = make_scene(parameters);
  const MeshAndSpace below(scene, parameters);
  scene.zone_begin -= PI;
  scene.zone_end -= PI;
  const MeshAndSpace above(scene, parameters);
  ASSERT_EQ(above.space.contact_nodes().size(), below.space.contact_nodes().size());
  for (unsigned int i = 0; i < below.space.contact_nodes().size(); ++i) {
    EXPECT_NEAR(above.space.contact_nodes()[i].angle, below.space.contact_nodes()[i].angle - PI,
                1e-13);
    EXPECT_NEAR(above.space.contact_nodes()[i].weight, below.space.contact_nodes()[i].weight,
                1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(Degree, Space, testing::Values(1, 2, 3, 4));

} // namespace
