// A scene pays only for what it needs: the ledger of its work.
#include "test_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace rollwave;

namespace {

RunStatistics work_of(std::vector<std::string> assignments) {
  assignments.insert(assignments.begin(), {"Mesh/Radial cells=4", "Mesh/Angular cells=60"});
  const Parameters parameters = parameters_of(assignments);
  return simulate(make_scene(parameters), parameters).result.statistics;
}

bool has_phase(const RunStatistics& statistics, const std::string& name) {
  return statistics.seconds(name).has_value();
}

TEST(LeaveOut, NoLoadWithoutForce) {
  const std::string no_certificate = "Certificate/Error bound=false";
  const RunStatistics without = work_of({no_certificate});
  EXPECT_EQ(without.load_assemblies, 0u);
  EXPECT_EQ(without.sparse_solves, 1u);
  const RunStatistics with_force = work_of({no_certificate, "Cylinder/Radial force=1"});
  EXPECT_EQ(with_force.load_assemblies, 1u);
  EXPECT_EQ(with_force.sparse_solves, 2u);
}

TEST(LeaveOut, OneFactorisationForEachMeshHoweverManyContactSteps) {
  for (const char* method : {"Contact/Method=active set", "Contact/Method=uzawa"}) {
    const RunStatistics statistics = work_of({"Certificate/Error bound=false", method});
    EXPECT_EQ(statistics.stiffness_assemblies, 1u);
    EXPECT_EQ(statistics.orderings, 1u);
    EXPECT_EQ(statistics.factorisations, 1u);
    EXPECT_EQ(statistics.sparse_solves, 1u);
  }
}

TEST(LeaveOut, NoContactLoopWhenTheFreeSolutionIsFeasible) {
  const Parameters parameters = parameters_of({"Road/Distance=1.2", "Cylinder/Radial force=-1"});
  const Result result = simulate(make_scene(parameters), parameters).result;
  EXPECT_EQ(result.history.size(), 1u);
  EXPECT_EQ(result.statistics.dense_factorisations, 0u);
}

/// Contact steps of a history with nodes in contact and nodes that are not.
unsigned int count_mixed(const Result& result) {
  return std::count_if(result.history.begin(), result.history.end(), [&](const ContactStep& step) {
    return step.active > 0 && step.active < result.mesh.n_contact_nodes;
  });
}

// The stiffness of the loads takes a derivative and two contact iterations on the last mesh.
TEST(LeaveOut, DenseFactorisationsOnlyForMixedContactStepsAndTheStiffness) {
  const auto result_of = [](std::vector<std::string> assignments) {
    assignments.insert(assignments.begin(), {"Mesh/Radial cells=4", "Mesh/Angular cells=60"});
    const Parameters parameters = parameters_of(assignments);
    return simulate(make_scene(parameters), parameters).result;
  };
  constexpr unsigned int derivative = 1, most_steps_of_two = 8;
  const Result single = result_of({});
  EXPECT_GT(single.statistics.dense_factorisations, count_mixed(single) + derivative);
  EXPECT_LE(single.statistics.dense_factorisations,
            count_mixed(single) + derivative + most_steps_of_two);

  const Result uzawa = result_of({"Contact/Method=uzawa"});
  EXPECT_LE(uzawa.statistics.dense_factorisations, derivative + most_steps_of_two);

  const Result adaptive = result_of({"Mesh/Adaptive cycles=4"});
  EXPECT_EQ(adaptive.statistics.factorisations, 2 * adaptive.cycles.size());
  unsigned int steps = 0;
  for (const CycleFigures& cycle : adaptive.cycles)
    steps += cycle.contact_steps;
  EXPECT_LE(adaptive.statistics.dense_factorisations, steps + derivative + most_steps_of_two);
}

// The steps of the active set that the stiffness takes are none of Uzawa's.
TEST(LeaveOut, MostStepsAreThoseOfTheMethod) {
  const Parameters parameters =
      parameters_of({"Mesh/Degree=1", "Mesh/Radial cells=4", "Mesh/Angular cells=60",
                     "Contact/Method=uzawa", "Contact/Tolerance=0.05", "Contact/Most steps=8"});
  const Result result = simulate(make_scene(parameters), parameters).result;
  EXPECT_LE(result.history.size(), 8u);
}

TEST(LeaveOut, CertificateAndIndicatorUnlessAskedFor) {
  const RunStatistics plain = work_of({"Certificate/Error bound=false"});
  EXPECT_FALSE(has_phase(plain, "certificate"));
  EXPECT_FALSE(has_phase(plain, "indicator"));

  const RunStatistics certified = work_of({});
  EXPECT_TRUE(has_phase(certified, "certificate"));
  EXPECT_EQ(certified.factorisations, 2u);
  EXPECT_FALSE(has_phase(certified, "indicator"));

  // Each of three meshes has a stiffness matrix and, where it is certified, a stress function.
  const RunStatistics by_certificate = work_of({"Mesh/Adaptive cycles=2"});
  EXPECT_EQ(by_certificate.stiffness_assemblies, 3u);
  EXPECT_EQ(by_certificate.factorisations, 6u);
  const RunStatistics by_kelly =
      work_of({"Mesh/Adaptive cycles=2", "Certificate/Error bound=false"});
  EXPECT_EQ(by_kelly.factorisations, 3u);
  EXPECT_FALSE(has_phase(by_kelly, "certificate"));
}

} // namespace
