// Rows of a study: kept, found again, put into tables; orders only where there are any.
#include "own_path.h"
#include "rollwave/study/study_runner.h"
#include "rollwave/study/study_table.h"
#include "test_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

namespace fs = std::filesystem;
using namespace rollwave;

namespace {

Study planned(const std::vector<std::string>& assignments) {
  return plan_study(parameters_of(assignments));
}

StudyRun some_run() {
  StudyRun run;
  run.figures = {{"force", 0.1}, {"energy", 1. / 3}, {"effectivity", std::nan("")}};
  run.reference = "the semi-analytic solution";
  run.failure = "no \"way\",\nat all";
  run.remarks = {"rough, \"or so\"", "ζ"};
  run.pressure = {{4.5, 0}, {4.6, 0.25}};
  return run;
}

TEST(StudyRecord, IsReadAsItWasWritten) {
  const Study study = planned({"Road/Contact zone=4.50, 5", "Study/Vary=Mesh/Degree = 1"});
  const StudyRun run = some_run();
  const std::string line = study_line(study.plans[0], run) + '\n';
  const auto read = read_study_runs(line + line);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].first, study.plans[0].identity);
  EXPECT_EQ(read[0].second.figure("energy"), 1. / 3);
  EXPECT_FALSE(read[0].second.figure("effectivity"));
  EXPECT_EQ(read[0].second.failure, run.failure);
  EXPECT_EQ(read[0].second.remarks, run.remarks);
  EXPECT_EQ(read[0].second.pressure, run.pressure);
  // Cut anywhere, it has whole runs or none.
  for (std::size_t size = 0; size + 1 < line.size(); ++size)
    ASSERT_TRUE(read_study_runs(line.substr(0, size)).empty()) << size;
  std::minstd_rand random(1);
  for (unsigned int i = 0; i < 1000; ++i) {
    std::string torn = line;
    torn.erase(random() % line.size(), 1 + random() % 200);
    EXPECT_NO_THROW(read_study_runs(torn));
  }
}

TEST(StudyRecord, IsATableForSpreadsheets) {
  Study study = planned({"Study/Vary=Road/Contact zone = 4.5, 5 | 4, 5"});
  EXPECT_EQ(study_csv(study), "Road/Contact zone,solved,published_steps,reference,failure,remarks,"
                              "files,shared\n");
  study.runs[1] = some_run();
  EXPECT_EQ(study_csv(study),
            "Road/Contact zone,solved,published_steps,reference,failure,remarks,files,force,energy,"
            "effectivity,shared\n\"4, 5\",1,,the semi-analytic solution,\"no \"\"way\"\", at all\","
            "\"rough, \"\"or so\"\" | ζ\",,0.1,0.3333333333333333,,\n");
}

TEST(StudyRecord, HasNoHalfWidthWhereThereAreTwoPatches) {
  const Parameters parameters =
      parameters_of({"Cylinder/Radial force=-8*exp(-((z-4.71238898)/0.12)^2)",
                     "Mesh/Radial cells=6", "Mesh/Angular cells=180"});
  StudyRun run;
  run.figures = figures_of(simulate(make_scene(parameters), parameters).result);
  EXPECT_EQ(run.figure("patches"), 2.);
  EXPECT_FALSE(run.figure("half_width"));
  EXPECT_GT(run.figure("stiffness_force"), run.figure("stiffness_vertical_load"));
}

class RepeatedStudy : public testing::Test {
protected:
  RepeatedStudy() { fs::remove_all(directory); }
  ~RepeatedStudy() override { fs::remove_all(directory); }

  /// How many rows were done before.
  unsigned int run(const std::vector<std::string>& assignments) {
    std::vector<std::string> all = {"Mesh/Radial cells=2", "Mesh/Angular cells=24"};
    all.insert(all.end(), assignments.begin(), assignments.end());
    Parameters parameters = parameters_of(all);
    parameters.output.directory = directory.string();
    std::ostringstream out;
    Study study = plan_study(parameters);
    run_study(study, parameters, directory, out);
    unsigned int count = 0;
    const std::string text = out.str();
    for (auto at = text.find("done before"); at != std::string::npos;
         at = text.find("done before", at + 1))
      ++count;
    return count;
  }

  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(directory / name).rdbuf();
    return text.str();
  }

  fs::path directory = own_path();
};

TEST_F(RepeatedStudy, KnowsRowsByTheirSettings) {
  EXPECT_EQ(run({"Study/Vary=Road/Distance = 0.9 | 0.7"}), 0u);
  EXPECT_EQ(run({"Study/Vary=Road/Distance = 0.90 | 0.8 | 0.7"}), 2u);
  EXPECT_EQ(run({"Study/Vary=Road/Distance = 0.7 : 0.9 : 0.1", "Output/Files=summary"}), 3u);
  const fs::path moved = directory.string() + "_moved";
  fs::remove_all(moved);
  fs::rename(directory, moved);
  directory = moved / ".." / moved.filename();
  EXPECT_EQ(run({"Study/Vary=Road/Distance = 0.7 | 0.8 | 0.9"}), 3u);
  EXPECT_FALSE(fs::exists(directory / "study-before.csv"));
  // What is asked of a run is one of its settings.
  EXPECT_EQ(run({"Study/Vary=Road/Distance = 0.7 | 0.8", "Study/True errors=true"}), 0u);
}

TEST_F(RepeatedStudy, TriesAgainWhatDidNotFailByItsParameters) {
  const std::string study = "Study/Vary=Road/Distance = 0.9 | 0.8 | 0.7";
  run({study});
  std::string lines = read("study.jsonl");
  const std::string solved = "\"failure\":\"\"";
  lines.replace(lines.find(solved), solved.size(), "\"failure\":\"not enough memory\"");
  std::ofstream(directory / "study.jsonl") << lines;
  EXPECT_EQ(run({study}), 2u);
  EXPECT_EQ(read("study.csv").find("not enough memory"), std::string::npos);
}

TEST_F(RepeatedStudy, SetsTablesAsideWithoutLoss) {
  std::vector<std::string> tables;
  for (const char* const velocity : {"0.1", "0.2", "0.3"}) {
    EXPECT_EQ(run({"Study/Vary=Road/Distance = 0.9 | 0.8",
                   std::string("Cylinder/Angular velocity=") + velocity}),
              0u);
    tables.push_back(read("study.csv"));
  }
  EXPECT_EQ(read("study-before.csv"), tables[0]);
  EXPECT_EQ(read("study-before-2.csv"), tables[1]);
}

TEST_F(RepeatedStudy, WritesFilesOfEachRun) {
  const std::vector<std::string> files = {"Study/Files of each run=contact, solution"};
  auto study = files;
  study.push_back("Study/Vary=Road/Distance = 0.9 | 0.7");
  run(study);
  EXPECT_TRUE(fs::exists(directory / "run-001" / "solution.vtu"));
  const std::string first = read("run-002/contact.csv");
  EXPECT_GT(first.size(), 100u);
  // A row keeps its directory when others come before it.
  study.back() = "Study/Vary=Road/Distance = 0.9 | 0.8 | 0.7";
  EXPECT_EQ(run(study), 2u);
  EXPECT_EQ(read("run-002/contact.csv"), first);
  EXPECT_TRUE(fs::exists(directory / "run-003" / "contact.csv"));
  fs::remove(directory / "run-001" / "solution.vtu");
  EXPECT_EQ(run(study), 2u);
  EXPECT_TRUE(fs::exists(directory / "run-001" / "solution.vtu"));
}

// With true errors every run is timed in full; without, its row says what it does not count.
TEST_F(RepeatedStudy, SaysWhatIsShared) {
  const std::string study = "Study/Vary=Road/Distance = 0.9 | 0.8 | 0.7";
  run({study, "Study/True errors=true"});
  for (const auto& [identity, row] : read_study_runs(read("study.jsonl"))) {
    EXPECT_TRUE(row.shared.empty());
    EXPECT_TRUE(row.figure("seconds_factorisation"));
  }
  fs::remove_all(directory);
  run({study});
  const auto rows = read_study_runs(read("study.jsonl"));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].second.shared, "");
  EXPECT_EQ(rows[1].second.shared, "mesh and matrices");
  EXPECT_FALSE(rows[1].second.figure("seconds_factorisation"));
}

/// The orders of a study with true errors, where the error of a run is the product of @p factor
/// and its cells in the radius to the power of -1.5.
std::string orders(
    const std::string& vary, const std::string& setting = "Mesh/Degree=2",
    const std::function<double(const Parameters&)>& factor = [](const Parameters&) { return 1.; }) {
  Study study = planned({"Study/Vary=" + vary, "Study/True errors=true", setting});
  for (unsigned int i = 0; i < study.plans.size(); ++i) {
    const Parameters& p = study.plans[i].parameters;
    const double cells = std::ldexp(p.mesh.radial_cells, p.mesh.global_refinements);
    study.runs[i].emplace();
    study.runs[i]->figures = {{"dofs", double(p.mesh.most_unknowns)},
                              {"error_relative", factor(p) * std::pow(cells, -1.5)},
                              {"expected_order", 1.5}};
  }
  std::ostringstream text;
  report_orders(text, study);
  return text.str();
}

TEST(Orders, AreGivenWhereAllCellsAreCutAlike) {
  EXPECT_EQ(orders("Mesh/Global refinements = 0 | 1 | 2 | 3"),
            "Orders in h: energy norm 1.5 +- 0 (expected 1.5)\n");
  const std::string both = "Mesh/Radial cells & Mesh/Angular cells = 4 & 48 | 8 & 96 | 16 & 192";
  const std::string of_degrees = "Orders in h, degree 1: energy norm 1.5 +- 0 (expected 1.5)\n"
                                 "Orders in h, degree 2: energy norm 1.5 +- 0 (expected 1.5)\n";
  const auto by_degree = [](const Parameters& p) { return std::pow(10., -1. * p.mesh.degree); };
  EXPECT_EQ(orders(both + "; Mesh/Degree = 1 | 2", "Mesh/Degree=2", by_degree), of_degrees);
  EXPECT_EQ(orders("Mesh/Degree = 1 | 2; " + both, "Mesh/Degree=2", by_degree), of_degrees);
  EXPECT_EQ(orders("Mesh/Angular cells = 48 | 96 | 192 | 384"), "");
  EXPECT_EQ(orders("Mesh/Degree = 1 | 2 | 3 | 4", "Mesh/Radial cells=4", by_degree), "");
}

TEST(Orders, OfAdaptiveMeshesAreInUnknowns) {
  EXPECT_EQ(orders("Mesh/Most unknowns = 20000 | 80000 | 320000", "Mesh/Adaptive cycles=9",
                   [](const Parameters& p) { return 1e3 / p.mesh.most_unknowns; }),
            "Orders in N^(-1/2): energy norm 2 +- 0 (expected 1.5)\n");
}

TEST(StudyTable, HasAtMostAHundredColumns) {
  std::string vary = "Study/Vary=Cylinder/Radial force = 0.123456789*sin(3*z)*cos(2*r) | 1";
  for (const char* const key :
       {"Mesh/Wanted relative error", "Mesh/Marked fraction", "Certificate/Error bound",
        "Contact/Most steps", "Mesh/Most unknowns", "Road/Distance", "Mesh/Degree"})
    vary += std::string("; ") + key +
            (key == std::string("Certificate/Error bound") ? " = true" : " = 0.9");
  vary.replace(vary.find("Most steps = 0.9"), 16, "Most steps = 100");
  vary.replace(vary.find("unknowns = 0.9"), 14, "unknowns = 123456789");
  vary.replace(vary.find("Degree = 0.9"), 12, "Degree = 2");
  Study study = planned({vary, "Study/True errors=true"});
  for (auto& run : study.runs) {
    run = some_run();
    run->remarks = {"a remark with the number 0." + std::to_string(&run - &study.runs[0])};
  }
  std::ostringstream text;
  print_study_notes(text, study);
  const StudyTable table(study);
  unsigned int widest = 0;
  std::istringstream rows(table.header() + table.row(0) + table.row(1));
  for (std::string line; std::getline(rows, line);)
    widest = std::max<unsigned int>(widest, line.size());
  EXPECT_LE(widest, 100u) << text.str();
  EXPECT_EQ(text.str().find("a remark"), text.str().rfind("a remark"));
  EXPECT_NE(text.str().find("2 of 2 runs"), std::string::npos);
}

TEST(StudyTable, KeepsTheKeysThatTellRunsApart) {
  Study study = planned({"Study/Vary=Mesh/Degree = 1 | 2; Mesh/Marking = all | bulk; "
                         "Mesh/Most unknowns = 204800 | 819200",
                         "Mesh/Adaptive cycles=1000", "Study/True errors=true"});
  const std::string header = StudyTable(study).header();
  for (const char* const title : {"Degree", "Marking", "unknowns", "error", "order", "seconds"})
    EXPECT_NE(header.find(title), std::string::npos) << title << '\n' << header;
}

} // namespace
