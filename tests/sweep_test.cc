// Scenes on the mesh of the one before: the same answers, and no work twice.
#include "draw.h"
#include "own_path.h"
#include "rollwave/run/quantities.h"
#include "rollwave/run/simulation.h"
#include "rollwave/study/study_runner.h"
#include "test_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <sstream>

using namespace rollwave;

namespace {

const std::vector<std::string> small_mesh = {"Cylinder/Angular velocity=0.5", "Mesh/Radial cells=4",
                                             "Mesh/Angular cells=60"};

void expect_same_answer(const Result& result, const Result& single) {
  EXPECT_NEAR(result.contact.loads.total, single.contact.loads.total,
              1e-12 * single.contact.loads.total);
  EXPECT_NEAR(result.energy.value, single.energy.value, 1e-12 * std::abs(single.energy.value));
  EXPECT_NEAR(result.contact.half_width(), single.contact.half_width(), 1e-10);
  EXPECT_NEAR(result.certified->lower_bound, single.certified->lower_bound,
              1e-12 * std::abs(single.energy.value));
  EXPECT_EQ(result.history.size(), single.history.size());
}

class Sweep : public testing::Test {
protected:
  /// Solves a scene on the mesh, and with the system and the load where @p is_new says so.
  struct Made {
    bool system, load;
  };
  Result next(std::vector<std::string> assignments, const Made& is_new) {
    assignments.insert(assignments.begin(), small_mesh.begin(), small_mesh.end());
    const Parameters parameters = parameters_of(assignments);
    const Scene scene = make_scene(parameters);
    RunStatistics statistics;
    if (!mesh)
      mesh = make_mesh(scene, parameters, MPI_COMM_SELF, statistics);
    if (is_new.system)
      shared.emplace(MeshObjects{make_system(*mesh->space, scene, scene.zone(), statistics)});
    if (is_new.load)
      shared->load = make_load(shared->system, scene, statistics);
    Solution solution =
        solve_on_shared({parameters, std::move(*mesh), std::move(statistics)}, *shared, scene);
    mesh = std::move(solution.mesh);
    const Result single = simulate(scene, parameters).result;
    expect_same_answer(solution.result, single);
    return solution.result;
  }

  std::optional<Mesh> mesh;
  std::optional<MeshObjects> shared;
};

TEST_F(Sweep, RepeatsNoWork) {
  const std::string zone = "Road/Contact zone=3.9, 5.5", critical = "Cylinder/Angular velocity=1",
                    force = "Cylinder/Radial force=1";
  const RunStatistics first = next({zone}, {true, true}).statistics;
  EXPECT_EQ(first.stiffness_assemblies, 1u);
  EXPECT_EQ(first.orderings, 2u); // K and certificate
  EXPECT_EQ(first.factorisations, 2u);

  const RunStatistics distance = next({zone, "Road/Distance=0.85"}, {false, false}).statistics;
  EXPECT_EQ(distance.stiffness_assemblies, 0u);
  EXPECT_EQ(distance.orderings, 0u);
  EXPECT_EQ(distance.factorisations, 0u);

  const RunStatistics speed = next({zone, critical}, {true, true}).statistics;
  EXPECT_EQ(speed.stiffness_assemblies, 1u);
  EXPECT_EQ(speed.factorisations, 2u);

  const RunStatistics with_force = next({zone, force, critical}, {false, true}).statistics;
  EXPECT_EQ(with_force.load_assemblies, 1u);
  EXPECT_EQ(with_force.factorisations, 0u);
  const RunStatistics same_force =
      next({zone, force, critical, "Road/Distance=0.9"}, {false, false}).statistics;
  EXPECT_EQ(same_force.load_assemblies, 0u);
  EXPECT_EQ(same_force.sparse_solves, 2u); // the displacement and the certificate
  next({zone, critical}, {false, true});
}

TEST_F(Sweep, CertifiesUnevenForcesOneAfterAnother) {
  const std::string zone = "Road/Contact zone=3.9, 5.5", critical = "Cylinder/Angular velocity=1",
                    smooth = "Cylinder/Radial force=1+0.5*r*cos(z)",
                    jump = "Cylinder/Radial force=if(r<0.8,1,z-3)";
  next({zone, smooth}, {true, true});
  next({zone, smooth, "Road/Distance=0.85"}, {false, false});
  next({zone, smooth, critical}, {true, true});
  next({zone, jump, critical}, {false, true});
  next({zone, jump, critical, "Road/Distance=0.85"}, {false, false});
}

/// Makes a study of a small mesh and compares every row with the run of its settings alone.
void expect_rows_are_single_runs(std::vector<std::string> assignments) {
  assignments.insert(assignments.begin(), small_mesh.begin(), small_mesh.end());
  const auto directory = own_path();
  std::filesystem::remove_all(directory);
  std::ostringstream out;
  Parameters parameters = parameters_of(assignments);
  parameters.output.directory = directory.string();
  Study study = plan_study(parameters);
  run_study(study, parameters, out);
  std::filesystem::remove_all(directory);
  for (unsigned int run = 0; run < study.plans.size(); ++run) {
    const RunPlan& plan = study.plans[run];
    SCOPED_TRACE(label(plan, plan.varied));
    const RunRecord& row = *study.runs[run];
    ASSERT_TRUE(row.is_solved()) << shortfall_text(row.notes);
    const Scene scene = make_scene(plan.parameters);
    const Result result = simulate(scene, plan.parameters).result;
    const auto single = values_of(result, scene.units);
    const double size = single.at("energy.norm_squared");
    const auto expect_near = [&](const std::string& name, double scale) {
      EXPECT_NEAR(row.values.at(name), single.at(name), 1e-9 * scale) << name;
    };
    expect_near("contact.force", std::abs(single.at("contact.force")) + std::sqrt(size));
    expect_near("energy.value", size);
    expect_near("contact.half_width", 1);
    expect_near("contact.peak_pressure", 1 + single.at("contact.peak_pressure"));
    EXPECT_LE(row.values.at("energy.lower_bound"), single.at("energy.upper_bound") + 1e-12 * size);
    EXPECT_GE(row.values.at("energy.upper_bound"), single.at("energy.lower_bound") - 1e-12 * size);
    EXPECT_EQ(texts_of(row.notes, Note::Kind::remark), texts_of(result.notes, Note::Kind::remark));
  }
}

// With these forces the surface leaves the automatic zone of a farther road, which is not that of a
// nearer one.
TEST(SweepStudy, RowsAreSingleRuns) {
  expect_rows_are_single_runs({"Cylinder/Radial force=20", "Study/Vary=Road/Distance = 0.9 | 0.6"});
  expect_rows_are_single_runs({"Cylinder/Radial force=20", "Mesh/Degree=1",
                               "Study/Scenes=far: Road/Distance = 0.9; near: Road/Distance = 0.6"});
  expect_rows_are_single_runs(
      {"Cylinder/Radial force=3*r", "Study/Vary=Material/Shear modulus = 3 | 1"});
  expect_rows_are_single_runs({"Study/Vary=Cylinder/Radial force = 12 | 0; Road/Distance = 1.8 | "
                               "0.7; Cylinder/Angular velocity = 0.5 | 0.9"});
}

TEST(SweepStudy, RowsOfRandomStudiesAreSingleRuns) {
  const unsigned int n_studies = n_random_scenes(4);
  Draw draw(11);
  for (unsigned int i = 0; i < n_studies; ++i) {
    const auto values = [&](const std::string& key, double low, double high) {
      std::string text = key + " = " + shortest_text(draw.number(low, high));
      for (int n = draw.count(1, 2); n > 0; --n)
        text += " | " + shortest_text(draw.number(low, high));
      return text;
    };
    std::vector<std::string> keys = {
        values("Road/Distance", 0.51, 1.9), values("Cylinder/Radial force", -20, 100),
        values("Cylinder/Angular velocity", 0, 1), "Mesh/Degree = 1 | 2"};
    keys.resize(draw.count(2, 4));
    std::shuffle(keys.begin(), keys.end(), std::minstd_rand(i));
    std::string vary = "Study/Vary=";
    for (const std::string& key : keys)
      vary += (vary.back() == '=' ? "" : "; ") + key;
    SCOPED_TRACE(vary);
    expect_rows_are_single_runs({vary});
  }
}

} // namespace
