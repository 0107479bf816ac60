// Runs of a study: kept, found again, put into tables; orders of its errors.
#include "own_path.h"
#include "rollwave/base/text.h"
#include "rollwave/run/quantities.h"
#include "rollwave/study/convergence.h"
#include "rollwave/study/run_record.h"
#include "rollwave/study/study_files.h"
#include "rollwave/study/study_runner.h"
#include "rollwave/study/study_solver.h"
#include "rollwave/study/study_table.h"
#include "test_scenes.h"

#include <deal.II/base/exceptions.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <set>
#include <sstream>

namespace fs = std::filesystem;
using namespace rollwave;

namespace {

Study planned(const std::vector<std::string>& assignments) {
  return plan_study(parameters_of(assignments));
}

/// Texts with what JSON and CSV files treat specially, and figures of many digits, one of them not
/// known.
RunRecord some_record() {
  RunRecord record;
  for (const ResultQuantity& quantity : result_quantities())
    record.values[quantity.name] = 1. / (3 + record.values.size());
  record.values.erase("contact.half_width");
  record.reference = "the semi-analytic solution";
  record.notes = {{Note::Kind::shortfall, "no \"way\", at\nall"},
                  {Note::Kind::remark, "\"rough\", or so"},
                  {Note::Kind::remark, "ζ"},
                  {Note::Kind::remark, "\xff"}};
  record.profile = {{4.5, -0.2, 0}, {4.6, -0.1, 1. / 7}};
  record.files = {{OutputFile::parameters, OutputFile::surface}, {{"Unit names", "m, s, N"}}};
  record.sizes = {{"surface.vtu", 3000000000}, {"road.vtu", 1}};
  return record;
}

TEST(RunRecord, IsReadAsItWasWritten) {
  const RunRecord record = some_record();
  const auto again = from_json(to_json(record, "digest"), "digest");
  ASSERT_TRUE(again);
  EXPECT_EQ(again->values, record.values);
  EXPECT_EQ(again->reference, record.reference);
  ASSERT_EQ(again->notes.size(), record.notes.size());
  for (unsigned int i = 0; i < 3; ++i) { // the last one is no UTF-8
    EXPECT_EQ(again->notes[i].kind, record.notes[i].kind);
    EXPECT_EQ(again->notes[i].text, record.notes[i].text);
  }
  EXPECT_EQ(again->profile, record.profile);
  EXPECT_TRUE(again->files.include(record.files) && record.files.include(again->files));
  EXPECT_EQ(again->sizes, record.sizes);
}

TEST(RunRecord, IsWholeAndOfItsRunOrNone) {
  const std::string text = to_json(some_record(), "digest");
  for (std::size_t size = 0; size + 1 < text.size(); ++size) // the end of the last line may lack
    ASSERT_FALSE(from_json(text.substr(0, size), "digest")) << size;
  EXPECT_FALSE(from_json(text, "other"));
  RunRecord failed = some_record();
  failed.values.clear();
  EXPECT_FALSE(from_json(to_json(failed, "digest"), "digest"));
  const std::string force = shortest_text(some_record().values.at("contact.force"));
  for (const char* const edited : {"abc", "\"0,33375\"", "0.33 N", "nan", "null", "1e999"}) {
    std::string other = text;
    other.replace(other.find(force), force.size(), edited);
    EXPECT_FALSE(from_json(other, "digest")) << edited;
  }
}

std::vector<std::string> digests(const std::vector<std::string>& assignments) {
  std::vector<std::string> all;
  for (const RunPlan& plan : planned(assignments).plans)
    all.push_back(plan.digest);
  return all;
}

TEST(Digest, IsThatOfTheParameters) {
  const auto all = digests({"Study/Vary=Mesh/Degree = 1 | 2; Road/Distance = 0.7 | 0.8"});
  EXPECT_EQ(std::set(all.begin(), all.end()).size(), 4u);
  // Other orders, spellings, numbers of keys, names of scenes and of units, and files.
  EXPECT_EQ(digests({"Study/Vary= Road/Distance=8e-1|0.70 ; Mesh/Degree=02|1"}),
            (std::vector<std::string>{all[3], all[1], all[2], all[0]}));
  EXPECT_EQ(
      digests({"Road/Distance=.7", "Study/Vary=Mesh/Degree=2", "Output/Unit names=m, s, N",
               "Output/Files=contact", "Study/Files of each run=contact", "Output/Cells=linear"}),
      (std::vector<std::string>{all[2]}));
  EXPECT_EQ(digests({"Study/Scenes=near: Road/Distance=0.7 & Mesh/Degree=1; "
                     "far: Road/Distance=0.8 & Mesh/Degree=1"}),
            (std::vector<std::string>{all[0], all[1]}));
}

TEST(Digest, DiffersForOtherParameters) {
  const std::string vary = "Study/Vary=Mesh/Degree = 1 | 2";
  const auto own = digests({vary});
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
        const auto other = digests({vary, key.path() + '=' + value});
        if (value == key.default_value)
          continue;
        EXPECT_NE(other[0], own[0]) << key.path() << " = " << value;
        EXPECT_NE(other[1], own[1]) << key.path() << " = " << value;
        ++n_others;
      } catch (const BadInput&) { // for another key
      }
    EXPECT_GT(n_others, 0u) << key.path();
  }
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

  /// Runs a study, or a part of it, and returns how many runs it has reused.
  std::size_t run(const std::vector<std::string>& assignments,
                  const std::optional<StudyPart>& part = {}) const {
    const Parameters all = parameters(assignments);
    std::ostringstream out;
    Study study = plan_study(all, part);
    const unsigned int n_made = run_study(study, all, out);
    if (!part)
      write_study(all, study, study_text(study), {});
    return study.n_ended() - n_made;
  }

  /// The study with the runs that are known.
  Study known(const std::vector<std::string>& assignments) const {
    Study study = plan_study(parameters(assignments));
    for (unsigned int run = 0; run < study.plans.size(); ++run)
      study.runs[run] = known_run(directory, study.plans[run].digest, study.files);
    return study;
  }

  fs::path record_of(const RunPlan& plan) const {
    return directory / "runs" / (plan.digest + ".json");
  }

  std::string read(const fs::path& name) const {
    std::ostringstream text;
    text << std::ifstream(directory / name).rdbuf();
    return text.str();
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

// Degree 2 is in both studies.
TEST_F(RepeatedStudy, HasItsOwnTables) {
  const std::vector<std::string> other = {"Study/Vary=Mesh/Degree = 4 | 2"};
  run(other);
  const std::string of_other = read("study.csv"), profiles_of_other = read("study-profiles.csv");
  EXPECT_EQ(run({own_meshes}), 1u);
  const std::string table = read("study.csv"), profiles = read("study-profiles.csv");
  EXPECT_EQ(count(table, "\n"), 4u);
  // Tables are never read.
  for (const char* const name : {"study.csv", "study-profiles.csv"})
    std::ofstream(directory / name) << "Mesh/Degree,solved\n1,0\n";
  EXPECT_EQ(run({own_meshes}), 3u);
  EXPECT_EQ(read("study.csv"), table);
  EXPECT_EQ(read("study-profiles.csv"), profiles);
  EXPECT_EQ(run(other), 2u);
  EXPECT_EQ(read("study.csv"), of_other);
  EXPECT_EQ(read("study-profiles.csv"), profiles_of_other);
}

TEST_F(RepeatedStudy, MayBeMoved) {
  run({own_meshes, "Study/Files of each run=contact"});
  const std::string table = read("study.csv");
  const fs::path other = directory.string() + "_moved";
  fs::remove_all(other);
  fs::rename(directory, other);
  fs::create_directory(directory);
  fs::rename(other / "runs", directory / "runs"); // the records alone are enough
  EXPECT_EQ(run({own_meshes, "Study/Files of each run=contact"}), 3u);
  EXPECT_EQ(read("study.csv"), table);
  fs::remove_all(other);
}

TEST_F(RepeatedStudy, MakesRunsWithoutAWholeRecordAgain) {
  run({own_meshes});
  const auto plans = plan_study(parameters({own_meshes})).plans;
  const std::string second = read("runs/" + plans[1].digest + ".json");
  for (const std::string& text : {second.substr(0, second.size() / 2), std::string(), second}) {
    std::ofstream(record_of(plans[0])) << text; // cut, emptied, of another digest
    EXPECT_EQ(run({own_meshes}), 2u);
    EXPECT_EQ(known({own_meshes}).value(0, "mesh.degree"), 1);
  }
  EXPECT_EQ(read("runs/" + plans[1].digest + ".json"), second);
}

TEST_F(RepeatedStudy, MakesEqualRunsOnce) {
  EXPECT_EQ(run({"Study/Vary=Road/Distance = 0.8 | 0.9 | 0.80"}), 1u);
  const Study study = known({"Study/Vary=Road/Distance = 0.8 | 0.9 | 0.80"});
  EXPECT_EQ(study.runs[0]->values, study.runs[2]->values);
}

TEST_F(RepeatedStudy, IsThatOfItsParts) {
  const std::vector<std::string> study = {
      "Study/Vary=Road/Distance = 0.7 | 0.8; Cylinder/Angular velocity = 0 | 0.5 | 1"};
  run(study);
  const Study whole = known(study);
  fs::remove_all(directory);
  fs::create_directory(directory);
  EXPECT_EQ(run(study, StudyPart{2, 4}), 0u);
  EXPECT_EQ(known(study).n_ended(), 2u); // runs 2 and 6
  EXPECT_EQ(run(study, StudyPart{2, 4}), 2u);
  EXPECT_EQ(run(study, StudyPart{1, 4}), 0u);
  EXPECT_EQ(run(study, StudyPart{1, 1}), 4u); // by parts in other numbers
  EXPECT_EQ(run(study, StudyPart{7, 7}), 0u); // which has no runs
  EXPECT_FALSE(fs::exists(directory / "study.csv"));
  EXPECT_EQ(run(study), 6u);
  const Study joined = known(study);
  for (unsigned int i = 0; i < 6; ++i) {
    EXPECT_NEAR(*joined.value(i, "contact.force"), *whole.value(i, "contact.force"), 1e-10);
    EXPECT_GT(count(read("study-profiles.csv"), joined.plans[i].digest), 5u);
  }
}

// Runs 1 and 3 of a part have one mesh and speed, but run 3 has a wider zone of contact. Between
// them lies a run of the other part: of another speed, or of the same one.
TEST_F(RepeatedStudy, PartsWithGrowingZonesAreSolved) {
  const std::vector<std::string> study = {
      "Study/Vary=Road/Distance = 0.9 | 0.8; Cylinder/Angular velocity = 0.25 | 0.5"};
  const std::vector<std::string> of_one_speed = {"Study/Vary=Road/Distance = 0.9 | 0.95 | 0.7"};
  for (const auto& settings : {study, of_one_speed})
    for (const StudyPart part : {StudyPart{1, 2}, StudyPart{2, 2}})
      run(settings, part);
  for (const auto& settings : {study, of_one_speed}) {
    const Study made = known(settings);
    for (unsigned int i = 0; i < made.plans.size(); ++i)
      EXPECT_GT(made.value(i, "contact.force").value_or(0), 0) << i;
  }
}

TEST_F(RepeatedStudy, MakesRunsAgainThatLackFiles) {
  const std::string vary = "Study/Vary=Road/Distance = 0.9 | 0.7";
  const std::vector<std::string> study = {"Study/Files of each run=contact, solution", vary};
  run({vary});
  EXPECT_EQ(run(study), 0u);
  EXPECT_EQ(run(study), 2u);
  const Study own = known(study);
  const fs::path files = directory / directory_of_run(own.plans[1].digest);
  EXPECT_EQ(read_parameters(read_settings(files / "parameters.prm")).road.distance, 0.7);
  EXPECT_EQ(count(read("study.csv"), directory_of_run(own.plans[1].digest).string()), 1u);
  fs::remove(files / "solution.vtu");
  EXPECT_EQ(run(study), 1u);
  EXPECT_TRUE(fs::exists(files / "solution.vtu"));
  std::ofstream(files / "contact.csv").close();
  EXPECT_EQ(run(study), 1u);
  EXPECT_GT(fs::file_size(files / "contact.csv"), 100u);
  EXPECT_EQ(run({study[0], study[1], "Output/Picture format=pdf"}), 2u); // it has none
  // Other cells and names of units make other files.
  for (const char* const other : {"Output/Cells=linear", "Output/Unit names=m, s, N"}) {
    EXPECT_EQ(run({study[0], study[1], other}), 0u);
    EXPECT_EQ(run({study[0], study[1], other}), 2u);
    EXPECT_EQ(run(study), 0u);
  }
  EXPECT_EQ(run({vary, "Output/Unit names=m, s, N"}), 2u);
  EXPECT_EQ(read("study.csv").find("runs/"), std::string::npos); // without files
}

// In one directory, with a run in common.
TEST_F(RepeatedStudy, HasTheFilesOfItsRunsNextToThoseOfAnother) {
  const std::vector<std::string> one = {"Study/Files of each run=summary, solution",
                                        "Study/Vary=Road/Distance = 0.7 | 0.8"},
                                 other = {"Study/Files of each run=contact",
                                          "Study/Vary=Road/Distance = 0.8 | 0.9"};
  EXPECT_EQ(run(one, StudyPart{1, 2}), 0u);
  EXPECT_EQ(run(one, StudyPart{2, 2}), 0u);
  EXPECT_EQ(run(one), 2u);
  const auto series_of_fields = [&] { // without the date
    const std::string text = read("study.pvd");
    return text.substr(text.find("<Collection>"));
  };
  const std::string series = series_of_fields();
  EXPECT_EQ(run(other), 0u); // the common run lacks contact.csv
  EXPECT_EQ(run(other), 2u);
  EXPECT_EQ(run(one), 2u);
  EXPECT_EQ(series_of_fields(), series);
  const Study study = known(one);
  for (unsigned int i = 0; i < 2; ++i)
    EXPECT_EQ(nlohmann::json::parse(read(directory_of_run(study.plans[i].digest) /
                                         "summary.json"))["scene"]["road_distance"],
              i == 0 ? 0.7 : 0.8);
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
    StudySolver solver(study.plans, all, progress, MPI_COMM_SELF);
    for (unsigned int run = 0; run < 3; ++run) {
      const RunRecord made = solver.record_of(run, {});
      const std::string failure = shortfall_text(made.notes);
      EXPECT_EQ(made.is_solved(), run != 1) << failure;
      EXPECT_EQ(failure.find("broken") != std::string::npos, run == 1) << failure;
    }
  }
}

TEST_F(RepeatedStudy, NeverWritesOverTheFileItReads) {
  const std::vector<std::string> study = {"Study/Files of each run=contact", own_meshes};
  run(study);
  const auto plans = plan_study(parameters(study)).plans;
  const auto path_of = [&](unsigned int run) {
    return directory_of_run(plans[run].digest) / "parameters.prm";
  };
  for (const unsigned int run : {0, 1}) {
    std::ofstream(directory / path_of(run)) << "# mine\n";
    fs::remove(record_of(plans[run]));
  }
  Parameters all = parameters(study);
  all.file = directory / path_of(0);
  std::ostringstream out;
  Study again = plan_study(all);
  EXPECT_EQ(run_study(again, all, out), 2u);
  EXPECT_EQ(read(path_of(0)), "# mine\n");
  EXPECT_NE(read(path_of(1)), "# mine\n");
  EXPECT_EQ(run(study), 3u);
}

// With true errors every run is timed in full; without, its row says what it does not count.
TEST_F(RepeatedStudy, SaysWhatIsShared) {
  const std::vector<std::string> settings = {"Study/Vary=Road/Distance = 0.9 | 0.8"};
  const std::vector<std::string> timed = {settings[0], "Study/True errors=true"};
  run(timed);
  for (const auto& row : known(timed).runs) {
    EXPECT_TRUE(row->shared.empty());
    EXPECT_TRUE(row->values.count("seconds.factorisation") > 0);
  }
  run(settings);
  const Study study = known(settings);
  EXPECT_EQ(study.runs[0]->shared, "");
  EXPECT_EQ(study.runs[1]->shared, "mesh and matrices");
  EXPECT_EQ(study.runs[1]->values.count("seconds.factorisation"), 0u);
}

// The modulus is an effective one, and depends on the thickness.
TEST_F(RepeatedStudy, RemarksOnOneModulusForSeveralThicknesses) {
  const auto has_remark = [this](const std::string& vary) {
    run({"Mesh/Degree=1", "Road/Distance=0.95", "Material/Shear modulus=2", "Study/Vary=" + vary});
    return read("study.txt").find("under one shear modulus") != std::string::npos;
  };
  EXPECT_TRUE(has_remark("Cylinder/Inner radius = 0.5 | 0.6"));
  EXPECT_TRUE(has_remark("Cylinder/Outer radius = 1 | 1.1"));
  EXPECT_FALSE(has_remark("Road/Distance = 0.8 | 0.9"));
  EXPECT_FALSE(has_remark("Cylinder/Inner radius & Cylinder/Outer radius = 0.5 & 1 | 0.6 & 1.1"));
  EXPECT_FALSE(has_remark("Cylinder/Inner radius & Material/Shear modulus = 0.5 & 2 | 0.6 & 3"));
}

// The distance for a load is compared with the exact one, the other errors with those at its own.
TEST_F(RepeatedStudy, HasTheErrorOfTheDistanceForALoad) {
  const std::vector<std::string> settings = {"Road/Load=0.3", "Study/True errors=true",
                                             "Study/Vary=Mesh/Degree = 2"};
  run(settings);
  const double error = known(settings).value(0, "error.exact_distance").value();
  EXPECT_GT(error, 0);
  EXPECT_LT(error, 1e-2);
}

// An error below the accuracy of the reference takes no other with it.
TEST_F(RepeatedStudy, HasTheErrorsThatTheReferenceResolves) {
  const std::vector<std::string> settings = {"Road/Distance=1.9", "Cylinder/Radial force=1",
                                             "Study/True errors=true",
                                             "Study/Vary=Mesh/Degree = 1 | 8"}; // without contact
  run(settings);
  const Study study = known(settings);
  EXPECT_GT(study.value(0, "error.exact_relative").value_or(0), 1e-3);
  EXPECT_FALSE(study.value(1, "error.exact_relative"));
  EXPECT_LT(study.value(1, "error.exact_energy").value_or(1), 1e-9);
  EXPECT_EQ(study.value(1, "error.exact_force"), 0.);
  EXPECT_EQ(study.runs[1]->reference, study.runs[0]->reference);
}

TEST(StudyTable, IsReadByLatex) {
  Study study = planned({"Study/Scenes=a\\q_1 {50 % & $x^2~}: Road/Distance=0.7; b: Mesh/Degree=1",
                         "Study/Vary=Cylinder/Radial force = \"r > 0.7 || z < 4\""});
  study.runs[0] = study.runs[1] = some_record();
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
