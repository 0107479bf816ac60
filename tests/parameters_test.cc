// Every value a key admits is read, everything else is refused in one message with all that helps.
#include "own_path.h"
#include "rollwave/base/errors.h"
#include "rollwave/parameters/command_line.h"
#include "rollwave/parameters/parameters.h"
#include "rollwave/scene/scene.h"
#include "rollwave/study/study_plan.h"
#include "test_scenes.h"

#include <deal.II/base/parameter_handler.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace rollwave;

namespace {

/// The message that refuses a scene or a study with these settings; empty where none does.
std::string refusal_of(const std::vector<std::string>& assignments) {
  Parameters parameters;
  try {
    parameters = parameters_of(assignments);
    make_scene(parameters);
    plan_runs(parameters);
  } catch (const BadValue& value) {
    return refusal(parameters.settings, value);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

std::string refusal_of_text(const std::string& text) {
  try {
    read_parameters(parse_settings(text, "scene.prm"));
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

void expect_parts(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(Parameters, AreWrittenAndReadBackUnchanged) {
  const Parameters parameters =
      parameters_of({"Cylinder/Outer radius=1.25", "Contact/Method=uzawa", "Contact/Rho=1.5",
                     "Road/Contact zone=4, 5", "Study/Vary=Mesh/Degree = 1 | 2; Contact/Rho = 0.5",
                     "Output/Files=summary"});
  std::ostringstream text;
  print_parameters(text, parameters);
  const std::filesystem::path file = own_path();
  std::ofstream(file) << text.str();
  const Parameters again = read_parameters(read_settings(file));
  EXPECT_EQ(again.cylinder.outer_radius, 1.25);
  EXPECT_EQ(again.contact.method, ContactMethod::uzawa);
  EXPECT_EQ(again.contact.rho, 1.5);
  EXPECT_EQ(again.road.contact_zone, std::pair(4., 5.));
  ASSERT_EQ(again.study.vary.size(), 2u);
  EXPECT_EQ(again.study.vary[0].size(), 2u);
  EXPECT_EQ(again.study.vary[0][1][0].value, "2");
  EXPECT_TRUE(again.wants(OutputFile::summary));
  EXPECT_FALSE(again.wants(OutputFile::solution));
}

// The printed file has one line per key, with the values given.
TEST(Parameters, ArePrintedCompletely) {
  const std::vector<Setting> given = {{"Mesh", "Degree", "3", "test"},
                                      {"Road", "Load", "0.25", "test"}};
  std::ostringstream text;
  print_parameters(text, read_parameters(given));
  const std::vector<Setting> printed = parse_settings(text.str(), "printed");
  ASSERT_EQ(printed.size(), all_keys().size());
  for (unsigned int i = 0; i < printed.size(); ++i) {
    EXPECT_EQ(printed[i].path(), all_keys()[i].path());
    EXPECT_FALSE(all_keys()[i].text.empty()) << printed[i].path();
    EXPECT_EQ(printed[i].value, printed[i].path() == "Mesh/Degree" ? "3"
                                : printed[i].path() == "Road/Load" ? "0.25"
                                : printed[i].path() == "Road/Distance"
                                    ? "none"
                                    : all_keys()[i].default_value);
  }
}

TEST(Parameters, NamesThatAreUnknownGiveTheNearestKnown) {
  for (const auto& [setting, nearest] : std::vector<std::pair<std::string, std::string>>{
           {"Mesh/Angular cell=3", "Mesh/Angular cells"},
           {"Rod/Distance=0.8", "Road/Distance"},
           {"Cylinder/Distance=0.8", "Road/Distance"},
           {"Degree=2", "Mesh/Degree"},
           {"mesh/degree=2", "Mesh/Degree"},
           {"Study/Vary=degree = 1 | 2", "Mesh/Degree"},
           {"Study/Scenes=flat: Rode/Curvature = 0", "Road/Curvature"}})
    expect_parts(refusal_of({setting}), {"did you mean", nearest});
  expect_parts(refusal_of_text("subsection Contakt\n set Rho = 1\nend\n"),
               {"line 1", "did you mean Contact"});
  expect_parts(refusal_of_text("subsection Contact\n set Rhoo = 1\nend\n"),
               {"line 2", "did you mean Contact/Rho"});
}

TEST(Parameters, RefusalsNameLettersThatAreNotSeen) {
  for (const auto& [text, letter] : std::vector<std::pair<std::string, std::string>>{
           {"subsection Cylinder\nset Inner  radius = 0.4\nend\n", "two blanks"},
           {"subsection Cylinder\nset Inner\xC2\xA0radius = 0.4\nend\n", "no-break space"},
           {"subsection Cylinder\nset Inner radius = 0.4\xC2\xA0\nend\n", "no-break space"},
           {"subsection\xC2\xA0"
            "Cylinder\nend\n",
            "no-break space"},
           {"subsection Road\nset Curvature = \xE2\x88\x92"
            "0.4\nend\n",
            "not ASCII"}})
    expect_parts(refusal_of_text(text), {letter});
  const std::string marked = "\xEF\xBB\xBFsubsection Mesh\n set Degree = 3\nend\n";
  EXPECT_EQ(read_parameters(parse_settings(marked, "file")).mesh.degree, 3u);
}

TEST(Parameters, NumbersMayBeExpressionsOfNumbers) {
  const Parameters p = parameters_of(
      {"Road/Curvature=1/150", "Material/Shear modulus=4.5 / (2 * (1 + 0.49))",
       "Road/Contact zone=3*pi/2 - 0.5, 5", "Mesh/Angular cells=4*48", "Contact/Rho=sqrt(2)",
       "Mesh/Most unknowns=5e6", "Road/Distance=1 - 1/4", "Mesh/Wanted relative error=2^-7"});
  EXPECT_EQ(p.road.curvature, 1. / 150);
  EXPECT_EQ(p.material.shear_modulus, 4.5 / (2 * (1 + 0.49)));
  EXPECT_EQ(p.road.contact_zone, std::pair(3 * M_PI / 2 - 0.5, 5.));
  EXPECT_EQ(p.mesh.angular_cells, 192u);
  EXPECT_EQ(p.contact.rho, std::sqrt(2.));
  EXPECT_EQ(p.mesh.most_unknowns, 5000000u);
  EXPECT_EQ(p.road.distance, 0.75);
  EXPECT_EQ(p.mesh.wanted_relative_error, 1. / 128);
  // Files show the values.
  std::ostringstream text;
  print_parameters(text, p);
  for (const Setting& setting : parse_settings(text.str(), "printed"))
    EXPECT_EQ(setting.value.find_first_of("/()*^"), std::string::npos) << setting.value;
  EXPECT_EQ(read_parameters(parse_settings(text.str(), "printed")).road.curvature, 1. / 150);
}

TEST(Parameters, NumbersOfAStudyMayBeExpressionsOfNumbers) {
  const Parameters p = parameters_of(
      {"Study/Vary=Road/Curvature = 1/150 | -1/4 : 1/4 : 1/8; Cylinder/Radial force = r/2 | 1/2",
       "Study/Scenes=fast: Cylinder/Angular velocity = 1/(2*2)"});
  std::vector<double> curvatures;
  for (const auto& choice : p.study.vary.at(0))
    curvatures.push_back(to_number(choice.at(0).value));
  EXPECT_EQ(curvatures, (std::vector<double>{1. / 150, -0.25, -0.125, 0, 0.125, 0.25}));
  EXPECT_EQ(p.study.vary.at(1).at(0).at(0).value, "r/2");
  EXPECT_EQ(p.study.scenes.at(0).settings.at(0).value, "0.25");
}

// Equal values are equal texts, in files and titles as well.
TEST(Parameters, NumbersHaveOneSpelling) {
  for (const char* text : {"0.80", "+0.8", "8e-1", "4/5"})
    EXPECT_EQ(parameters_of({std::string("Road/Distance=") + text}).settings.at(0).value, "0.8");
  for (const char* text : {"200000", "2e5", "2E+05", "10^5 * 2"})
    EXPECT_EQ(parameters_of({std::string("Material/Shear modulus=") + text}).settings.at(0).value,
              "200000");
  EXPECT_EQ(parameters_of({"Cylinder/Outer radius=1e15"}).settings.at(0).value, "1e+15");
}

// Together they calibrate the modulus.
TEST(Parameters, AcceptALoadOfASceneWithNipsThatVary) {
  const Parameters parameters =
      parameters_of({"Study/Scenes=a: Road/Load = 0.3", "Study/Vary=Road/Nip = 0.8 | 0.9"});
  EXPECT_EQ(plan_runs(parameters).size(), 2u);
}

TEST(Parameters, RefuseAKeyTwice) {
  for (const auto& [scenes, vary] : std::vector<std::pair<std::string, std::string>>{
           {"one: Mesh/Degree = 1 & Mesh/Degree = 2", ""},
           {"one: Mesh/Degree = 1", "Mesh/Degree = 1 | 2"},
           {"one: Road/Load = 0.1", "Road/Distance = 0.7 | 0.8"}})
    expect_parts(refusal_of({"Study/Scenes=" + scenes, "Study/Vary=" + vary}),
                 {"section Study", scenes.substr(5, 4)});
  for (const char* value : {"2", "{2}"})
    expect_parts(refusal_of_text("subsection Mesh\nset Degree = " + std::string(value) +
                                 "\nset Degree = 1\nend\n"),
                 {"line 3", "second value"});
}

TEST(Parameters, RefusalsNameOriginSectionKeyValueAndRange) {
  expect_parts(refusal_of({"Cylinder/Outer radius=0.25"}),
               {"test", "Cylinder", "Outer radius", "0.25", "inner radius 0.5"});
  expect_parts(refusal_of_text("# a scene\nsubsection Mesh\nend\n\nsubsection Mesh # again\r\n"
                               "  set Degree = 9 # Q9\nend\n"),
               {"scene.prm", "line 6", "Mesh", "Degree", "\"9\"", "1 to 8"});
  expect_parts(refusal_of_text("subsection Road\n set Curvature = 0\n set Distance = 0,8\nend\n"),
               {"scene.prm", "line 3", "Road", "Distance", "\"0,8\""});
  expect_parts(refusal_of({"Contact/Tolerance=1"}), {"Contact", "Tolerance", "1e-15 to 0.1"});
  expect_parts(refusal_of({"Road/Load=-1"}), {"Road", "Load", "-1", "greater than 0"});
}

// The last number that a key counts with is in its text.
TEST(Parameters, RefusalsOfWholeNumbersGiveTheLargest) {
  for (const char* key :
       {"Mesh/Most unknowns", "Mesh/Radial cells", "Mesh/Angular cells", "Contact/Most steps"}) {
    expect_parts(refusal_of({key + std::string("=2147483648")}), {"2147483647"});
    EXPECT_NO_THROW(parameters_of({key + std::string("=2147483647")}));
  }
}

// In the user's units the critical speed is seldom a short number.
TEST(Parameters, AcceptTheCriticalSpeedAsTheScreenShowsIt) {
  const std::vector<std::string> roller = {"Cylinder/Inner radius=0.0125",
                                           "Cylinder/Outer radius=0.025", "Road/Distance=0.02",
                                           "Material/Shear modulus=5e5", "Material/Density=1100"};
  const double critical = std::sqrt(5e5 / 1100) / 0.025; // 852.802865...
  for (const auto& [speed, is_accepted] :
       std::vector<std::pair<std::string, bool>>{{"852.803", true},
                                                 {"852.8029", true},
                                                 {"852.80287", true},
                                                 {"sqrt(5e5/1100)/0.025", true},
                                                 {"852.804", false},
                                                 {"852.80291", false},
                                                 {"853", false}}) {
    const Parameters p = with(parameters_of(roller), {"Cylinder/Angular velocity=" + speed});
    EXPECT_NEAR(critical_speed(p.cylinder, p.material), critical, 1e-12 * critical);
    if (is_accepted)
      EXPECT_DOUBLE_EQ(make_scene(p).angular_velocity, 1 / make_scene(p).outer_radius) << speed;
    else
      EXPECT_THROW(make_scene(p), BadValue) << speed;
  }
}

class RefusedSetting : public testing::TestWithParam<const char*> {};

TEST_P(RefusedSetting, IsBadInput) {
  EXPECT_THROW(make_scene(parameters_of({GetParam()})), BadInput);
}

INSTANTIATE_TEST_SUITE_P(
    , RefusedSetting,
    testing::Values(
        "Cylinder/Inner radius=0", "Cylinder/Inner radius=-1", "Cylinder/Inner radius=1",
        "Cylinder/Inner radius=nan", "Cylinder/Inner radius=1e-151", "Cylinder/Outer radius=inf",
        "Cylinder/Outer radius=1e400", "Cylinder/Outer radius=1,0", "Cylinder/Outer radius=one",
        "Cylinder/Outer radius=", "Cylinder/Outer radius=1e152", "Mesh/Degree=two",
        "Cylinder/Radial force=sin(q)", "Cylinder/Angular velocity=-0.1",
        "Cylinder/Angular velocity=1.0000001", "Cylinder/Angular velocity=nan",
        "Cylinder/Radial force=", "Cylinder/Radial force=r*(", "Cylinder/Radial force=x",
        "Cylinder/Radial force=1/0", "Cylinder/Radial force=nan", "Cylinder/Radial force=inf",
        "Road/Distance=0", "Road/Distance=-0.8", "Road/Distance=0.5", "Road/Distance=2",
        "Road/Distance=nan", "Road/Load=0", "Road/Contact zone=3, 5", "Road/Contact zone=4, 6.3",
        "Road/Contact zone=5, 4", "Road/Contact zone=4, 4", "Road/Contact zone=4",
        "Road/Contact zone=4, 5, 6", "Road/Contact zone=4, nan", "Mesh/Degree=0", "Mesh/Degree=9",
        "Mesh/Degree=1.5", "Mesh/Radial cells=0", "Mesh/Angular cells=2", "Mesh/Angular cells=-5",
        "Mesh/Angular cells=1e30", "Mesh/Global refinements=-1", "Contact/Method=newton",
        "Contact/Rho=0", "Contact/Rho=-1", "Contact/Rho=inf", "Contact/Tolerance=0",
        "Contact/Tolerance=1", "Contact/Most steps=0", "Solver/Kind=direct",
        "Study/Vary=Mesh/Degree", "Study/Vary=Study/Vary = 1", "Study/Published steps=1.5",
        "Output/Directory=", "Cylinder/Radial force=1,5", "Cylinder/Radial force=3;",
        "Cylinder/Radial force=1,0e3", "Cylinder/Radial force=r = 2",
        "Cylinder/Radial force=0*(z = r)", "Cylinder/Radial force=rand()",
        "Cylinder/Radial force=1e400", "Cylinder/Outer radius=+-1", "Cylinder/Outer radius=0x1",
        "Cylinder/Outer radius=1e-320", "Road/Contact zone=4,2, 5,5",
        "Mesh/Angular cells=4294967295", "Mesh/Radial cells=18446744073709551617",
        "Mesh/Global refinements=1000", "Output/Files=everything", "Mesh/Degree={1}",
        "Road/Distance={0.8}", "Mesh/Degree=1 2", "Road/Distance=0.8 m",
        "Mesh/Wanted relative error=5%", "Road/Distance=0.8, 0.9", "Road/Distance=0.8\xC2\xA0",
        "Certificate/Error bound=yes", "Road/Distance=none", "Output/Unit names=m, s",
        "Output/Unit names=m, s, `id`", "Output/Unit names=m, s, $N", "Output/Unit names=m, s, N'",
        "Output/Unit names=m, s, \\N", "Output/Directory=~/res", "Road/Curvature=1/0",
        "Road/Curvature=r", "Road/Curvature=1/", "Road/Curvature=max(1,2), 3",
        "Road/Curvature=(1/150", "Mesh/Degree=3/2", "Road/Load=200 : 4000 : 200",
        "Mesh/Degree=1 | 2", "Study/Scenes=a: Mesh/Degree=1; a: Mesh/Degree=2",
        "Cylinder/Inner radius=1/2,5"));

TEST(Parameters, RefuseABraceInAFile) {
  expect_parts(refusal_of_text("subsection Mesh\n set Degree = {1|2}\nend\n"), {"Mesh", "Degree"});
}

TEST(Parameters, LaterOfDistanceAndLoadReplacesTheOther) {
  const std::vector<Setting> with_distance = {{"Road", "Distance", "0.7", "file"}},
                             with_load = {{"Road", "Load", "0.2", "file"}};
  const auto then = [](std::vector<Setting> settings, const std::string& key,
                       const std::string& value, const std::string& origin) {
    settings.push_back({"Road", key, value, origin});
    return read_parameters(settings);
  };
  EXPECT_EQ(then(with_distance, "Load", "0.3", "--set").road.load, 0.3);
  const Parameters distance = then(with_load, "Distance", "0.9", "--set");
  EXPECT_EQ(distance.road.load, std::nullopt);
  EXPECT_EQ(distance.road.distance, 0.9);
  EXPECT_EQ(then(with_load, "Distance", "none", "file").road.load, 0.2);
  EXPECT_EQ(then(with_distance, "Load", "none", "file").road.distance, 0.7);
  expect_parts(refusal_of_text("subsection Road\n set Load = 1\n set Distance = 0.7\nend\n"),
               {"line 2", "Road", "Load"});
  EXPECT_NE(refusal_of({"Road/Load=1", "Road/Distance=0.8"}), ""); // given, though the default
  // A study of distances may begin with a file of a load.
  Parameters study = parameters_of({"Road/Load=0.2"});
  study.study = parameters_of({"Study/Vary=Road/Distance = 0.7 | 0.8"}).study;
  for (const RunPlan& plan : plan_runs(study))
    EXPECT_EQ(plan.parameters.road.load, std::nullopt);
}

// Rows that only differ in what the active set does not use would be equal.
TEST(Parameters, KeysOfUzawaAreVariedForThatMethodOnly) {
  try {
    plan_runs(parameters_of({"Study/Vary=Contact/Rho = 1 | 2"}));
    ADD_FAILURE();
  } catch (const BadValue& value) {
    EXPECT_EQ(value.section + '/' + value.key, "Study/Vary");
  }
  for (const char* vary : {"Contact/Tolerance = 1e-3 | 1e-4; Contact/Method = active set | uzawa",
                           "Contact/Method = active set | uzawa"})
    EXPECT_EQ(plan_runs(parameters_of({std::string("Study/Vary=") + vary})).size() % 2, 0u);
  EXPECT_EQ(
      plan_runs(parameters_of({"Contact/Method=uzawa", "Study/Vary=Contact/Rho = 1 | 2"})).size(),
      2u);
}

TEST(Parameters, StudiesHaveAtMostAMillionRuns) {
  const std::string thousand = "0.501 : 0.9 : 0.000399"; // 1001 values
  EXPECT_THROW(plan_runs(parameters_of({"Study/Vary=Road/Distance = " + thousand +
                                        "; Cylinder/Angular velocity = " + thousand})),
               BadValue);
}

TEST(Parameters, VaryOverListsAndRanges) {
  const auto values = [](const std::string& text) {
    std::string all;
    const Parameters parameters = parameters_of({"Study/Vary=" + text});
    for (const auto& choice : parameters.study.vary.at(0))
      for (const Setting& setting : choice)
        all += setting.value + ' ';
    return all;
  };
  EXPECT_EQ(values("Road/Distance = 0.6 : 0.9 : 0.05"), "0.6 0.65 0.7 0.75 0.8 0.85 0.9 ");
  EXPECT_EQ(values("Cylinder/Radial force = 0.3 : -0.3 : -0.1"), "0.3 0.2 0.1 0 -0.1 -0.2 -0.3 ");
  EXPECT_EQ(values("Mesh/Radial cells = 1 | 2 : 5 : 2 | 8"), "1 2 4 8 ");
  EXPECT_EQ(values("Cylinder/Radial force = r>0.7 ? 1 : 0"), "r>0.7 ? 1 : 0 ");
  EXPECT_EQ(values("Mesh/Radial cells & Mesh/Angular cells = 4 & 48 | 8 & 96"), "4 48 8 96 ");
  // Quotes protect the signs that separate values and keys.
  EXPECT_EQ(values("Cylinder/Radial force = \"r>0.7 || z<4\" | 0 | \"(1) : 2\""),
            "r>0.7 || z<4 0 (1) : 2 ");
  EXPECT_EQ(values("Cylinder/Radial force & Mesh/Degree = \"r>0.7 && z<4\" & 2"),
            "r>0.7 && z<4 2 ");
  const Parameters scenes = parameters_of(
      {"Study/Scenes=band: Cylinder/Radial force = \"(r>0.7 && z<4) || r<0.6\" & Mesh/Degree = 1"});
  EXPECT_EQ(scenes.study.scenes.at(0).settings.at(0).value, "(r>0.7 && z<4) || r<0.6");
  EXPECT_EQ(scenes.study.scenes.at(0).settings.at(1).value, "1");
  for (const char* text :
       {"Mesh/Degree & Mesh/Degree = 1 & 2", "Mesh/Degree = 1 | 2; Mesh/Degree = 3",
        "Road/Distance = 0.6 : 0.9 : 0", "Road/Distance = 0.6 : 0.9 : -0.1", "Mesh/Degree = | 1",
        "Degree = 1", "Mesh/Degree", "Road/Distance = 0.6 : 0.9 : 1e-9",
        "Road/Distance = 0.6 : high : 0.1", "Road/Distance = 0.6 : 0.9", "= 1 | 2",
        "Mesh/Radial cells & Mesh/Angular cells = 4 & 48 | 8", "Output/Files = summary | contact",
        "Study/True errors = true"})
    EXPECT_NE(refusal_of({std::string("Study/Vary=") + text}), "") << text;
}

TEST(Parameters, AnyNameOfADirectoryIsReadBack) {
  for (const char* directory : {"two  blanks", "a\"b", "\"a\"", "a\\b", "a{b}", "\xC3\x9C"}) {
    std::stringstream text;
    print_parameters(text, read_parameters({{"Output", "Directory", directory, "--output"}}));
    EXPECT_EQ(read_parameters(parse_settings(text.str(), "file")).output.directory, directory);
  }
  for (const char* directory : {"line\nline", "tab\tulator", " front", "a#b", "a\\", ""})
    EXPECT_THROW(read_parameters({{"Output", "Directory", directory, "--output"}}), BadInput)
        << directory;
}

TEST(Parameters, RefuseTextsOfAnyLengthShortly) {
  const std::string longest(1 << 20, '(');
  for (const std::string& setting :
       {"Cylinder/Radial force=" + longest, "Cylinder/" + longest + "=1", longest + "/Degree=1",
        "Road/Distance=0" + std::string(30000, 'a'), "Road/Distance=0.8" + longest,
        "Mesh/Degree=\x1b[2J" + longest, std::string("Cylinder/Radial force=\x1b[2J")}) {
    const std::string message = refusal_of({setting});
    EXPECT_LT(message.size(), 1000u);
    EXPECT_NE(message, "");
    EXPECT_EQ(message.find('\x1b'), std::string::npos);
  }
  const std::string binary = refusal_of_text("\x7f"
                                             "ELF\x1b[2J" +
                                             std::string(10000, '\x01'));
  EXPECT_LT(binary.size(), 2000u);
  EXPECT_EQ(binary.find_first_of("\x7f\x1b\x01"), std::string::npos) << binary;
}

TEST(Parameters, SayHowManyUnknownsWereTooMany) {
  const auto refusal_of_mesh = [](const std::vector<std::string>& mesh) {
    const Parameters parameters = parameters_of(mesh);
    try {
      simulate(make_scene(parameters), parameters);
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const std::string many = refusal_of_mesh({"Mesh/Radial cells=1000", "Mesh/Angular cells=5000"});
  EXPECT_NE(many.find(" 20000000 unknowns"), std::string::npos) << many;
  const std::string refined = refusal_of_mesh({"Mesh/Global refinements=12"});
  EXPECT_NE(refined.find("Mesh/Global refinements: "), std::string::npos) << refined;
  // (8 2^20)^2 (2^31 - 1)^2
  const std::string largest =
      refusal_of_mesh({"Mesh/Degree=8", "Mesh/Global refinements=20",
                       "Mesh/Radial cells=2147483647", "Mesh/Angular cells=2147483647"});
  EXPECT_NE(largest.find(" 3.25e+32 unknowns"), std::string::npos) << largest;
  const std::string allowed =
      refusal_of_mesh({"Mesh/Degree=1", "Mesh/Radial cells=1000000", "Mesh/Angular cells=2000",
                       "Mesh/Most unknowns=2147483647", "Road/Contact zone=4, 5"});
  EXPECT_NE(allowed.find("MiB of memory"), std::string::npos) << allowed;
}

TEST(SceneOfParameters, ZoneOfAnUnevenForceIsWhereTheRoadIsNearerThanTheOuterRadius) {
  const Scene scene =
      make_scene(parameters_of({"Cylinder/Outer radius=2", "Road/Distance=1.7",
                                "Cylinder/Angular velocity=0.1", "Cylinder/Radial force=0.1*r"}));
  EXPECT_NEAR(scene.phi(scene.zone_begin) * scene.units.length, 2, 1e-13);
  EXPECT_NEAR(scene.phi(scene.zone_end) * scene.units.length, 2, 1e-13);
}

TEST(SceneOfParameters, ZoneOfAnEvenForceIsWhereTheRoadCanBeTouched) {
  for (const char* const force : {"0", "0.3", "-0.05"}) {
    const Parameters parameters =
        parameters_of({"Mesh/Angular cells=100", std::string("Cylinder/Radial force=") + force});
    const Scene scene = make_scene(parameters);
    const double f = std::stod(force);
    const double free = f * (-0.1875 + std::log(2.) / 2);
    const double two_cells = 4 * M_PI / 100;
    EXPECT_NEAR(scene.phi(scene.zone_begin + two_cells), free, 1e-14);
    EXPECT_NEAR(scene.phi(scene.zone_end - two_cells), free, 1e-14);
  }
  // Where it would be wider than where phi < b, it is not.
  const Scene bulging = make_scene(parameters_of({"Cylinder/Radial force=1e8"}));
  EXPECT_NEAR(bulging.phi(bulging.zone_begin), 1, 1e-14);
}

TEST(SceneOfParameters, LengthsAreInAPowerOfTwoNearTheOuterRadius) {
  const Scene scene = make_scene(parameters_of(
      {"Cylinder/Inner radius=3e-150", "Cylinder/Outer radius=5e-150",
       "Cylinder/Angular velocity=1e149", "Road/Distance=4e-150", "Cylinder/Radial force=1e150"}));
  EXPECT_GE(scene.outer_radius, 1);
  EXPECT_LT(scene.outer_radius, 2);
  int exponent = 0;
  EXPECT_EQ(std::frexp(scene.units.length, &exponent), 0.5);
  EXPECT_EQ(scene.inner_radius * scene.units.length, 3e-150);
  EXPECT_EQ(scene.angular_velocity / scene.units.length, 1e149);
  EXPECT_EQ(scene.force(1, 0) / scene.units.length, 1e150);
}

TEST(SceneOfParameters, ForceIsAnExpressionInRAndZ) {
  const Scene scene = make_scene(parameters_of({"Cylinder/Radial force=r^2*cos(z) + pi"}));
  EXPECT_NEAR(scene.force(0.7, 2.), 0.49 * std::cos(2.) + M_PI, 1e-15);
  EXPECT_FALSE(make_scene(parameters_of({"Cylinder/Radial force=0.0"})).force);
  for (const char* const force : {"+1.5", "3/2", "2*0.75", "1.5 + 0*pi"})
    EXPECT_EQ(
        make_scene(parameters_of({std::string("Cylinder/Radial force=") + force})).force.uniform,
        1.5);
  // Commas within a function, and comparisons, are part of the language.
  const Scene stepped =
      make_scene(parameters_of({"Cylinder/Radial force=if(r <= 0.7, 1, max(2, z)) * (r != 1)"}));
  EXPECT_EQ(stepped.force(0.6, 3.), 1);
  EXPECT_EQ(stepped.force(0.8, 3.), 3);
  EXPECT_EQ(stepped.force(1, 3.), 0);
  const Scene rounding = make_scene(parameters_of(
      {"Cylinder/Radial force=1000*int(1.7*r) + 100*rint(1.7*r) + 10*floor(1.7*r) + ceil(1.7*r)"}));
  EXPECT_EQ(rounding.force(1, 0.), 2212);
  EXPECT_NEAR(
      make_scene(parameters_of({"Cylinder/Radial force=(r>0.7 && z<4) || r<0.6"})).force(0.5, 5.),
      1, 0);
}

TEST(Parameters, RefuseAForceThatIsNotFinite) {
  const Parameters parameters = parameters_of({"Cylinder/Radial force=1/(r - 0.6)^2 + log(z - 3)"});
  EXPECT_THROW(simulate(make_scene(parameters), parameters), BadInput);
}

TEST(Simulation, HasNoResultThatIsNotFinite) {
  for (const std::vector<std::string>& settings : std::vector<std::vector<std::string>>{
           {"Cylinder/Radial force=1e160"},
           {"Cylinder/Radial force=-1e300*r"},
           {"Cylinder/Inner radius=0.9999999999999996", "Road/Distance=0.9999999999999998"}}) {
    const Parameters parameters = with(parameters_of({"Contact/Most steps=30"}), settings);
    EXPECT_THROW(simulate(make_scene(parameters), parameters), NotSolved) << settings[0];
  }
}

TEST(Parameters, RefuseAnAutomaticZoneBetweenTwoNodes) {
  // phi < b holds within 0.032 of the lowest point, which lies in the middle of a cell.
  const Parameters parameters =
      parameters_of({"Road/Distance=1.999", "Mesh/Degree=1", "Mesh/Angular cells=21"});
  EXPECT_THROW(simulate(make_scene(parameters), parameters), BadInput);
}

TEST(Parameters, EndsOfAGivenZoneAreVertices) {
  for (const auto& [zone, cells] : std::vector<std::pair<std::string, std::string>>{
           {"4.6, 4.8", "20"}, {"3.2, 6.2", "3"}, {"4.1, 5.2", "31"}}) {
    const Parameters parameters =
        parameters_of({"Road/Contact zone=" + zone, "Mesh/Angular cells=" + cells});
    const Scene scene = make_scene(parameters);
    const Result result = simulate(scene, parameters).result;
    EXPECT_NEAR(result.contact_rows.front().angle, scene.zone_begin, 1e-13);
    EXPECT_NEAR(result.contact_rows.back().angle, scene.zone_end, 1e-13);
    EXPECT_EQ(result.mesh.n_cells, 16u * std::stoi(cells));
  }
}

TEST(Settings, HaveTheirSectionKeyAndValue) {
  const auto settings = parse_settings(
      "# a scene\n\nsubsection Mesh\n  set Degree = 2 # Q2\nend\r\nsubsection Study\n"
      "\tset Vary =\tMesh/Degree = 1 | \\\n   2\nend\n",
      "file");
  ASSERT_EQ(settings.size(), 2u);
  EXPECT_EQ(settings[0].path(), "Mesh/Degree");
  EXPECT_EQ(settings[0].value, "2");
  EXPECT_EQ(settings[0].place(), "file, line 4");
  EXPECT_EQ(settings[1].path(), "Study/Vary");
  EXPECT_EQ(settings[1].value, "Mesh/Degree = 1 | 2");
  const Setting setting = parse_setting("Contact/Most steps = 7", "--set");
  EXPECT_EQ(setting.path(), "Contact/Most steps");
  EXPECT_EQ(setting.value, "7");
  EXPECT_EQ(parse_setting("Study/Vary=a/b=c", "--set").value, "a/b=c");
  EXPECT_EQ(parse_setting("a=b/c", "--set").section, "");
  EXPECT_THROW(parse_setting("Contact", "--set"), BadInput);
}

// Users know the form of the files from deal.II, which also writes them.
TEST(Settings, AreThoseThatDealIIReads) {
  std::vector<std::string> texts = {"# nothing\n", "SUBSECTION Mesh\nSET Degree = 3 # Q3\nEND",
                                    "subsection Study\n set Vary = Mesh/Degree = 1 \\\n"
                                    "  | 2 \\ \n | 3 # three \\\n of them\nend\n"};
  for (const auto& entry : std::filesystem::recursive_directory_iterator(ROLLWAVE_PRM_DIRECTORY))
    if (entry.path().extension() == ".prm") {
      std::ifstream file(entry.path());
      texts.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
  for (const std::string& text : texts) {
    SCOPED_TRACE(text);
    dealii::ParameterHandler prm;
    for (const Key& key : all_keys()) {
      prm.enter_subsection(key.section);
      prm.declare_entry(key.name, key.default_value, dealii::Patterns::Anything());
      prm.leave_subsection();
    }
    prm.parse_input_from_string(text);
    const auto settings = parse_settings(text, "file");
    for (const Key& key : all_keys()) {
      prm.enter_subsection(key.section);
      EXPECT_EQ(value_of(key, settings), prm.get(key.name)) << key.path();
      prm.leave_subsection();
    }
  }
}

TEST(Settings, RefuseBadSyntax) {
  for (const auto& [text, part] : std::vector<std::pair<std::string, std::string>>{
           {"subsection Mesh\nDegree = 2\nend\n", "2"},
           {"subsection Mesh\nset Degree 2\nend\n", "2"},
           {"end\n", "1"},
           {"subsection Mesh\n", "scene.prm"},
           {"subsection Road\nsubsection Mesh\nend\nend\n", "2"},
           {"subsection\nend\n", "1"},
           {"subsection Mesh\nset Degree = 1\nset Degree = 2\nend\n", "Degree"},
           {"subsection Mesh\nend of it\n", "line 2"},
           {"set Degree = 1\n", "line 1"},
           {"include scene.prm\n", "line 1"}})
    expect_parts(refusal_of_text(text), {"scene.prm", part});
}

TEST(Settings, RefuseArgumentsThatAreNotUnderstood) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{},
                                             {"--nonsense"},
                                             {"a.prm", "b.prm"},
                                             {"a.prm", "--set"},
                                             {"a.prm", "--set", "Mesh"},
                                             {"a.prm", "--output"},
                                             {"a.prm", "--output", "--verify"},
                                             {"a.prm", "--set", "--verify"},
                                             {"a.prm", "--verify=1"},
                                             {"a.prm", "--outputs=x"}})
    EXPECT_THROW(read_command_line(arguments), BadInput) << testing::PrintToString(arguments);
}

TEST(Settings, OfOptionsMayStandBehindAnEqualsSign) {
  const CommandLine line = read_command_line(
      {"--output=a=b", "--set=Cylinder/Radial force=r == 1", "--set", "Mesh/Degree=1", "a.prm"});
  ASSERT_EQ(line.settings.size(), 3u);
  EXPECT_EQ(line.settings[0].path() + ' ' + line.settings[0].value, "Output/Directory a=b");
  EXPECT_EQ(line.settings[1].path() + ' ' + line.settings[1].value, "Cylinder/Radial force r == 1");
  EXPECT_EQ(line.settings[2].path() + ' ' + line.settings[2].value, "Mesh/Degree 1");
}

TEST(Settings, ADirectoryReplacesTheOneOfTheFilesName) {
  const std::filesystem::path file = own_path().string() + "#b.prm";
  std::ofstream(file) << "# nothing\n";
  const CommandLine line = read_command_line({file.string(), "--output", "o"});
  EXPECT_EQ(read_parameters(settings_of(line, MPI_COMM_SELF)).output.directory, "o");
  const CommandLine without = read_command_line({file.string()});
  EXPECT_THROW(read_parameters(settings_of(without, MPI_COMM_SELF)), BadInput);
}

TEST(Settings, RefuseAFileThatCannotBeRead) {
  for (const char* file : {"/no/such/file.prm", "/"})
    EXPECT_THROW(read_settings(file), BadInput) << file;
}

} // namespace
