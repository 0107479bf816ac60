// Rows of a study: kept, found again, put into tables; orders of its errors.
#include "own_path.h"
#include "rollwave/run/quantities.h"
#include "rollwave/study/convergence.h"
#include "rollwave/study/study_csv.h"
#include "rollwave/study/study_runner.h"
#include "rollwave/study/study_solver.h"
#include "rollwave/study/study_table.h"
#include "test_scenes.h"

#include <deal.II/base/exceptions.h>
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

// Cut anywhere it has whole runs or none.
TEST(StudyCsv, IsReadInWholeLines) {
  const std::vector<std::string> settings = {"Study/Vary=Mesh/Degree = 1 | 2"};
  Study study = planned(settings);
  study.runs[0] = study.runs[1] = some_run();
  const std::string first = csv_header(study) + csv_row(study, 0), text = first + csv_row(study, 1);
  const Study empty = planned(settings);
  for (std::size_t size = 0; size + 1 < text.size(); ++size) { // the end of the last line may lack
    Study again = empty;
    read_csv(text.substr(0, size), again);
    ASSERT_EQ(again.runs[0].has_value(), size + 1 >= first.size()) << size;
    ASSERT_FALSE(again.runs[1]) << size;
  }
}

/// The numbers of the runs of a study that are taken over from a table.
std::vector<unsigned int> taken_over(Study study, const std::string& table) {
  read_csv(table, study);
  std::vector<unsigned int> runs;
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    if (study.runs[run])
      runs.push_back(run);
  return runs;
}

using Runs = std::vector<unsigned int>;

TEST(StudyCsv, RowsAreKnownByTheirParameters) {
  Study study = planned({"Study/Vary=Mesh/Degree = 1 | 2; Road/Distance = 0.7 | 0.8"});
  std::string table = csv_header(study);
  for (unsigned int run = 0; run < 4; ++run) {
    study.runs[run] = some_run();
    table += csv_row(study, run);
  }
  // Other orders, spellings, numbers of keys, names of scenes and of units.
  EXPECT_EQ(taken_over(planned({"Study/Vary= Road/Distance=8e-1|0.90 ; Mesh/Degree=02|1"}), table),
            (Runs{0, 1}));
  EXPECT_EQ(taken_over(planned({"Road/Distance=.7", "Study/Vary=Mesh/Degree=2|3",
                                "Output/Unit names=m, s, N", "Output/Files=contact"}),
                       table),
            (Runs{0}));
  EXPECT_EQ(taken_over(planned({"Study/Scenes=near: Road/Distance=0.70 & Mesh/Degree=1; "
                                "near: Road/Distance=0.8 & Mesh/Degree=1; far: Road/Distance=0.9"}),
                       table),
            (Runs{0, 1}));
  // Equal runs share a row, and equal rows count once.
  EXPECT_EQ(taken_over(planned({"Study/Vary=Road/Distance=0.8|0.80"}), table + table),
            (Runs{0, 1}));
  // A part has its own runs only.
  Study part = study;
  part.runs.assign(4, std::nullopt);
  part.part = StudyPart{2, 3};
  EXPECT_EQ(taken_over(part, table), (Runs{1}));
}

TEST(StudyCsv, RowsOfOtherParametersAreNotTakenOver) {
  const std::string vary = "Study/Vary=Mesh/Degree = 1 | 2";
  Study study = planned({vary});
  study.runs[0] = study.runs[1] = some_run();
  const std::string table = csv_header(study) + csv_row(study, 0) + csv_row(study, 1);
  ASSERT_EQ(taken_over(planned({vary}), table).size(), 2u);
  const std::vector<std::string> values = {"0.01",  "0.3",    "0.9",   "2",        "3",
                                           "17",    "400000", "none",  "auto",     "true",
                                           "false", "4, 5",   "kelly", "all",      "change",
                                           "gap",   "uzawa",  "total", "vertical", "active set"};
  for (const Key& key : all_keys()) {
    if (key.section == "Output" || (key.section == "Study" && key.name != "True errors") ||
        key.path() == "Mesh/Degree")
      continue;
    unsigned int n_others = 0;
    for (const std::string& value : values)
      try {
        const Study other = planned({vary, key.path() + '=' + value});
        if (value == key.default_value)
          continue;
        EXPECT_EQ(taken_over(other, table), Runs()) << key.path() << " = " << value;
        ++n_others;
      } catch (const BadInput&) { // for another key
      }
    EXPECT_GT(n_others, 0u) << key.path();
  }
}

TEST(StudyCsv, RowsThatCannotBeReadAreNotTakenOver) {
  const Study empty = planned({"Study/Vary=Mesh/Degree = 1 | 2"});
  Study study = empty;
  study.runs[0] = study.runs[1] = some_run();
  const std::string first = csv_row(study, 0), second = csv_row(study, 1),
                    force = ',' + shortest_text(study.runs[0]->values.at("contact.force")) + ',';
  ASSERT_EQ(taken_over(empty, first + second), (Runs{0, 1}));
  for (const char* const edited :
       {"abc", "\"0,33375\"", "0.33 N", "nan", "inf", "\"0.3", "1e999"}) {
    std::string text = first;
    text.replace(text.find(force) + 1, force.size() - 2, edited);
    EXPECT_EQ(taken_over(empty, text + second), Runs{1}) << edited;
    EXPECT_EQ(taken_over(empty, text + first), Runs{0}) << edited;
  }
  // After a stop within a row.
  EXPECT_EQ(taken_over(empty, first.substr(0, first.size() / 2) + '\n' + second), Runs{1});
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

  Parameters parameters(const std::vector<std::string>& assignments) const {
    std::vector<std::string> all = {"Mesh/Radial cells=2", "Mesh/Angular cells=24"};
    all.insert(all.end(), assignments.begin(), assignments.end());
    Parameters parameters = parameters_of(all);
    parameters.output.directory = directory.string();
    return parameters;
  }

  /// Runs a study, or a part of it, and returns how many rows it has reused.
  std::size_t run(const std::vector<std::string>& assignments,
                  const std::optional<StudyPart>& part = {}) const {
    const Parameters all = parameters(assignments);
    std::ostringstream out;
    Study study = plan_study(all, part);
    const unsigned int n_made = run_study(study, all, out);
    return study.n_ended() - n_made;
  }

  /// The study with the rows of study.csv.
  Study rows(const std::vector<std::string>& assignments) const {
    Study study = plan_study(parameters(assignments));
    read_csv(read("study.csv"), study);
    return study;
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

const std::string own_meshes = "Study/Vary=Mesh/Degree = 1 | 2 | 3";

TEST_F(RepeatedStudy, GoesOnWhereItIsTheSame) {
  EXPECT_EQ(run({own_meshes}), 0u);
  EXPECT_EQ(run({own_meshes}), 3u);
  EXPECT_EQ(run({own_meshes, "Cylinder/Angular velocity=0.4"}), 0u);
  EXPECT_EQ(run({own_meshes, "Cylinder/Angular velocity=0.4"}), 3u);
  EXPECT_EQ(run({"Study/Vary=Mesh/Degree=3|4|02", "Cylinder/Angular velocity=0.40"}), 2u);
}

// The rows of degree 2 are in all tables in the end, and those of other studies in none.
TEST_F(RepeatedStudy, HasItsOwnRowsInItsOrder) {
  run({"Study/Vary=Mesh/Degree = 4 | 2"});
  const std::string of_others = read("study.csv"), profiles_of_others = read("study-profiles.csv");
  run({"Study/Vary=Mesh/Degree = 1 | 2 | 3"});
  const std::string table = read("study.csv"), profiles = read("study-profiles.csv");
  // As after a stop, with the rows of another study and those of a copy.
  std::ofstream(directory / "study.csv") << of_others << table << table.substr(0, table.size() / 2);
  std::ofstream(directory / "study-profiles.csv") << profiles_of_others << profiles << profiles;
  EXPECT_EQ(run({"Study/Vary=Mesh/Degree = 1 | 2 | 3"}), 3u);
  EXPECT_EQ(read("study.csv"), table);
  EXPECT_EQ(read("study-profiles.csv"), profiles);
}

TEST_F(RepeatedStudy, MakesEqualRunsOnce) {
  EXPECT_EQ(run({"Study/Vary=Road/Distance = 0.8 | 0.9 | 0.80"}), 1u);
  const Study study = rows({"Study/Vary=Road/Distance = 0.8 | 0.9 | 0.80"});
  EXPECT_EQ(study.runs[0]->values, study.runs[2]->values);
}

TEST_F(RepeatedStudy, IsThatOfItsParts) {
  const std::vector<std::string> study = {
      "Study/Vary=Road/Distance = 0.7 | 0.8; Cylinder/Angular velocity = 0 | 0.5 | 1"};
  run(study);
  const Study whole = rows(study);
  fs::remove_all(directory);
  fs::create_directory(directory);
  EXPECT_EQ(run(study, StudyPart{2, 4}), 0u);
  EXPECT_EQ(count(read("study.part-2-of-4.csv"), "\n"), 3u); // runs 2 and 6
  EXPECT_EQ(run(study, StudyPart{2, 4}), 2u);
  EXPECT_EQ(run(study, StudyPart{1, 4}), 0u);
  EXPECT_EQ(run(study, StudyPart{1, 1}), 4u); // by parts in other numbers
  EXPECT_FALSE(fs::exists(directory / "study.csv"));
  EXPECT_EQ(run(study), 6u);
  const Study joined = rows(study);
  for (unsigned int i = 0; i < 6; ++i) {
    EXPECT_NEAR(*joined.value(i, "contact.force"), *whole.value(i, "contact.force"), 1e-10);
    EXPECT_GT(count(read("study-profiles.csv"), joined.plans[i].digest), 5u);
  }
  EXPECT_THROW(run(study, StudyPart{1, 7}), BadInput);
}

// The table may be removed while the study runs.
TEST_F(RepeatedStudy, HasAHeaderAlways) {
  const Parameters all = parameters({own_meshes});
  std::ostringstream out;
  Study study = plan_study(all);
  std::ofstream(directory / "study.csv"); // empty
  run_study(study, all, out);
  EXPECT_EQ(read("study.csv").find(csv_header(study)), 0u);
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
  const std::string vary = "Study/Vary=Road/Distance = 0.9 | 0.7";
  run({vary});
  EXPECT_EQ(run({files, vary}), 0u);
  EXPECT_TRUE(fs::exists(directory / "run-001" / "solution.vtu"));
  EXPECT_GT(read("run-002/contact.csv").size(), 100u);
  EXPECT_NE(read("study.csv").find(",run-002,"), std::string::npos);
  EXPECT_EQ(run({files, vary}), 2u);
  // Runs are made again if their files are not there, or those of other runs.
  fs::remove_all(directory / "run-002");
  EXPECT_EQ(run({files, vary}), 1u);
  EXPECT_TRUE(fs::exists(directory / "run-002" / "solution.vtu"));
  EXPECT_EQ(run({"Study/Files of each run=contact", vary}), 0u);
  EXPECT_EQ(run({"Study/Files of each run=contact", vary, "Output/Unit names=m, s, N"}), 0u);
  EXPECT_EQ(run({"Study/Files of each run=contact", "Study/Vary=Road/Distance=0.7"}), 0u);
  EXPECT_EQ(read_parameters(read_settings(directory / "run-001" / "parameters.prm")).road.distance,
            0.7);
  std::ofstream(directory / "run-001" / "parameters.prm") << "# mine\n";
  EXPECT_THROW(run({"Study/Files of each run=contact", vary}), BadValue);
}

// One failing run is a row, whatever has failed, and the others are made.
TEST_F(RepeatedStudy, GoesOnAfterAnExceptionOfALibrary) {
  const Parameters all =
      parameters({"Mesh/Adaptive cycles=1", "Study/Vary=Road/Distance = 0.7 | 0.8 | 0.9"});
  const Study study = plan_study(all);
  for (const bool is_of_library : {true, false}) {
    Progress progress;
    progress.mesh_solved = [&, n_meshes = 0](unsigned int, const CycleFigures&) mutable {
      if (++n_meshes == 3) // the first of the second run
        is_of_library ? throw dealii::ExcMessage("broken") : throw std::runtime_error("broken");
    };
    StudySolver solver(study.plans, all, directory, progress, MPI_COMM_SELF);
    for (unsigned int run = 0; run < 3; ++run) {
      const StudyRun made = solver.solve(run);
      EXPECT_EQ(made.is_solved(), run != 1) << made.failure;
      EXPECT_EQ(made.failure.find("broken") != std::string::npos, run == 1) << made.failure;
    }
  }
}

TEST_F(RepeatedStudy, NeverWritesOverTheFileItReads) {
  const std::vector<std::string> study = {"Study/Files of each run=contact", own_meshes};
  run(study);
  const std::string before = read("run-001/parameters.prm"), other = read("run-002/parameters.prm");
  Parameters all = parameters(study);
  all.file = directory / "run-001" / "parameters.prm";
  all.cylinder.angular_velocity = 0.4;
  all.settings.push_back({"Cylinder", "Angular velocity", "0.4", "test"});
  std::ostringstream out;
  Study again = plan_study(all);
  EXPECT_EQ(run_study(again, all, out), 3u);
  EXPECT_EQ(read("run-001/parameters.prm"), before);
  EXPECT_NE(read("run-002/parameters.prm"), other);
}

// With true errors every run is timed in full; without, its row says what it does not count.
TEST_F(RepeatedStudy, SaysWhatIsShared) {
  const std::vector<std::string> settings = {"Study/Vary=Road/Distance = 0.9 | 0.8"};
  const std::vector<std::string> timed = {settings[0], "Study/True errors=true"};
  run(timed);
  for (const auto& row : rows(timed).runs) {
    EXPECT_TRUE(row->shared.empty());
    EXPECT_TRUE(row->values.count("seconds.factorisation") > 0);
  }
  run(settings);
  const Study study = rows(settings);
  EXPECT_EQ(study.runs[0]->shared, "");
  EXPECT_EQ(study.runs[1]->shared, "mesh and matrices");
  EXPECT_EQ(study.runs[1]->values.count("seconds.factorisation"), 0u);
}

// The distance for a load is compared with the exact one, the other errors with those at its own.
TEST_F(RepeatedStudy, HasTheErrorOfTheDistanceForALoad) {
  const std::vector<std::string> settings = {"Road/Load=0.3", "Study/True errors=true",
                                             "Study/Vary=Mesh/Degree = 2"};
  run(settings);
  const double error = rows(settings).value(0, "error.exact_distance").value();
  EXPECT_GT(error, 0);
  EXPECT_LT(error, 1e-2);
}

// An error below the accuracy of the reference takes no other with it.
TEST_F(RepeatedStudy, HasTheErrorsThatTheReferenceResolves) {
  const std::vector<std::string> settings = {"Road/Distance=1.9", "Cylinder/Radial force=1",
                                             "Study/True errors=true",
                                             "Study/Vary=Mesh/Degree = 1 | 8"}; // without contact
  run(settings);
  const Study study = rows(settings);
  EXPECT_GT(study.value(0, "error.exact_relative").value_or(0), 1e-3);
  EXPECT_FALSE(study.value(1, "error.exact_relative"));
  EXPECT_LT(study.value(1, "error.exact_energy").value_or(1), 1e-9);
  EXPECT_EQ(study.value(1, "error.exact_force"), 0.);
  EXPECT_EQ(study.runs[1]->reference, study.runs[0]->reference);
}

TEST(StudyTable, IsReadByLatex) {
  Study study = planned({"Study/Scenes=a\\q_1 {50 % & $x^2~}: Road/Distance=0.7; b: Mesh/Degree=1",
                         "Study/Vary=Cylinder/Radial force = \"r > 0.7 || z < 4\""});
  study.runs[0] = study.runs[1] = some_run();
  const std::string tex = table_as_tex(study);
  for (const char* const part : {"a\\textbackslash{}q\\_1 \\{50 \\% \\& \\$x\\^{}2\\~{}\\}",
                                 "r > 0.7 || z < 4", "\\usepackage[T1]{fontenc}"})
    EXPECT_NE(tex.find(part), std::string::npos) << part << '\n' << tex;
  EXPECT_EQ(tex.find("\\documentclass"), 0u);
  EXPECT_EQ(count(tex, "\\begin{document}"), 1u);
  EXPECT_EQ(count(tex, "\\end{document}"), 1u);
}

/// The orders of a study with true errors, where the error of a run is the product of @p factor
/// and h^1.5, h = 1 / N_z for N_z cells around the ring, with as many unknowns as cells.
std::string orders(
    const std::string& vary, const std::string& setting = "Mesh/Degree=2",
    const std::function<double(const RunOptions&)>& factor = [](const RunOptions&) { return 1.; }) {
  Study study = planned({"Study/Vary=" + vary, "Study/True errors=true", setting});
  for (unsigned int i = 0; i < study.plans.size(); ++i) {
    const RunOptions& p = study.plans[i].parameters;
    const double cells = std::ldexp(p.mesh.radial_cells * p.mesh.angular_cells,
                                    2 * p.mesh.global_refinements),
                 h = 1 / std::ldexp(p.mesh.angular_cells, p.mesh.global_refinements);
    study.runs[i].emplace();
    study.runs[i]->values = {{"mesh.dofs", cells},
                             {"mesh.h_max", h},
                             {"error.exact_relative", factor(p) * std::pow(h, 1.5)},
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
  // Where one direction is refined, orders are in h, and none is expected.
  const std::string one = orders("Mesh/Angular cells = 48 | 96 | 200 | 384");
  expect_orders(one, 0);
  EXPECT_NE(one.find(" 1.5 +- 0"), std::string::npos) << one;
  // Each degree has its own.
  const std::string both = "Mesh/Radial cells & Mesh/Angular cells = 4 & 48 | 8 & 96 | 16 & 192";
  const auto by_degree = [](const RunOptions& p) { return std::pow(10., -1. * p.mesh.degree); };
  expect_orders(orders(both + "; Mesh/Degree = 1 | 2", "Mesh/Degree=2", by_degree), 2);
  expect_orders(orders("Mesh/Degree = 1 | 2; " + both, "Mesh/Degree=2", by_degree), 2);
  // From mesh to mesh, by the library.
  EXPECT_EQ(count(orders("Mesh/Global refinements = 0 | 1 | 2"), "1.50"), 2u);
  EXPECT_EQ(orders("Mesh/Degree = 1 | 2 | 3 | 4", "Mesh/Radial cells=4", by_degree), "");
}

} // namespace
