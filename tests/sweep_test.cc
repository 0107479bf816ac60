// Scenes on the mesh of the one before: the same answers, and no work twice.
#include "own_path.h"
#include "rollwave/run/simulation.h"
#include "rollwave/study/study_runner.h"
#include "test_scenes.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

using namespace rollwave;

namespace {

const std::vector<std::string> small_mesh = {"Cylinder/Angular velocity=0.5", "Mesh/Radial cells=4",
                                             "Mesh/Angular cells=60"};

/// A kind of solver and cells.
struct SweepCase {
  std::string kind;
  unsigned int radial_cells, angular_cells;
  bool is_direct() const { return kind == "direct"; }
};

void expect_same_answer(const Result& result, const Result& single) {
  EXPECT_NEAR(result.patch.force, single.patch.force, 1e-12 * single.patch.force);
  EXPECT_NEAR(result.energy.value, single.energy.value, 1e-12 * std::abs(single.energy.value));
  EXPECT_NEAR(result.patch.half_width(), single.patch.half_width(), 1e-10);
  EXPECT_NEAR(result.certified->lower_bound, single.certified->lower_bound,
              1e-12 * std::abs(single.energy.value));
  EXPECT_EQ(result.history.size(), single.history.size());
}

class Sweep : public testing::TestWithParam<SweepCase> {
protected:
  Parameters parameters_with(std::vector<std::string> assignments) const {
    const auto& [kind, radial_cells, angular_cells] = GetParam();
    assignments.insert(assignments.begin(),
                       {"Cylinder/Angular velocity=0.5", "Solver/Kind=" + kind,
                        "Mesh/Radial cells=" + std::to_string(radial_cells),
                        "Mesh/Angular cells=" + std::to_string(angular_cells)});
    return parameters_of(assignments);
  }

  Result next(const std::vector<std::string>& assignments) {
    const Parameters parameters = parameters_with(assignments);
    const Scene scene = make_scene(parameters);
    solution = simulate_next(scene, parameters, std::move(solution));
    // A zone that is left to the program depends on the distance.
    const Result single = simulate(scene, parameters).result;
    expect_same_answer(solution.result, single);
    return solution.result;
  }

  Solution solution;
};

TEST_P(Sweep, DoesNothingTwice) {
  const std::string zone = "Road/Contact zone=3.9, 5.5";
  const bool is_direct = GetParam().is_direct();
  const unsigned int n_factors = is_direct ? 2 : 0; // K and certificate
  const Work first = next({zone}).work;
  EXPECT_EQ(first.stiffness_assemblies, 1u);
  EXPECT_EQ(first.orderings, n_factors);
  EXPECT_EQ(first.factorisations, n_factors);

  const Work distance = next({zone, "Road/Distance=0.85"}).work;
  EXPECT_EQ(distance.stiffness_assemblies, 0u);
  EXPECT_EQ(distance.orderings, 0u);
  EXPECT_EQ(distance.factorisations, 0u);

  const Work speed = next({zone, "Road/Distance=0.85", "Cylinder/Angular velocity=1"}).work;
  EXPECT_EQ(speed.stiffness_assemblies, 1u);
  EXPECT_EQ(speed.orderings, n_factors / 2);
  EXPECT_EQ(speed.factorisations, n_factors);

  const Work force = next({zone, "Cylinder/Radial force=1", "Cylinder/Angular velocity=1"}).work;
  EXPECT_EQ(force.load_assemblies, 1u);
  EXPECT_EQ(force.factorisations, 0u);
  EXPECT_EQ(force.forward_substitutions, n_factors);
  const Work same_force =
      next({zone, "Cylinder/Radial force=1", "Cylinder/Angular velocity=1", "Road/Distance=0.9"})
          .work;
  EXPECT_EQ(same_force.load_assemblies, 0u);
  EXPECT_EQ(same_force.forward_substitutions, n_factors / 2); // of the certificate
  next({zone, "Cylinder/Angular velocity=1"});
}

TEST_P(Sweep, CertifiesUnevenForcesOneAfterAnother) {
  const std::string zone = "Road/Contact zone=3.9, 5.5";
  const std::string smooth = "Cylinder/Radial force=1+0.5*r*cos(z)",
                    jump = "Cylinder/Radial force=if(r<0.8,1,z-3)";
  next({zone, smooth});
  next({zone, smooth, "Road/Distance=0.85"});
  next({zone, smooth, "Cylinder/Angular velocity=1"});
  next({zone, jump, "Cylinder/Angular velocity=1"});
  next({zone, jump, "Road/Distance=0.85"});
  next({zone});
}

INSTANTIATE_TEST_SUITE_P(Kinds, Sweep,
                         testing::Values(SweepCase{"direct", 4, 60}, SweepCase{"iterative", 4, 60}),
                         [](const auto& info) {
                           return info.param.kind + std::to_string(info.param.radial_cells);
                         });

TEST(SweepStudy, SharesTheWidestZone) {
  std::vector<std::string> assignments = small_mesh;
  assignments.push_back("Study/Vary=Cylinder/Angular velocity = 0.5 | 0.9; Road/Distance = 0.9 | "
                        "0.8 | 0.85; Mesh/Degree = 1 | 2");
  const auto directory = own_path();
  std::filesystem::remove_all(directory);
  std::filesystem::create_directories(directory);
  std::ostringstream progress;
  const auto runs = run_study(parameters_of(assignments), directory, progress).runs;
  std::filesystem::remove_all(directory);
  ASSERT_EQ(runs.size(), 12u);
  for (const StudyRun& run : runs) {
    std::vector<std::string> own = small_mesh;
    for (const Setting& setting : run.settings)
      own.push_back(setting.path() + "=" + setting.value);
    const Parameters parameters = parameters_of(own);
    const Result single = simulate(make_scene(parameters), parameters).result;
    const double force = *run.figure("force"), energy = *run.figure("energy");
    EXPECT_NEAR(force, single.patch.force, 1e-12 * force);
    EXPECT_NEAR(energy, single.energy.value, 1e-12 * energy);
    EXPECT_EQ(*run.figure("contact_steps"), single.history.size());
  }
}

} // namespace
