// Rows of a study: kept, found again, put into tables; orders of its errors.
#include "own_path.h"
#include "rollwave/run/quantities.h"
#include "rollwave/study/convergence.h"
#include "rollwave/study/study_csv.h"
#include "rollwave/study/study_runner.h"
#include "test_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <sstream>

namespace fs = std::filesystem;
using namespace rollwave;

namespace {

Study planned(const std::vector<std::string>& assignments) {
  return plan_study(parameters_of(assignments));
}

/// Texts with what CSV files treat specially, and figures of many digits, one of them not known.
StudyRun some_run() {
  StudyRun run;
  for (const ResultQuantity& quantity : result_quantities())
    run.values[quantity.name] = 1. / (3 + run.values.size());
  run.values.erase("contact.half_width");
  run.reference = "the semi-analytic solution";
  run.failure = "no \"way\", at all";
  run.remarks = {"\"rough\", or so", "ζ"};
  run.pressure = {{4.5, 0}, {4.6, 0.25}};
  return run;
}

TEST(StudyCsv, IsReadAsItWasWritten) {
  const std::vector<std::string> settings = {
      "Study/Scenes=fast, thin: Cylinder/Inner radius = 0.9 & Road/Distance = 0.95",
      "Study/Vary=Road/Contact zone = 4, 5 | 4.5, 5"};
  Study study = planned(settings);
  study.runs[1] = some_run();
  const std::string row = csv_row(study, 1), text = csv_header(study) + row;
  Study again = planned(settings);
  read_csv(text, again);
  read_profiles(profiles_header(study) + profile_rows(study, 1), again);
  EXPECT_FALSE(again.runs[0]);
  ASSERT_TRUE(again.runs[1]);
  EXPECT_EQ(csv_row(again, 1), row);
  EXPECT_EQ(again.runs[1]->failure, study.runs[1]->failure);
  EXPECT_EQ(again.runs[1]->remarks, study.runs[1]->remarks);
  EXPECT_EQ(again.runs[1]->pressure, study.runs[1]->pressure);
  EXPECT_EQ(again.runs[1]->values, study.runs[1]->values);
}

// Cut anywhere it has whole runs or none, and another header than that of the study has none.
TEST(StudyCsv, IsReadInWholeLines) {
  const std::vector<std::string> settings = {"Study/Vary=Mesh/Degree = 1 | 2"};
  Study study = planned(settings);
  study.runs[0] = study.runs[1] = some_run();
  const std::string first = csv_header(study) + csv_row(study, 0), text = first + csv_row(study, 1);
  const Study empty = planned(settings);
  for (std::size_t size = 0; size < text.size(); ++size) {
    Study again = empty;
    read_csv(text.substr(0, size), again);
    ASSERT_EQ(again.runs[0].has_value(), size >= first.size()) << size;
    ASSERT_FALSE(again.runs[1]) << size;
  }
  Study other = planned({"Study/Vary=Mesh/Degree = 1 | 2; Road/Distance = 0.8"});
  read_csv(text, other);
  EXPECT_FALSE(other.runs[0]);
}

unsigned int count(const std::string& text, const std::string& part) {
  unsigned int n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++n;
  return n;
}

class RepeatedStudy : public testing::Test {
protected:
  RepeatedStudy() {
    fs::remove_all(directory);
    fs::create_directory(directory);
  }
  ~RepeatedStudy() override { fs::remove_all(directory); }

  /// Marks the rows in study.csv, runs the study, and returns how many rows still have the mark.
  unsigned int run(const std::vector<std::string>& assignments) {
    const std::string mark = "mark"; // the last column is a text
    const std::string marked =
        std::regex_replace(read("study.csv"), std::regex(",\n"), "," + mark + "\n");
    if (!marked.empty())
      std::ofstream(directory / "study.csv") << marked;
    std::vector<std::string> all = {"Mesh/Radial cells=2", "Mesh/Angular cells=24"};
    all.insert(all.end(), assignments.begin(), assignments.end());
    Parameters parameters = parameters_of(all);
    parameters.output.directory = directory.string();
    std::ostringstream out;
    Study study = plan_study(parameters);
    run_study(study, parameters, out);
    unsigned int count = 0;
    for (const auto& row : study.runs)
      count += row && row->shared == mark;
    return count;
  }

  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(directory / name).rdbuf();
    return text.str();
  }

  /// Replaces the first place of a text in a file.
  void replace(const std::string& name, const std::string& before, const std::string& after) const {
    std::string text = read(name);
    const auto place = text.find(before);
    ASSERT_NE(place, std::string::npos) << before;
    std::ofstream(directory / name) << text.replace(place, before.size(), after);
  }

  const fs::path directory = own_path();
};

// Each run has its own mesh and shares none, so that the last column is empty.
const std::string own_meshes = "Study/Vary=Mesh/Degree = 1 | 2 | 3";

TEST_F(RepeatedStudy, GoesOnWhereItIsTheSame) {
  EXPECT_EQ(run({own_meshes}), 0u);
  EXPECT_EQ(run({own_meshes}), 3u);
  EXPECT_EQ(run({own_meshes, "Cylinder/Angular velocity=0.4"}), 0u);
  EXPECT_EQ(run({own_meshes, "Cylinder/Angular velocity=0.4"}), 3u);
  replace("parameters.prm", "Rollwave ", "Rollwave 9"); // another version
  EXPECT_EQ(run({own_meshes, "Cylinder/Angular velocity=0.4"}), 0u);
}

TEST_F(RepeatedStudy, MakesRunsThatAreNotSolvedAgain) {
  run({own_meshes});
  const std::string profiles = read("study-profiles.csv");
  replace("study.csv", "\n2,1,", "\n2,0,");
  EXPECT_EQ(run({own_meshes}), 2u);
  const std::string table = read("study.csv");
  EXPECT_LT(table.find("\n1,1,"), table.find("\n2,1,"));
  EXPECT_LT(table.find("\n2,1,"), table.find("\n3,1,"));
  EXPECT_EQ(read("study-profiles.csv"), profiles);
  // After a stop within the last row the others are kept to the last digit, seconds included.
  const std::string kept = table.substr(0, table.find("\n3,1,"));
  std::ofstream(directory / "study.csv") << kept << "\n3,1,0.";
  EXPECT_EQ(run({own_meshes}), 2u);
  EXPECT_EQ(read("study.csv").find(kept), 0u);
  EXPECT_EQ(count(read("study.csv"), "\n"), 4u);
}

TEST_F(RepeatedStudy, WritesFilesOfEachRun) {
  const std::string files = "Study/Files of each run=contact, solution";
  run({files, "Study/Vary=Road/Distance = 0.9 | 0.7"});
  EXPECT_TRUE(fs::exists(directory / "run-001" / "solution.vtu"));
  EXPECT_GT(read("run-002/contact.csv").size(), 100u);
  EXPECT_NE(read("study.csv").find(",run-002,"), std::string::npos);
}

// With true errors every run is timed in full; without, its row says what it does not count.
TEST_F(RepeatedStudy, SaysWhatIsShared) {
  const std::vector<std::string> settings = {"Study/Vary=Road/Distance = 0.9 | 0.8"};
  const auto rows = [&] {
    Study study = planned(settings);
    read_csv(read("study.csv"), study);
    return study.runs;
  };
  run({settings[0], "Study/True errors=true"});
  for (const auto& row : rows()) {
    EXPECT_TRUE(row->shared.empty());
    EXPECT_TRUE(row->values.count("seconds.factorisation") > 0);
  }
  run(settings);
  EXPECT_EQ(rows()[0]->shared, "");
  EXPECT_EQ(rows()[1]->shared, "mesh and matrices");
  EXPECT_EQ(rows()[1]->values.count("seconds.factorisation"), 0u);
}

// The distance for a load is compared with the exact one, the other errors with those at its own.
TEST_F(RepeatedStudy, HasTheErrorOfTheDistanceForALoad) {
  const std::vector<std::string> settings = {"Road/Load=0.3", "Study/True errors=true",
                                             "Study/Vary=Mesh/Degree = 2"};
  run(settings);
  Study study = planned(settings);
  read_csv(read("study.csv"), study);
  const double error = study.value(0, "error.exact_distance").value();
  EXPECT_GT(error, 0);
  EXPECT_LT(error, 1e-2);
}

/// The orders of a study with true errors, where the error of a run is the product of @p factor
/// and N^(-0.75) with its number N of cells, and as many unknowns.
std::string orders(
    const std::string& vary, const std::string& setting = "Mesh/Degree=2",
    const std::function<double(const Parameters&)>& factor = [](const Parameters&) { return 1.; }) {
  Study study = planned({"Study/Vary=" + vary, "Study/True errors=true", setting});
  for (unsigned int i = 0; i < study.plans.size(); ++i) {
    const Parameters& p = study.plans[i].parameters;
    const double cells =
        std::ldexp(p.mesh.radial_cells * p.mesh.angular_cells, 2 * p.mesh.global_refinements);
    study.runs[i].emplace();
    study.runs[i]->values = {{"mesh.dofs", cells},
                             {"error.exact_relative", factor(p) * std::pow(cells, -0.75)},
                             {"error.expected_order", 1.5}};
  }
  std::ostringstream text;
  report_orders(text, study);
  return text.str();
}

/// Expects @p n fitted orders of 1.5 without a spread, where 1.5 is expected.
void expect_orders(const std::string& text, unsigned int n) {
  static const std::regex fit("(\\S+) \\+- (\\S+) \\(\\D*([^)]+)\\)");
  unsigned int n_found = 0;
  for (std::sregex_iterator match(text.begin(), text.end(), fit), end; match != end; ++match) {
    EXPECT_EQ(std::stod((*match)[1]), 1.5);
    EXPECT_EQ(std::stod((*match)[2]), 0);
    EXPECT_EQ(std::stod((*match)[3]), 1.5);
    ++n_found;
  }
  EXPECT_EQ(n_found, n) << text;
}

TEST(Orders, AreThoseOfTheErrors) {
  expect_orders(orders("Mesh/Global refinements = 0 | 1 | 2 | 3"), 1);
  expect_orders(orders("Mesh/Angular cells = 48 | 96 | 200 | 384"), 1);
  // Each degree has its own.
  const std::string both = "Mesh/Radial cells & Mesh/Angular cells = 4 & 48 | 8 & 96 | 16 & 192";
  const auto by_degree = [](const Parameters& p) { return std::pow(10., -1. * p.mesh.degree); };
  expect_orders(orders(both + "; Mesh/Degree = 1 | 2", "Mesh/Degree=2", by_degree), 2);
  expect_orders(orders("Mesh/Degree = 1 | 2; " + both, "Mesh/Degree=2", by_degree), 2);
  // From mesh to mesh, by the library.
  EXPECT_EQ(count(orders("Mesh/Global refinements = 0 | 1 | 2"), "1.50"), 2u);
  EXPECT_EQ(orders("Mesh/Degree = 1 | 2 | 3 | 4", "Mesh/Radial cells=4", by_degree), "");
}

} // namespace
