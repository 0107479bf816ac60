// Pictures show the numbers of the files: the data of their scripts are read back.

#include "program.h"

#include "rollwave/plot/gnuplot.h"
#include "rollwave/plot/plots.h"
#include "rollwave/run/quantities.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <regex>

namespace {

namespace fs = std::filesystem;

using rollwave::Shown;
using Rows = std::vector<std::vector<double>>;

/// The numbers of each block of data of a script, by the name of the block; empty lines left out.
std::map<std::string, Rows> blocks_of(const std::string& script) {
  std::map<std::string, Rows> blocks;
  std::istringstream lines(script);
  std::string block;
  for (std::string line; std::getline(lines, line);)
    if (const auto end = line.find(" << EOD"); end != std::string::npos) {
      block = line.substr(0, end);
      blocks[block];
    } else if (line == "EOD")
      block.clear();
    else if (!block.empty() && !line.empty()) {
      std::istringstream numbers(line);
      blocks[block].emplace_back();
      for (std::string number; numbers >> number;)
        blocks[block].back().push_back(std::strtod(number.c_str(), nullptr));
    }
  return blocks;
}

/// The text after each "set NAME ".
std::vector<std::string> settings_of(const std::string& script, const std::string& name) {
  std::vector<std::string> values;
  std::istringstream lines(script);
  const std::string start = "set " + name + ' ';
  for (std::string line; std::getline(lines, line);)
    if (line.rfind(start, 0) == 0)
      values.push_back(line.substr(start.size()));
  return values;
}

/// The number given to a variable of a script.
double variable(const std::string& script, const std::string& name) {
  const auto place = script.find('\n' + name + " = ");
  return place == std::string::npos ? NAN : std::stod(script.substr(place + name.size() + 4));
}

void expect_same_point(const std::vector<double>& point, double x, double y) {
  ASSERT_GE(point.size(), 2u);
  EXPECT_NEAR(point[0], x, 1e-8 * std::abs(x));
  EXPECT_NEAR(point[1], y, 1e-8 * std::abs(y));
}

double number(const CsvRow& row, const std::string& column) {
  return std::stod(row.at(column));
}

class Pictures : public Program {
protected:
  void run(const std::vector<std::string>& settings) {
    std::string command = "$rollwave " + scene;
    for (const std::string& setting : settings)
      command += " --set '" + setting + '\'';
    const Outcome outcome = shell(command);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
    EXPECT_EQ(outcome.text.find("not drawn"), std::string::npos) << outcome.text;
  }

  /// Draws a picture and returns it as text.
  std::string drawn(const rollwave::Picture& picture) {
    fs::create_directories(directory / "out");
    rollwave::WrittenFiles written;
    rollwave::draw({picture}, directory / "out", rollwave::PictureFormat::svg, written);
    EXPECT_TRUE(written.notes.empty()) << written.notes.front().text;
    return read(picture.name + ".svg");
  }
};

TEST_F(Pictures, CurvesGoThroughTheRowsOfTheTableInOrder) {
  run({"Study/Vary=Cylinder/Angular velocity = 0.5 | 1; Road/Distance = 0.8 | 0.7 | 0.85 | 0.75",
       "Mesh/Degree=1"});
  const auto rows = csv_rows(read("study.csv"));
  ASSERT_EQ(rows.size(), 8u);
  const std::vector<unsigned int> order = {1, 3, 0, 2}; // by distance
  auto blocks = blocks_of(read("study-curves.gp"));
  unsigned int panel = 0;
  for (const auto& quantity : rollwave::result_quantities())
    if (quantity.shown & Shown::curve) {
      ++panel;
      const bool is_load = quantity.name == "contact.vertical_load";
      for (const unsigned int curve : {0, 1}) {
        const Rows& points =
            blocks["$curve_" + std::to_string(panel) + '_' + std::to_string(curve + 1)];
        ASSERT_EQ(points.size(), 4u) << quantity.name;
        for (unsigned int i = 0; i < 4; ++i) {
          const CsvRow& row = rows[4 * curve + (is_load ? order[3 - i] : order[i])];
          expect_same_point(points[i], number(row, is_load ? "scene.deflection" : "Road/Distance"),
                            number(row, quantity.name));
        }
      }
    }
  EXPECT_EQ(panel, settings_of(read("study-curves.gp"), "ylabel").size());
}

TEST_F(Pictures, CurvesOfCalibrationsBeginWithTheModulus) {
  run({"Material/Shear modulus=2", "Material/Density=1", "Mesh/Degree=1", "Road/Load=0.3",
       "Study/Vary=Road/Nip = 0.7 | 0.5 | 0.6"});
  const auto rows = csv_rows(read("study.csv"));
  const Rows points = blocks_of(read("study-curves.gp"))["$curve_1_1"];
  ASSERT_EQ(points.size(), 3u);
  const std::vector<unsigned int> order = {1, 2, 0}; // by nip
  for (unsigned int i = 0; i < 3; ++i)
    expect_same_point(points[i], number(rows[order[i]], "Road/Nip"),
                      number(rows[order[i]], "contact.calibrated_shear_modulus"));
}

TEST_F(Pictures, BandsAreTheGuaranteedIntervalsOfTheVerticalLoad) {
  run({"Study/Vary=Road/Distance = 0.8 | 0.7 | 0.85", "Mesh/Degree=1", "Mesh/Angular cells=30"});
  auto rows = csv_rows(read("study.csv"));
  ASSERT_EQ(rows.size(), 3u);
  std::sort(rows.begin(), rows.end(), [](const CsvRow& left, const CsvRow& right) {
    return number(left, "scene.deflection") < number(right, "scene.deflection");
  });
  const std::string script = read("study-curves.gp");
  unsigned int n_bands = 0;
  for (const auto& [name, points] : blocks_of(script))
    if (points.front().size() > 2) {
      ++n_bands;
      EXPECT_NE(script.find(name + " using 1:3:4 with filledcurves"), std::string::npos);
      ASSERT_EQ(points.size(), 3u);
      for (unsigned int i = 0; i < 3; ++i) {
        EXPECT_NEAR(points[i][0], number(rows[i], "scene.deflection"), 1e-8);
        EXPECT_NEAR(points[i][2], number(rows[i], "contact.vertical_load_lower_bound"), 1e-8);
        EXPECT_NEAR(points[i][3], number(rows[i], "contact.vertical_load_upper_bound"), 1e-8);
      }
    }
  EXPECT_EQ(n_bands, 1u);
}

TEST_F(Pictures, PublishedStepsAreMarks) {
  run({"Contact/Method=uzawa", "Mesh/Degree=1", "Study/Vary=Contact/Rho = 1 | 2 | 1.5",
       "Study/Published steps=7, 9, -"});
  const std::string script = read("study.gp");
  const Rows points = blocks_of(script)["$curve_1_1"];
  ASSERT_EQ(points.size(), 3u);
  ASSERT_EQ(points[0].size(), 5u);
  EXPECT_EQ(points[0][4], 7);
  EXPECT_TRUE(std::isnan(points[1][4]));
  EXPECT_EQ(points[2][4], 9);
  EXPECT_NE(script.find("$curve_1_1 using 1:5 with points"), std::string::npos);
}

TEST_F(Pictures, NumbersThatAreNotKnownLeaveGaps) {
  const std::string picture = drawn(rollwave::plot_panels(
      "gap", "", {{"x", "y", {{"", {{1, 1}, {2, 2}, {3, {}}, {4, 1}, {5, 2}}}}}}));
  const auto color = picture.find("stroke='rgb(  0, 114, 178)'");
  ASSERT_NE(color, std::string::npos);
  const std::string path = picture.substr(color, picture.find("/>", color) - color);
  EXPECT_EQ(std::count(path.begin(), path.end(), 'M'), 2) << path;
}

TEST_F(Pictures, ErrorsLieOverTheDiametersOfCells) {
  run({"Mesh/Degree=1", "Study/Vary=Mesh/Global refinements = 0 | 2 | 1"});
  const auto rows = csv_rows(read("study.csv"));
  ASSERT_EQ(rows.size(), 3u);
  const auto over_h = blocks_of(read("study-h.gp"))["$curve_1_1"],
             over_unknowns = blocks_of(read("study-unknowns.gp"))["$curve_1_1"];
  ASSERT_EQ(over_h.size(), 3u);
  ASSERT_EQ(over_unknowns.size(), 3u);
  const std::vector<unsigned int> finest_first = {1, 2, 0};
  for (unsigned int i = 0; i < 3; ++i) {
    const CsvRow& row = rows[finest_first[i]];
    const double refined = std::stod(row.at("Mesh/Global refinements")),
                 h = std::hypot(0.5 / 4, 2 * M_PI / 60) / std::pow(2, refined);
    EXPECT_NEAR(number(row, "mesh.h_max"), h, 1e-12);
    EXPECT_NEAR(number(row, "mesh.h_min"), h, 1e-12);
    const double error = number(row, "error.certified_relative");
    expect_same_point(over_h[i], h, error);
    expect_same_point(over_unknowns[2 - i], number(row, "mesh.dofs"), error);
  }
}

TEST_F(Pictures, ProfilesLieAlongTheRoad) {
  for (const double curvature : {0., 0.5}) {
    fs::remove_all(directory / "out");
    run({"Road/Curvature=" + std::to_string(curvature), "Study/Vary=Road/Distance = 0.7 | 0.8"});
    const auto rows = csv_rows(read("study.csv"));
    auto blocks = blocks_of(read("study-profiles.gp"));
    std::map<std::string, Rows> expected;
    for (const CsvRow& row : csv_rows(read("study-profiles.csv"))) {
      const std::string run = row.at("run") == rows.front().at("run") ? "1" : "2"; // its digest
      const double c = run == "1" ? 0.7 : 0.8, x = number(row, "z") - 1.5 * M_PI;
      const double m = 1 + curvature * c;
      expected["$curve_1_" + run].push_back(
          {curvature == 0 ? c * std::tan(x) : (std::asin(m * std::sin(x)) - x) / curvature,
           number(row, "pressure")});
    }
    for (const unsigned int run : {1, 2}) {
      const std::string name = "$curve_1_" + std::to_string(run);
      ASSERT_EQ(blocks[name].size(), expected[name].size());
      ASSERT_GT(blocks[name].size(), 5u);
      for (unsigned int i = 0; i < blocks[name].size(); ++i) {
        EXPECT_NEAR(blocks[name][i][0], expected[name][i][0], 1e-8);
        EXPECT_NEAR(blocks[name][i][1], expected[name][i][1], 1e-8);
      }
      // The nodes next to the ends of contact enclose the nip.
      EXPECT_NEAR(blocks[name].back()[0] - blocks[name].front()[0],
                  number(rows[run - 1], "contact.length"), 0.15);
    }
  }
}

TEST_F(Pictures, ProfilesOfScenesShowEachScene) {
  run({"Study/Scenes=slow: Cylinder/Angular velocity = 0; fast: Cylinder/Angular velocity = 1; "
       "soft: Cylinder/Radial force = 1",
       "Study/Vary=Road/Distance = 0.7 | 0.8 | 0.9", "Mesh/Degree=1"});
  const std::string script = read("study-profiles.gp");
  EXPECT_EQ(blocks_of(script).count("$curve_1_6"), 1u);
  EXPECT_EQ(blocks_of(script).count("$curve_1_7"), 0u);
  for (const char* const scene : {"slow, ", "fast, ", "soft, "})
    EXPECT_NE(script.find("title '" + std::string(scene)), std::string::npos) << scene;
}

TEST_F(Pictures, SceneShowsSurfaceGapAndPressure) {
  for (const double modulus : {1., 3.}) {
    fs::remove_all(directory / "out");
    run({"Material/Shear modulus=" + std::to_string(modulus)});
    auto blocks = blocks_of(read("scene.gp"));
    const auto rows = csv_rows(read("contact.csv"));
    ASSERT_EQ(blocks["$contact"].size(), rows.size());
    for (unsigned int i = 0; i < rows.size(); ++i) {
      const double x = number(rows[i], "z") - 1.5 * M_PI;
      EXPECT_NEAR(blocks["$contact"][i][0], 0.8 * std::tan(x), 1e-9);
      EXPECT_NEAR(blocks["$contact"][i][1], std::max(0., number(rows[i], "gap")), 1e-9);
      EXPECT_NEAR(blocks["$contact"][i][2], number(rows[i], "pressure"), 1e-9);
    }
    const auto contact = nlohmann::json::parse(read("summary.json"))["contact"];
    const double end = contact["right_end"].get<double>() - 1.5 * M_PI;
    EXPECT_NEAR(variable(read("scene.gp"), "range"), 0.8 * std::tan(1.5 * end), 1e-9);
    ASSERT_EQ(blocks["$surface"].size(), 2 * 60 + 1u); // closed
    for (const auto& point : blocks["$surface"])
      EXPECT_LT(std::hypot(point[0], point[1]), 1 + 1e-9);
    EXPECT_EQ(blocks["$surface"].front(), blocks["$surface"].back());
  }
}

TEST_F(Pictures, SceneHasRoomForContactAllAround) {
  run({"Cylinder/Radial force=2", "Road/Curvature=-0.9", "Road/Distance=1.05"});
  const std::string script = read("scene.gp");
  const double range = variable(script, "range");
  EXPECT_NEAR(range, M_PI / 0.9, 1e-9); // half of the drum
  const auto arrows = settings_of(script, "arrow");
  ASSERT_EQ(arrows.size(), 2u);
  for (const std::string& arrow : arrows)
    EXPECT_LE(std::abs(std::stod(arrow.substr(5))), range) << arrow;
  EXPECT_NE(script.find("\nzoom = b * 1\n"), std::string::npos); // not wider than the cylinder
}

TEST_F(Pictures, AxesSpanAPerCentOfTheirValues) {
  for (const double noise : {0., 1e-6, 0.5}) {
    const std::string script =
        rollwave::plot_panels("noise", "", {{"x", "y", {{"", {{1, 2}, {2, 2 + noise}}}}}}).script;
    const std::string range = settings_of(script, "yrange").front();
    if (noise > 0.02)
      EXPECT_EQ(range, "[*:*]");
    else {
      const double low = std::stod(range.substr(1)),
                   high = std::stod(range.substr(range.find(':') + 1));
      EXPECT_NEAR(high - low, 0.02, 1e-7);
      EXPECT_NEAR((high + low) / 2, 2 + noise / 2, 1e-7);
    }
  }
}

// With two patches no half-width is known.
TEST_F(Pictures, PanelsWithoutValuesLeaveTheOthers) {
  const Outcome outcome =
      shell("$rollwave '" ROLLWAVE_PRM_DIRECTORY "/examples/two-patches.prm' --output '" +
            (directory / "out").string() +
            "' --set 'Mesh/Radial cells=5' --set 'Mesh/Angular cells=120' --set "
            "'Mesh/Global refinements=0' --set 'Study/Vary=Road/Distance = 0.8 | 0.79'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_EQ(csv_rows(read("study.csv")).front().at("contact.half_width"), "");
  EXPECT_TRUE(has("study-curves.svg"));
}

TEST_F(Pictures, OnePointIsNoCurve) {
  run({"Study/Vary=Road/Distance = 0.8; Cylinder/Angular velocity = 0.5", "Mesh/Degree=1",
       "Mesh/Radial cells=2", "Mesh/Angular cells=48", "Output/Files=plot"});
  EXPECT_FALSE(has("study-curves.svg"));
  EXPECT_TRUE(has("study-profiles.svg"));
}

TEST_F(Pictures, LongNamesHaveRoomInTheLegend) {
  for (const unsigned int length : {20, 80, 200}) {
    const std::string name(length, 'n');
    const std::string text = drawn(rollwave::plot_panels(
        "long", "",
        {{"x", "y", {{name + " one", {{1, 2}, {2, 3}}}, {name + " two", {{1, 1}, {2, 2}}}}}}));
    for (const char* const end : {" one</text>", " two</text>"})
      EXPECT_NE(text.find(end), std::string::npos);
  }
}

TEST_F(Pictures, MapHasACellForEachRow) {
  run({"Study/Vary=Road/Distance = 0.8 : 0.68 : -0.02; Cylinder/Angular velocity = 0 : 0.9 : 0.15",
       "Mesh/Degree=1", "Mesh/Radial cells=2", "Mesh/Angular cells=48", "Output/Files=plot"});
  Rows expected;
  for (const CsvRow& row : csv_rows(read("study.csv")))
    expected.push_back({number(row, "Road/Distance"), number(row, "Cylinder/Angular velocity"),
                        number(row, "contact.vertical_load")});
  std::sort(expected.begin(), expected.end());
  const Rows points = blocks_of(read("study-map.gp"))["$map"];
  ASSERT_EQ(points.size(), 49u);
  ASSERT_EQ(points.size(), expected.size());
  for (unsigned int i = 0; i < points.size(); ++i) {
    for (unsigned int k = 0; k < 3; ++k)
      EXPECT_NEAR(points[i][k], expected[i][k], 1e-8);
    const std::vector<double> cell = {points[i][0] - 0.01, points[i][0] + 0.01,
                                      points[i][1] - 0.075, points[i][1] + 0.075};
    for (unsigned int k = 0; k < 4; ++k)
      EXPECT_NEAR(points[i][3 + k], cell[k], 1e-8);
  }
}

// Keys that vary together repeat a number of the first one: two runs would share a cell.
TEST_F(Pictures, NoMapWhereRunsShareACell) {
  run({"Study/Vary=Road/Distance & Cylinder/Inner radius = 0.78 & 0.5 | 0.78 & 0.4 | 0.8 & 0.5 | "
       "0.82 & 0.5 | 0.84 & 0.5 | 0.86 & 0.5 | 0.88 & 0.5 | 0.9 & 0.5; "
       "Cylinder/Angular velocity = 0 : 0.9 : 0.15",
       "Mesh/Degree=1", "Mesh/Radial cells=2", "Mesh/Angular cells=24", "Output/Files=plot"});
  EXPECT_FALSE(has("study-map.svg"));
}

TEST_F(Pictures, NoCurvesThatGoBackAndForth) {
  run({"Study/Vary=Road/Distance & Cylinder/Inner radius = 0.9 & 0.5 | 0.8 & 0.5 | 0.9 & 0.4 | "
       "0.8 & 0.4",
       "Mesh/Degree=1", "Mesh/Radial cells=2", "Mesh/Angular cells=24", "Output/Files=plot"});
  EXPECT_TRUE(has("study-profiles.svg"));
  EXPECT_FALSE(has("study-curves.svg"));
}

// Six curves can be told apart.
TEST_F(Pictures, CurvesTakeThePlaceOfAMapWithFewValuesOfAKey) {
  run({"Study/Vary=Road/Distance = 0.8 : 0.7 : -0.01; Cylinder/Angular velocity = 0 | 1",
       "Mesh/Degree=1", "Mesh/Radial cells=2", "Mesh/Angular cells=48", "Output/Files=plot"});
  EXPECT_FALSE(has("study-map.svg"));
  EXPECT_TRUE(has("study-curves.svg"));
}

TEST_F(Pictures, MapsHaveAtMostAMegabyte) {
  std::vector<std::vector<rollwave::MapPoint>> lines(300);
  for (unsigned int i = 0; i < lines.size(); ++i)
    for (unsigned int j = 0; j < 400; ++j)
      lines[i].push_back({1. * i, 1. * j, std::sin(0.02 * i) * j});
  EXPECT_LT(drawn(rollwave::plot_map("", "x", "y", "value", lines)).size(), 1000000u);
}

TEST(Spread, HasFirstAndLast) {
  using rollwave::spread;
  EXPECT_EQ(spread(3, 6), (std::vector<unsigned int>{0, 1, 2}));
  EXPECT_EQ(spread(51, 6), (std::vector<unsigned int>{0, 10, 20, 30, 40, 50}));
  EXPECT_EQ(spread(1000001, 3), (std::vector<unsigned int>{0, 500000, 1000000}));
  EXPECT_EQ(spread(1, 6), (std::vector<unsigned int>{0}));
  EXPECT_TRUE(spread(0, 6).empty());
}

/// The titles of the curves of a script.
std::vector<std::string> titles_of(const std::string& script) {
  static const std::regex title("title '([^']+)'");
  std::vector<std::string> titles;
  const std::string plots = script.substr(script.find("\nplot "));
  for (std::sregex_iterator match(plots.begin(), plots.end(), title), end; match != end; ++match)
    titles.push_back((*match)[1]);
  return titles;
}

TEST_F(Pictures, ProfilesHaveTheSameValuesOfTheFastestKey) {
  run({"Study/Vary=Road/Curvature = 0 | 1/3; Road/Distance = 0.7 : 0.82 : 0.02", "Mesh/Degree=1",
       "Output/Files=plot"});
  const auto titles = titles_of(read("study-profiles.gp"));
  ASSERT_EQ(titles.size(), 6u);
  const auto distance = [](const std::string& title) { return title.substr(title.find("c = ")); };
  for (unsigned int i = 0; i < 3; ++i) {
    EXPECT_NE(titles[i], titles[3 + i]);
    EXPECT_EQ(distance(titles[i]), distance(titles[3 + i]));
  }
  EXPECT_NE(distance(titles[0]), distance(titles[1]));
}

TEST_F(Pictures, TitlesHaveNumbersOfFiveDigits) {
  const std::vector<std::string> third = {
      "Cylinder/Inner radius=10/3", "Cylinder/Outer radius=20/3", "Road/Curvature=1/30",
      "Material/Shear modulus=4.5/3", "Cylinder/Angular velocity=1/30"};
  const auto expect_short = [&](const std::string& picture) {
    static const std::regex digits("[0-9.]{10,}");
    const std::string script = read(picture);
    const std::string plots = script.substr(script.find("\nset multiplot"));
    const std::string title = plots.substr(0, plots.find(" font ", 1));
    EXPECT_FALSE(std::regex_search(title, digits)) << title;
    for (const std::string& curve : titles_of(script))
      EXPECT_FALSE(std::regex_search(curve, digits)) << curve;
  };
  auto settings = third;
  settings.push_back("Road/Distance=17/3");
  run(settings);
  expect_short("scene.gp");
  settings = third;
  settings.push_back("Study/Vary=Road/Distance = 16/3 | 17/3");
  run(settings);
  expect_short("study-profiles.gp");
}

TEST_F(Pictures, AreNamedAdaptiveOnlyIfAllRunsAre) {
  for (const auto& [marking, are_adaptive] :
       {std::pair("bulk", true), {"bulk | all", false}, {"all", false}}) {
    fs::remove_all(directory / "out");
    run({"Mesh/Adaptive cycles=1", "Mesh/Degree=1",
         "Study/Vary=Mesh/Marking = " + std::string(marking) + "; Road/Distance = 0.7 | 0.8"});
    EXPECT_EQ(read("study-curves.gp").find("adaptive' font") != std::string::npos, are_adaptive)
        << marking;
  }
}

TEST_F(Pictures, KeysThatVaryTogetherDrawNoZigzag) {
  run({"Study/Vary=Mesh/Radial cells & Mesh/Angular cells = 2 & 48 | 4 & 48 | 2 & 96",
       "Mesh/Degree=1", "Output/Files=plot"});
  EXPECT_FALSE(has("study.svg"));
  fs::remove_all(directory / "out");
  run({"Study/Vary=Mesh/Radial cells & Mesh/Angular cells = 2 & 48 | 4 & 96", "Mesh/Degree=1",
       "Output/Files=plot"});
  EXPECT_TRUE(has("study.svg"));
}

TEST_F(Pictures, HaveTheFormatThatIsGiven) {
  for (const auto& [format, begin] :
       {std::pair("svg", "<?xml"), {"png", "\x89PNG"}, {"pdf", "%PDF"}}) {
    run({"Output/Files=plot", std::string("Output/Picture format=") + format});
    const std::string name = std::string("scene.") + format, picture = read(name);
    EXPECT_EQ(picture.rfind(begin, 0), 0u) << format;
    fs::remove(directory / "out" / name);
    const Outcome outcome = shell("cd '" + (directory / "out").string() + "' && gnuplot scene.gp");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
    EXPECT_TRUE(has(name));
  }
}

TEST_F(Pictures, ContoursOfASmallMapHaveLabels) {
  std::vector<std::vector<rollwave::MapPoint>> lines(3);
  for (const double x : {0., 1., 2.})
    for (const double y : {0., 1., 2.})
      lines[x].push_back({x, y, 10000 * (1 + x + y)});
  const std::string text = drawn(rollwave::plot_map("", "x", "y", "value", lines));
  // The colour box has each number once.
  EXPECT_NE(text.find(">30000</text>"), text.rfind(">30000</text>"));
}

} // namespace
