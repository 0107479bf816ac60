// A scene pays only for what it needs: the ledger of its work.
#include "test_scenes.h"

#include <gtest/gtest.h>

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
  EXPECT_EQ(without.forward_substitutions, 0u);
  EXPECT_EQ(without.back_substitutions, 1u);
  const RunStatistics with_force = work_of({no_certificate, "Cylinder/Radial force=1"});
  EXPECT_EQ(with_force.load_assemblies, 1u);
  EXPECT_EQ(with_force.forward_substitutions, 1u);
  EXPECT_EQ(with_force.back_substitutions, 1u);
}

TEST(LeaveOut, OneFactorisationForEachMeshHoweverManyContactSteps) {
  for (const char* method : {"Contact/Method=active set", "Contact/Method=uzawa"}) {
    const RunStatistics statistics = work_of({"Certificate/Error bound=false", method});
    EXPECT_EQ(statistics.stiffness_assemblies, 1u);
    EXPECT_EQ(statistics.orderings, 1u);
    EXPECT_EQ(statistics.factorisations, 1u);
    EXPECT_EQ(statistics.back_substitutions, 1u);
    EXPECT_EQ(statistics.linear_iterations, 0u);
  }
}

TEST(LeaveOut, NoContactLoopWhenTheFreeSolutionIsFeasible) {
  const Parameters parameters = parameters_of({"Road/Distance=1.2", "Cylinder/Radial force=-1"});
  const Result result = simulate(make_scene(parameters), parameters).result;
  EXPECT_EQ(result.history.size(), 1u);
  EXPECT_EQ(result.statistics.dense_factorisations, 0u);
}

TEST(LeaveOut, CertificateAndIndicatorUnlessAskedFor) {
  const RunStatistics plain = work_of({"Certificate/Error bound=false"});
  EXPECT_FALSE(has_phase(plain, "certificate"));
  EXPECT_FALSE(has_phase(plain, "indicator"));
  EXPECT_FALSE(has_phase(plain, "preconditioner"));

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
