// The mesh is periodic, and the contact rule integrates as Gauss-Lobatto's.
#include "rollwave/base/errors.h"
#include "rollwave/mesh/surface_trace.h"
#include "test_scenes.h"

#include <deal.II/base/numbers.h>

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
  for (const SurfaceNode& node : ring.boundary.contact_nodes()) {
    EXPECT_GT(node.angle, previous);
    EXPECT_LE(node.angle, scene.zone_end + 1e-12);
    previous = node.angle;
  }
}

TEST_P(Space, HasTheEndsOfAGivenZoneAmongItsNodes) {
  for (const std::string width : {"1e-7", "1e-3", "0.1", "0.3", "1"}) {
    const Parameters given = with(parameters, {"Road/Contact zone=4.6, 4.6 + " + width});
    const Scene scene = make_scene(given);
    const MeshAndSpace ring(scene, given);
    const auto& nodes = ring.boundary.contact_nodes();
    EXPECT_NEAR(nodes.front().angle, scene.zone_begin, 1e-13) << width;
    EXPECT_NEAR(nodes.back().angle, scene.zone_end, 1e-13) << width;
    EXPECT_LT(nodes.size(), 60u) << width;
  }
}

TEST_P(Space, NumbersTheContactNodesAmongTheSurfaceNodes) {
  const Scene scene = make_scene(parameters);
  const MeshAndSpace ring(scene, parameters);
  FieldVector field = ring.space.make_field();
  for (const SurfaceNode& node : ring.space.surface_nodes())
    field(node.dof) = node.angle;
  const auto values = ring.space.surface_values(field);
  unsigned int n_contact = 0;
  for (unsigned int i = 0; i < ring.space.surface_nodes().size(); ++i) {
    const double angle = ring.space.surface_nodes()[i].angle;
    EXPECT_EQ(values[i], angle);
    const auto number = ring.boundary.contact_number(i);
    ASSERT_EQ(number.has_value(), scene.is_in_zone(angle));
    if (!number)
      continue;
    EXPECT_EQ(ring.boundary.contact_nodes()[*number].angle, angle);
    ++n_contact;
  }
  EXPECT_EQ(n_contact, ring.boundary.size());
}

TEST_P(Space, RefusesAZoneBetweenNodes) {
  const Scene scene = make_scene(parameters);
  const MeshAndSpace ring(scene, parameters);
  const auto& nodes = ring.space.surface_nodes();
  for (unsigned int i = 0; i + 1 < nodes.size(); ++i) {
    const double begin = nodes[i].angle, length = nodes[i + 1].angle - begin;
    EXPECT_THROW(ContactBoundary(ring.space, {begin + 0.1 * length, begin + 0.9 * length}),
                 BadInput);
  }
}

TEST_P(Space, TracesReproducePolynomialsOfTheDegree) {
  const Scene scene = make_scene(parameters);
  const MeshAndSpace ring(scene, parameters);
  const int p = GetParam();
  const double middle = (scene.zone_begin + scene.zone_end) / 2;
  FieldVector field = ring.space.make_field();
  for (const SurfaceNode& node : ring.space.surface_nodes())
    field(node.dof) = std::pow(node.angle - middle, p);
  const SurfaceTrace trace(ring.space, field);
  unsigned int n_checked = 0;
  for (unsigned int i = 0; i < trace.edges().size(); ++i) {
    const SurfaceEdge& edge = trace.edges()[i];
    if (edge.end > middle + PI - 1e-9) // its last node has the angle middle - pi
      continue;
    ++n_checked;
    for (const double t : {0., 0.3, 0.8, 1.}) {
      const double x = edge.begin + t * (edge.end - edge.begin) - middle;
      const auto [value, slope] = trace.value_and_slope(i, t);
      EXPECT_EQ(trace.value(i, t), value);
      EXPECT_NEAR(value, std::pow(x, p), 1e-12);
      EXPECT_NEAR(slope, p * std::pow(x, p - 1), 1e-11);
    }
  }
  EXPECT_GE(n_checked, 9u);
}

TEST_P(Space, EliminatesEachDegreeOfFreedomOnceOnARefinedMesh) {
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
  auto dofs = space.elimination_order();
  std::sort(dofs.begin(), dofs.end());
  ASSERT_EQ(dofs.size(), space.dof_handler().n_dofs());
  for (unsigned int i = 0; i < dofs.size(); ++i)
    EXPECT_EQ(dofs[i], i);
}

TEST_P(Space, AdmitsAZoneAcrossTheSeam) {
  Scene scene = make_scene(parameters);
  const MeshAndSpace below(scene, parameters);
  scene.zone_begin -= PI;
  scene.zone_end -= PI;
  const MeshAndSpace above(scene, parameters);
  ASSERT_EQ(above.boundary.size(), below.boundary.size());
  for (unsigned int i = 0; i < below.boundary.size(); ++i) {
    const SurfaceNode &one = above.boundary.contact_nodes()[i],
                      &other = below.boundary.contact_nodes()[i];
    EXPECT_NEAR(one.angle, other.angle - PI, 1e-13);
    EXPECT_NEAR(one.weight, other.weight, 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(Degree, Space, testing::Values(1, 2, 3, 4));

} // namespace
