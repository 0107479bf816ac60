// The program as a user calls it: files, messages and exit codes.
#include "program.h"
#include "rollwave/parameters/parameters.h"
#include "rollwave/scene/scene.h"
#include "rollwave/study/study_plan.h"

#include <nlohmann/json.hpp>

#include <regex>

namespace fs = std::filesystem;
using namespace rollwave;

namespace {

TEST_F(Program, WritesEveryDocumentedFile) {
  const Outcome outcome = shell("$rollwave " + scene);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  const std::vector<std::string> names = {"contact.csv", "parameters.prm", "solution.vtu",
                                          "surface.vtu", "road.vtu",       "scene.gp",
                                          "scene.svg"};
  for (const std::string& name : names) {
    EXPECT_TRUE(has(name)) << name;
    EXPECT_NE(outcome.text.find(std::string("out/") + name), std::string::npos) << name;
  }
  expect_no_partial_files();

  const auto json = nlohmann::json::parse(read("summary.json"));
  EXPECT_EQ(json["scene"]["road_distance"], 0.8);
  EXPECT_EQ(json["mesh"]["dofs"], 4 * 2 * 60 * 2);
  EXPECT_NEAR(json["contact"]["force"].get<double>(), 0.3325, 1e-3);
  EXPECT_LT(json["residuals"]["equilibrium"].get<double>(), 1e-12);
  EXPECT_EQ(json["work"]["factorisations"], 2); // of the stiffness matrix and for the certificate
  EXPECT_LT(json["energy"]["lower_bound"], json["energy"]["upper_bound"]);
  EXPECT_LT(json["error"]["certified_relative"], 0.1);
  EXPECT_TRUE(json["cycles"][0]["indicated_error"].is_null()); // nothing was to be refined
  unsigned long bytes = 0;
  for (const std::string& name : names)
    if (name.find("scene.") != 0) // pictures come after the numbers
      bytes += fs::file_size(directory / "out" / name);
  EXPECT_EQ(json["work"]["bytes_written"], bytes);

  EXPECT_EQ(read("contact.csv").find("z,road_length,u,phi,gap,pressure,weight\n"), 0u);
  const auto rows = csv_rows(read("contact.csv"));
  double force = 0;
  for (const CsvRow& row : rows) {
    const auto number = [&row](const char* name) { return std::stod(row.at(name)); };
    EXPECT_NEAR(number("gap"), number("phi") - number("u"), 1e-15);
    EXPECT_NEAR(number("road_length"), 0.8 * std::tan(number("z") - 1.5 * M_PI), 1e-12);
    EXPECT_EQ(number("gap") * number("pressure"), 0);
    force += number("pressure") * number("weight");
  }
  EXPECT_NEAR(force, json["contact"]["force"].get<double>(), 1e-14);
  EXPECT_EQ(json["mesh"]["contact_nodes"], rows.size());
}

TEST_F(Program, ReproducesARunFromItsParameters) {
  ASSERT_EQ(shell("$rollwave " + scene +
                  " --set 'Cylinder/Radial force=0.1*r*cos(z)' --set Road/Load=0.2")
                .exit_code,
            0);
  const std::string first = read("contact.csv");
  const fs::path copy = directory / "copy.prm";
  fs::copy_file(directory / "out" / "parameters.prm", copy);
  ASSERT_EQ(shell("$rollwave '" + copy.string() + "'").exit_code, 0);
  EXPECT_EQ(read("contact.csv"), first);
}

// On the same adaptive meshes, and with Uzawa's step length, a pressure over a length, in the ratio
// of the modulus.
TEST_F(Program, ReproducesACalibrationFromItsParameters) {
  const std::string calibration = "$rollwave " + scene +
                                  " --set 'Material/Shear modulus=50' --set Material/Density=50 "
                                  "--set Road/Load=0.2 --set Road/Nip=0.7 ";
  for (const char* const more : {"--set 'Mesh/Wanted relative error=0.02'",
                                 "--set Contact/Method=uzawa --set Contact/Rho=100"}) {
    fs::remove_all(directory / "out");
    ASSERT_EQ(shell(calibration + more).exit_code, 0);
    const auto first = nlohmann::json::parse(read("summary.json"));
    const fs::path copy = directory / "calibrated.prm";
    fs::copy_file(directory / "out" / "parameters.prm", copy, fs::copy_options::overwrite_existing);
    const Outcome outcome = shell("$rollwave '" + copy.string() + "'");
    ASSERT_EQ(outcome.exit_code, 0) << more << outcome.text;
    const auto again = nlohmann::json::parse(read("summary.json"));
    for (const char* const name : {"/mesh/dofs", "/contact/length", "/contact/peak_pressure",
                                   "/contact/vertical_load", "/iterations/rho"}) {
      const nlohmann::json::json_pointer place(name);
      if (!first[place].is_number()) // the step length is that of Uzawa's method
        continue;
      const double expected = first[place];
      EXPECT_NEAR(again[place], expected, 1e-7 * expected) << name << more;
    }
  }
}

// Nothing is removed, and what a run has not written is named once.
TEST_F(Program, NamesFilesOfEarlierRuns) {
  const std::string study = "$rollwave " + scene +
                            " --set 'Study/Vary=Mesh/Degree = 1 | 2' --set "
                            "'Study/Files of each run=contact'";
  const Outcome first = shell(study);
  ASSERT_EQ(first.exit_code, 0) << first.text;
  EXPECT_EQ(first.text.find("older files"), std::string::npos) << first.text;
  EXPECT_EQ(shell(study).text.find("older files"), std::string::npos);
  const Outcome single = shell("$rollwave " + scene);
  const auto note = single.text.find("older files in this directory: ");
  ASSERT_NE(note, std::string::npos) << single.text;
  EXPECT_EQ(note, single.text.rfind("older files"));
  const std::string names = single.text.substr(note, single.text.find('\n', note) - note);
  for (const char* name : {"study.csv", "study.txt", "study.tex", "study-profiles.csv", "study.svg",
                           "study.gp", "runs"}) {
    EXPECT_NE(names.find(name), std::string::npos) << names;
    EXPECT_TRUE(has(name)) << name;
  }
  EXPECT_EQ(names.find("summary.json"), std::string::npos) << names;
  EXPECT_TRUE(has(csv_rows(read("study.csv")).front().at("files") + "/contact.csv"));
  const Outcome again = shell(study);
  EXPECT_NE(again.text.find("2 of 2 runs are reused"), std::string::npos) << again.text;
  EXPECT_NE(again.text.find("older files in this directory: contact.csv"), std::string::npos);
}

TEST_F(Program, RefusesToWriteOverFilesOfOthers) {
  for (const auto& [name, of_scene, of_study] : {std::tuple("parameters.prm", 1, 1),
                                                 {"summary.json", 1, 0},
                                                 {"contact.csv", 1, 0},
                                                 {"scene.gp", 1, 0},
                                                 {"study.csv", 0, 1},
                                                 {"study-h.svg", 0, 1},
                                                 {"notes.txt", 0, 0}}) {
    for (const std::string& text : {std::string("{ \"mine\": 1 }\n"), std::string()}) {
      fs::remove_all(directory / "out");
      fs::create_directories(directory / "out");
      std::ofstream(directory / "out" / name) << text;
      for (const auto& [option, code] :
           {std::pair("", of_scene), {" --set 'Study/Vary=Mesh/Degree = 1'", of_study}}) {
        const Outcome outcome = shell("$rollwave " + scene + option);
        EXPECT_EQ(outcome.exit_code, code) << name << option << outcome.text;
        EXPECT_EQ(read(name), text);
        if (code == 0)
          break; // parameters.prm makes the directory one of Rollwave
        EXPECT_NE(outcome.text.find(name), std::string::npos) << outcome.text;
        EXPECT_NE(outcome.text.find("--output"), std::string::npos) << outcome.text;
        EXPECT_FALSE(has("solution.vtu"));
      }
    }
  }
  // A link counts as a file, also without a target.
  fs::remove_all(directory / "out");
  fs::create_directories(directory / "out");
  fs::create_symlink(directory / "no-target", directory / "out" / "contact.csv");
  EXPECT_EQ(shell("$rollwave " + scene).exit_code, 1);
}

// Whatever its name is, and through a link.
TEST_F(Program, RefusesToWriteOverTheFileItReads) {
  ASSERT_EQ(shell("$rollwave " + scene).exit_code, 0);
  const std::string text = read("parameters.prm");
  for (const char* const name : {"contact.csv", "surface.vtu"}) {
    const fs::path file = directory / "out" / name;
    std::ofstream(file) << text;
    fs::create_symlink(file, directory / name);
    for (const fs::path& input : {file, directory / name})
      EXPECT_EQ(shell("$rollwave '" + input.string() + "'").exit_code, 1) << input;
    EXPECT_EQ(read(name), text);
    ASSERT_EQ(shell("$rollwave " + scene).exit_code, 0); // which may write it
  }
  EXPECT_EQ(shell("$rollwave '" + (directory / "out" / "parameters.prm").string() + "'").exit_code,
            0);
}

TEST_F(Program, MakesAStudyInParts) {
  const std::string study =
      "$rollwave " + scene + " --set 'Study/Vary=Road/Distance = 0.7 | 0.8 | 0.9'";
  for (const char* const wrong : {"0/2", "3/2", "1", "1/", "/2", "-1/2", "1/2/3", "a/b", "1/0",
                                  "99999999999/99999999999", "1.5/2"})
    EXPECT_EQ(shell(study + " --part " + wrong).exit_code, 1) << wrong;
  EXPECT_EQ(shell("$rollwave " + scene + " --part 1/2").exit_code, 1);
  EXPECT_FALSE(has("runs"));
  const Outcome none = shell(study + " --part 4/4");
  EXPECT_EQ(none.exit_code, 0) << none.text;
  const Outcome part = shell(study + " --part 1/2");
  ASSERT_EQ(part.exit_code, 0) << part.text;
  EXPECT_FALSE(has("study.csv") || has("study.txt"));
  EXPECT_NE(part.text.find("Part 1 of 2: 2 runs"), std::string::npos) << part.text;
  ASSERT_EQ(shell(study + " --part 2/2").exit_code, 0);
  const Outcome joined = shell(study);
  ASSERT_EQ(joined.exit_code, 0) << joined.text;
  EXPECT_NE(joined.text.find("3 of 3 runs are reused"), std::string::npos) << joined.text;
  EXPECT_EQ(joined.text.find("older files"), std::string::npos) << joined.text;
  EXPECT_EQ(csv_rows(read("study.csv")).size(), 3u);
  EXPECT_TRUE(has("study-curves.svg"));
}

// Neither its place nor how it is linked says which program has made a run.
TEST_F(Program, GoesOnWhenItIsInstalled) {
  const std::string study = scene + " --set 'Study/Vary=Road/Distance = 0.7 | 0.8'";
  ASSERT_EQ(shell("$rollwave " + study).exit_code, 0);
  const fs::path prefix = directory / "prefix";
  ASSERT_EQ(
      shell("cmake --install '" ROLLWAVE_BUILD_DIRECTORY "' --prefix '" + prefix.string() + "'")
          .exit_code,
      0);
  const Outcome again = shell("'" + (prefix / "bin" / "rollwave").string() + "' " + study);
  EXPECT_NE(again.text.find("2 of 2 runs are reused"), std::string::npos) << again.text;
}

TEST_F(Program, ReplacesALinkAndLeavesItsTarget) {
  const std::string study = "$rollwave " + scene + " --set 'Study/Vary=Road/Distance = 0.7 | 0.8'";
  ASSERT_EQ(shell(study).exit_code, 0);
  std::ofstream(directory / "target") << "mine\n";
  fs::remove(directory / "out" / "study.csv");
  fs::create_symlink(directory / "target", directory / "out" / "study.csv");
  ASSERT_EQ(shell(study).exit_code, 0);
  EXPECT_EQ(csv_rows(read("study.csv")).size(), 2u);
  EXPECT_FALSE(fs::is_symlink(directory / "out" / "study.csv"));
  EXPECT_EQ(fs::file_size(directory / "target"), 5u);
}

TEST_F(Program, DrawsItsPicturesAgainFromTheirScripts) {
  const std::string of_scenes = " --set 'Study/Vary=Road/Distance = 0.7 | 0.8; Cylinder/Angular "
                                "velocity = 0.5 | 1'",
                    of_meshes = " --set 'Study/Vary=Mesh/Global refinements = 0 | 1' --set "
                                "'Study/True errors=true'";
  for (const auto& [settings, least_pictures] :
       {std::pair(std::string(), 1u), {of_scenes, 2u}, {of_meshes, 3u}}) {
    fs::remove_all(directory / "out");
    ASSERT_EQ(shell("$rollwave " + scene + settings).exit_code, 0);
    unsigned int n_pictures = 0;
    for (const auto& entry : fs::directory_iterator(directory / "out"))
      if (fs::path picture = entry.path(); picture.extension() == ".svg") {
        const std::string name = picture.filename().string(), before = read(name);
        EXPECT_NE(before.find("</svg>"), std::string::npos) << name;
        fs::remove(picture);
        const std::string script = "'" + picture.replace_extension(".gp").string() + "'";
        EXPECT_EQ(
            shell("cd '" + (directory / "out").string() + "' && LC_ALL=C gnuplot " + script).text,
            "");
        EXPECT_EQ(read(name), before);
        ++n_pictures;
      }
    EXPECT_GE(n_pictures, least_pictures) << settings;
  }
}

TEST_F(Program, NeverWritesOverTheFileItReads) {
  const fs::path out = directory / "out", input = out / "parameters.prm", link = directory / "link";
  fs::create_directories(out);
  fs::copy_file(directory / "scene.prm", input);
  fs::create_symlink(input, link);
  const std::string before = read("parameters.prm");
  for (const std::string& arguments :
       {"'" + input.string() + "' --set Road/Distance=0.9", "'" + link.string() + "'",
        "'" + input.string() + "' --set 'Study/Vary=Mesh/Degree = 1'"}) {
    for (const auto& entry : fs::directory_iterator(out))
      if (entry.path() != input)
        fs::remove_all(entry.path());
    const Outcome outcome = shell("$rollwave " + arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
    EXPECT_EQ(read("parameters.prm"), before);
  }
}

TEST_F(Program, WritesToOutputNameByDefault) {
  std::ofstream(directory / "two scenes.prm") << "# nothing\n";
  const Outcome outcome = shell("cd '" + directory.string() + "' && $rollwave 'two scenes.prm'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;

  const fs::path used = directory / "output" / "two scenes" / "parameters.prm";
  ASSERT_TRUE(fs::exists(used));
  fs::copy_file(used, directory / "copy.prm");
  EXPECT_EQ(shell("cd '" + directory.string() + "' && $rollwave copy.prm").exit_code, 0);
  // It wrote into the directory of the first run.
  EXPECT_FALSE(fs::exists(directory / "output" / "copy"));
}

TEST_F(Program, WritesTheOtherFilesIfTheFieldCannotBeWritten) {
  ASSERT_EQ(shell("$rollwave " + scene + " --set Output/Files=parameters").exit_code, 0);
  fs::create_directories(directory / "out" / "solution.vtu");
  EXPECT_EQ(shell("$rollwave " + scene).exit_code, 3);
  for (const char* name : {"summary.json", "contact.csv", "parameters.prm", "scene.svg"})
    EXPECT_TRUE(has(name)) << name;
}

TEST_F(Program, OverridesTheFile) {
  const fs::path other = directory / "other";
  ASSERT_EQ(shell("$rollwave " + scene + " --output '" + other.string() +
                  "' --set 'Mesh/Degree = 1' --set 'Road/Distance=0.9'")
                .exit_code,
            0);
  EXPECT_FALSE(has("summary.json"));
  std::ifstream file(other / "summary.json");
  const auto json = nlohmann::json::parse(file);
  EXPECT_EQ(json["mesh"]["degree"], 1);
  EXPECT_EQ(json["scene"]["road_distance"], 0.9);
}

TEST_F(Program, PrintsHelpVersionAndParameters) {
  const Outcome help = shell("$rollwave --help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.text.find("Usage"), std::string::npos);
  EXPECT_NE(shell("$rollwave --version").text.find("deal.II"), std::string::npos);
  // The parameters it prints are a file that it accepts.
  const std::string defaults = "'" + (directory / "defaults.prm").string() + "'";
  ASSERT_EQ(shell("$rollwave --parameters > " + defaults).exit_code, 0);
  EXPECT_EQ(shell("$rollwave --parameters > /dev/full").exit_code, 3);
  EXPECT_EQ(shell("$rollwave " + defaults + " --set Output/Files= --output '" +
                  (directory / "out").string() + "'")
                .exit_code,
            0);
  // For a file they are those of a run of it.
  const std::string settings = " --set 'Road/Distance=0.9'";
  const std::string complete = shell("$rollwave --parameters " + scene + settings).text;
  ASSERT_EQ(shell("$rollwave " + scene + settings).exit_code, 0);
  const std::string used = read("parameters.prm");
  ASSERT_GT(complete.size(), 1000u);
  EXPECT_EQ(used.substr(used.size() - complete.size()), complete);
}

TEST_F(Program, RefusesBadInputInOneLineBeforeAnyWork) {
  const std::vector<std::string> calls = {
      "$rollwave",
      "$rollwave --nonsense",
      "$rollwave no_such_file.prm",
      "$rollwave " + scene + " --set Mesh/Degre=2",
      "$rollwave " + scene + " --set 'Cylinder/Angular velocity=1.5'",
      "$rollwave --verify " + scene + " --set 'Study/Vary=Road/Distance = 0.8'",
      "$rollwave " + scene + " --output /dev/null/out",
      "$rollwave " + scene + " --set 'Study/Vary=Road/Distance = 0.8 | 0.4'",
      "$rollwave " + scene +
          " --set 'Study/Vary=Road/Distance = 0.8' --set 'Study/Published "
          "steps=1, 2'"};
  for (const std::string& call : calls) {
    const Outcome outcome = shell(call);
    EXPECT_EQ(outcome.exit_code, 1) << call << '\n' << outcome.text;
    const auto message = outcome.text.find("rollwave: ");
    ASSERT_NE(message, std::string::npos) << call << '\n' << outcome.text;
    EXPECT_EQ(outcome.text.find("rollwave: ", message + 1), std::string::npos) << outcome.text;
    EXPECT_EQ(outcome.text.find("Contact steps"), std::string::npos) << outcome.text;
    EXPECT_FALSE(fs::exists(directory / "out")) << call;
  }
}

TEST_F(Program, SaysWhatWasReachedWhenItCannotSolve) {
  const Outcome outcome =
      shell("$rollwave " + scene + " --set Contact/Method=uzawa --set 'Contact/Most steps=3'");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
  EXPECT_NE(outcome.text.find("Contact/Most steps"), std::string::npos) << outcome.text;
  EXPECT_FALSE(has("summary.json"));
}

TEST_F(Program, LeavesTheOldFileWhenTheNewOneCannotBeWritten) {
  ASSERT_EQ(shell("$rollwave " + scene).exit_code, 0);
  const std::string before = read("solution.vtu");
  const Outcome full = shell("ulimit -f 8; $rollwave " + scene + " --set Mesh/Degree=1");
  ASSERT_EQ(full.exit_code, 3) << full.text;
  EXPECT_EQ(read("solution.vtu"), before);
}

TEST_F(Program, RunsAStudy) {
  const Outcome outcome = shell("$rollwave " + scene +
                                " --set 'Study/Vary=Mesh/Degree = 1 | 2; Road/Distance = 0.7 | 0.8 "
                                "| 1.1' --set 'Study/Published steps=4, -, -, -, -, 1'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  for (const char* name : {"study.csv", "study-profiles.csv", "study.txt", "study.tex", "study.svg",
                           "study-curves.svg", "study-profiles.svg", "parameters.prm"})
    EXPECT_TRUE(has(name)) << name;
  EXPECT_NE(outcome.text.find(read("study.txt")), std::string::npos);
  const auto rows = csv_rows(read("study.csv"));
  ASSERT_EQ(rows.size(), 6u);
  for (unsigned int run = 0; run < rows.size(); ++run) {
    EXPECT_EQ(rows[run].at("Mesh/Degree"), run < 3 ? "1" : "2");
    EXPECT_EQ(rows[run].at("Road/Distance"),
              (std::vector<std::string>{"0.7", "0.8", "1.1"}[run % 3]));
    EXPECT_EQ(rows[run].at("solved"), "1");
  }
}

/// The entry of study.pvd for the run of a row of study.csv.
std::string series_entry(const std::string& time, const CsvRow& row) {
  return "timestep=\"" + time + "\" group=\"\" part=\"0\" file=\"" + row.at("files") +
         "/solution.vtu\"";
}

// The scene of the file is not solved, so that it may be one that is refused.
TEST_F(Program, IgnoresTheSceneOfTheFileInAStudy) {
  const std::string study =
      "$rollwave " + scene +
      " --set 'Cylinder/Inner radius=33' --set 'Cylinder/Outer radius=35' --set "
      "'Cylinder/Angular velocity=0.01' --set 'Study/Vary=Cylinder/Radial force = 0 | 1; "
      "Road/Distance = 34.5 | 34'"
      " --set 'Study/Files of each run=solution'";
  const Outcome outcome = shell(study);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_EQ(outcome.text.find("distance 0.8"), std::string::npos) << outcome.text;
  const std::string series = read("study.pvd");
  // Each run has a time of its own.
  const auto rows = csv_rows(read("study.csv"));
  for (unsigned int run = 0; run < rows.size(); ++run)
    EXPECT_NE(series.find(series_entry(std::to_string(run + 1), rows[run])), std::string::npos)
        << series;
}

TEST_F(Program, GivesFieldsTheTimesOfTheKeyThatVaries) {
  for (const auto& [values, time_of_second] :
       {std::pair("0.9 | 0.7", "0.7"), {"0.9 | 0.90", "2"}}) {
    ASSERT_EQ(shell("$rollwave " + scene + " --set 'Study/Vary=Road/Distance = " + values +
                    "' --set 'Study/Files of each run=solution'")
                  .exit_code,
              0);
    const std::string series = read("study.pvd");
    EXPECT_NE(series.find(series_entry(time_of_second, csv_rows(read("study.csv"))[1])),
              std::string::npos)
        << series;
  }
}

TEST_F(Program, VerifiesAScene) {
  const Outcome outcome = shell("$rollwave --verify " + scene);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("0.332498976"), std::string::npos) << outcome.text;
  const auto json = nlohmann::json::parse(read("summary.json"));
  const double relative = json["error"]["exact_relative"];
  EXPECT_GT(relative, 1e-4);
  EXPECT_LT(relative, 3e-2);
  EXPECT_GE(json["error"]["certified_energy_norm"].get<double>(),
            json["error"]["exact_energy_norm"].get<double>());
  const Outcome unknown = shell("$rollwave --verify " + scene + " --set 'Cylinder/Radial force=r'");
  EXPECT_EQ(unknown.exit_code, 0) << unknown.text;
  EXPECT_TRUE(nlohmann::json::parse(read("summary.json"))["error"]["exact_relative"].is_null());
  ASSERT_EQ(shell("$rollwave --verify " + scene + " --set 'Cylinder/Radial force=1/2'").exit_code,
            0);
  EXPECT_FALSE(nlohmann::json::parse(read("summary.json"))["error"]["exact_relative"].is_null());
}

TEST_F(Program, RefinesUntilTheWantedErrorIsCertified) {
  const std::string wanted = "$rollwave " + scene + " --set 'Mesh/Wanted relative error=3e-3'";
  const Outcome reached = shell(wanted);
  ASSERT_EQ(reached.exit_code, 0) << reached.text;
  auto json = nlohmann::json::parse(read("summary.json"));
  EXPECT_LE(json["error"]["certified_relative"], 3e-3);
  const auto& cycles = json["cycles"];
  ASSERT_GT(cycles.size(), 2u);
  // Where a mesh before the last was certified, the error was too large.
  for (unsigned int i = 0; i + 1 < cycles.size(); ++i)
    if (!cycles[i]["certified_relative"].is_null()) {
      EXPECT_GT(cycles[i]["certified_relative"], 3e-3);
    }
  for (unsigned int i = 1; i < cycles.size(); ++i)
    EXPECT_LE(cycles[i]["contact_steps"], 4);
  // The result that was reached is kept, and the missing target reported.
  const Outcome limited = shell(wanted + " --set 'Mesh/Adaptive cycles=1'");
  EXPECT_EQ(limited.exit_code, 2) << limited.text;
  json = nlohmann::json::parse(read("summary.json"));
  EXPECT_EQ(json["cycles"].size(), 2u);
  const Outcome refused = shell(wanted + " --set 'Certificate/Error bound=false'");
  EXPECT_EQ(refused.exit_code, 1) << refused.text;
  EXPECT_NE(refused.text.find("Wanted relative error"), std::string::npos) << refused.text;
}

// As the parameter files say.
TEST_F(Program, AdaptivePaperFiguresNeedFewUnknowns) {
  for (const char* file : {"figure-4-adaptive.prm", "figure-5-adaptive.prm"}) {
    const Outcome outcome =
        shell("$rollwave --verify '" ROLLWAVE_PRM_DIRECTORY "/" + std::string(file) +
              "' --set Output/Files=summary --output '" + (directory / "out").string() + "'");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
    const auto json = nlohmann::json::parse(read("summary.json"));
    EXPECT_LE(json["mesh"]["dofs"], 25000) << file;
    EXPECT_LE(json["error"]["exact_relative"], 1e-4) << file;
    const auto& cycles = json["cycles"];
    for (unsigned int i = 1; i < cycles.size(); ++i)
      EXPECT_LE(cycles[i]["contact_steps"], 4) << file;
  }
}

TEST_F(Program, GivesCertifiedErrorsWhereNoExactSolutionIsKnown) {
  const Outcome outcome =
      shell("$rollwave " + scene +
            " --set 'Cylinder/Radial force=r*cos(z)' --set 'Study/True errors=true' --set "
            "'Study/Vary=Mesh/Global refinements = 0 | 1'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_EQ(read("study.txt").find("Errors against"), std::string::npos);
  EXPECT_NE(read("study.txt").find("certified"), std::string::npos);
}

TEST_F(Program, ReportsWhatAStudyCouldNotSolve) {
  const Outcome outcome = shell(
      "$rollwave " + scene + " --set Contact/Method=uzawa --set 'Study/Vary=Contact/Rho = 1 | 50'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("diverges"), std::string::npos);
  EXPECT_NE(read("study.csv").find("\n50,0,"), std::string::npos);
}

TEST_F(Program, RunsNamedScenesOfAStudy) {
  const Outcome outcome =
      shell("$rollwave " + scene +
            " --set 'Study/Scenes=hairline: Road/Distance = 0.9999; fast, thin: Cylinder/Angular "
            "velocity = 1 & Cylinder/Inner radius = 0.9 & Road/Distance = 0.95'"
            " --set 'Study/Vary=Mesh/Degree = 1 | 2' --set 'Study/True errors=true'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  const std::string csv = read("study.csv");
  EXPECT_EQ(csv.find("scene,Mesh/Degree,solved"), 0u) << csv;
  for (const char* const row : {"\nhairline,1,1", "\n\"fast, thin\",2,1"})
    EXPECT_NE(csv.find(row), std::string::npos) << row;
  EXPECT_EQ(shell("$rollwave " + scene + " --set 'Study/Scenes=Road/Distance = 0.9'").exit_code, 1);
}

TEST_F(Program, DrawsProfilesOfAllScenes) {
  ASSERT_EQ(shell("$rollwave " + scene +
                  " --set 'Study/Scenes=one: Mesh/Degree = 1; two: Mesh/Degree = 2' --set "
                  "'Study/Vary=Road/Distance = 0.7 : 0.9 : 0.05'")
                .exit_code,
            0);
  for (const char* const name : {"one, c = ", "two, c = "})
    EXPECT_NE(read("study-profiles.gp").find(name), std::string::npos) << name;
}

TEST(Study, ScenesOfTheExtremesAreAdmitted) {
  const Parameters parameters =
      read_parameters(read_settings(ROLLWAVE_PRM_DIRECTORY "/studies/extremes.prm"));
  EXPECT_GT(parameters.study.scenes.size(), 40u);
  for (const auto& named : parameters.study.scenes) {
    std::vector<Setting> settings = parameters.settings;
    settings.insert(settings.end(), named.settings.begin(), named.settings.end());
    EXPECT_NO_THROW(make_scene(read_parameters(settings))) << named.name;
  }
}

class ShippedFile : public Program, public testing::WithParamInterface<std::string> {
protected:
  /// The values in the comment of the file, such as "# Exact: half-width 0.5, F = 0.3, J = 0.03,
  /// peak pressure 0.4".
  void expect_values_of_the_comment() const {
    std::ifstream file(ROLLWAVE_PRM_DIRECTORY "/" + GetParam());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    std::smatch exact;
    if (!std::regex_search(text, exact,
                           std::regex("Exact: half-width ([0-9.]+), F = ([0-9.]+), "
                                      "J = (-?[0-9.]+), peak pressure ([0-9.]+[0-9])")))
      return;
    const auto json = nlohmann::json::parse(read("summary.json"));
    const auto expect_near = [&](const char* name, unsigned int group, double tolerance) {
      const double wanted = std::stod(exact[group]);
      EXPECT_NEAR(json.at(nlohmann::json::json_pointer(name)).get<double>(), wanted,
                  tolerance * std::abs(wanted))
          << name;
    };
    expect_near("/contact/half_width", 1, 1.2e-3);
    expect_near("/contact/force", 2, 1e-4);
    expect_near("/energy/value", 3, 1e-5);
    expect_near("/contact/peak_pressure", 4, 1e-3);
  }

  /// @param n_unsolved runs that the comment of the file says cannot be solved
  void expect_every_row_as_wanted(int n_unsolved) const {
    const auto rows = csv_rows(read("study.csv"));
    const auto is_as_wanted = [](const CsvRow& row) {
      return row.at("solved") == "1" && row.at("failure").empty();
    };
    EXPECT_GT(rows.size(), 1u);
    EXPECT_EQ(std::count_if(rows.begin(), rows.end(), is_as_wanted), int(rows.size()) - n_unsolved)
        << read("study.txt");
  }
};

TEST_P(ShippedFile, Runs) {
  // A convergence study is cut down to its first runs.
  const bool is_long = GetParam().find("studies/") == 0;
  if (is_long) {
    EXPECT_NO_THROW(
        plan_runs(read_parameters(read_settings(ROLLWAVE_PRM_DIRECTORY "/" + GetParam()))));
  }
  const bool is_adaptive = GetParam().find("order-") == std::string::npos &&
                           GetParam().find("time-") == std::string::npos;
  const bool has_scenes = GetParam().find("extremes") != std::string::npos;
  const std::string meshes = has_scenes    ? "Mesh/Radial cells = 4"
                             : is_adaptive ? "Mesh/Most unknowns = 200 | 800"
                                           : "Mesh/Global refinements = 0 | 1 | 2 | 3";
  const Outcome outcome =
      shell("$rollwave '" ROLLWAVE_PRM_DIRECTORY "/" + GetParam() + "' --output '" +
            (directory / "out").string() + "'" +
            (is_long ? " --set Study/Scenes= --set 'Study/Vary=Mesh/Degree = 1 | 2; " + meshes + "'"
                     : std::string()));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  if (has("study.csv"))
    expect_every_row_as_wanted(GetParam() == "figure-9.prm" ? 1 : 0);
  else
    expect_values_of_the_comment();
}

std::vector<std::string> shipped_files() {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(ROLLWAVE_PRM_DIRECTORY))
    if (entry.path().extension() == ".prm")
      names.push_back(fs::relative(entry.path(), ROLLWAVE_PRM_DIRECTORY).string());
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(, ShippedFile, testing::ValuesIn(shipped_files()), [](const auto& info) {
  std::string name = info.param;
  for (char& c : name)
    c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
});

} // namespace
