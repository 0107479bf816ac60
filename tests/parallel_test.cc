// Many processes give the answer of one, and end together.
#include "program.h"
#include "quantities.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>
#include <vector>

namespace {

/// The start of a command that runs on @p n processes, more than there are cores if need be,
/// without what MPI may have left in the environment of the tests.
std::string on_processes(int n) {
  return "env -i PATH=\"$PATH\" HOME=\"$HOME\" rollwave=\"$rollwave\" OMPI_ALLOW_RUN_AS_ROOT=1 "
         "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OPENBLAS_NUM_THREADS=1 "
         "mpirun --oversubscribe -np " +
         std::to_string(n) + " ";
}

/// The numbers of cells of the pieces of a VTU file.
std::vector<unsigned int> cells_of_pieces(const std::string& vtu) {
  const std::string start = "NumberOfCells=\"";
  std::vector<unsigned int> cells;
  for (auto place = vtu.find(start); place != std::string::npos; place = vtu.find(start, place + 1))
    cells.push_back(std::stoul(vtu.substr(place + start.size(), 20)));
  return cells;
}

class Processes : public Program {
protected:
  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(directory / "out"))
      names.insert(entry.path().filename());
    return names;
  }

  /// Expects 2, 3 and 5 processes to find the numbers, the contact and the files of one.
  void expect_answer_of_one(const std::string& arguments) {
    std::filesystem::remove_all(directory / "out");
    const Outcome alone =
        shell("$rollwave " + arguments + " --output '" + (directory / "out").string() + "'");
    ASSERT_EQ(alone.exit_code, 0) << alone.text;
    const auto expected = nlohmann::json::parse(read("summary.json"));
    const auto expected_rows = csv_rows(read("contact.csv"));
    const std::set<std::string> expected_files = files();
    for (const int n : {2, 3, 5}) {
      SCOPED_TRACE(n);
      const Outcome many = shell(on_processes(n) + "$rollwave " + arguments + " --output '" +
                                 (directory / "out").string() + "'");
      ASSERT_EQ(many.exit_code, 0) << many.text;
      EXPECT_EQ(many.text.find("Result"), many.text.rfind("Result")) << "printed more than once";
      const auto summary = nlohmann::json::parse(read("summary.json"));
      rollwave::expect_same_quantities(rollwave::quantities_of(summary),
                                       rollwave::quantities_of(expected),
                                       rollwave::tolerance_of_solvers);
      EXPECT_EQ(summary["iterations"]["contact"], expected["iterations"]["contact"]);
      EXPECT_LT(summary["residuals"]["equilibrium"].get<double>(), 1e-10);
      const auto rows = csv_rows(read("contact.csv"));
      ASSERT_EQ(rows.size(), expected_rows.size());
      for (unsigned int i = 0; i < rows.size(); ++i) {
        EXPECT_NEAR(std::stod(rows[i].at("z")), std::stod(expected_rows[i].at("z")), 1e-14);
        EXPECT_EQ(std::stod(rows[i].at("pressure")) > 0, // the active set
                  std::stod(expected_rows[i].at("pressure")) > 0)
            << rows[i].at("z");
      }
      EXPECT_EQ(files(), expected_files);
      const std::vector<unsigned int> cells = cells_of_pieces(read("solution.vtu"));
      EXPECT_GT(cells.size(), 1u);
      EXPECT_LE(cells.size(), static_cast<unsigned int>(n));
      EXPECT_EQ(std::count(cells.begin(), cells.end(), 0u), 0);
      EXPECT_EQ(std::accumulate(cells.begin(), cells.end(), 0u), expected["mesh"]["cells"]);
    }
  }
};

TEST_F(Processes, HaveTheAnswerOfOneAtTheCriticalSpeed) {
  expect_answer_of_one("'" ROLLWAVE_PRM_DIRECTORY "/figure-5.prm' --set 'Mesh/Radial cells=6' "
                       "--set 'Mesh/Angular cells=90'");
}

TEST_F(Processes, RefineLikeOne) {
  expect_answer_of_one("'" ROLLWAVE_PRM_DIRECTORY "/figure-6.prm' --set 'Mesh/Radial cells=3' "
                       "--set 'Mesh/Angular cells=38' --set 'Mesh/Wanted relative error=1e-2'");
}

// Of five, two begin without a cell, and most without a contact node for long.
TEST_F(Processes, MayBeMoreThanCells) {
  expect_answer_of_one(scene + " --set 'Mesh/Radial cells=1' --set 'Mesh/Angular cells=3' --set "
                               "'Mesh/Adaptive cycles=4' --set 'Mesh/Degree=2'");
}

// Processes with one column of cells or none: the cells on both sides of a column are the same.
TEST_F(Processes, MayBeMoreThanColumns) {
  expect_answer_of_one(scene + " --set 'Mesh/Radial cells=5' --set 'Mesh/Global refinements=1' "
                               "--set 'Mesh/Angular cells=3' --set 'Mesh/Degree=2'");
}

TEST_F(Processes, HaveTheAnswerOfOneByCubicElements) {
  expect_answer_of_one(scene + " --set Mesh/Degree=3");
}

TEST_F(Processes, HaveTheAnswerOfOneInAThinRing) {
  expect_answer_of_one(scene + " --set 'Cylinder/Inner radius=0.999' --set Road/Distance=0.9995 "
                               "--set 'Mesh/Radial cells=2' --set 'Mesh/Angular cells=200'");
}

TEST_F(Processes, IterateLikeOneByUzawa) {
  expect_answer_of_one(scene + " --set 'Contact/Method=uzawa' --set 'Contact/Tolerance=1e-8'");
}

TEST_F(Processes, RefineAThickRingWithAnUnevenForceLikeOne) {
  expect_answer_of_one(scene + " --set 'Cylinder/Inner radius=0.05' --set 'Cylinder/Radial "
                               "force=0.1*cos(z)*r' --set 'Cylinder/Angular velocity=1' --set "
                               "'Mesh/Wanted relative error=0.2' --set 'Mesh/Degree=2'");
}

TEST_F(Processes, FindALoadInADrumLikeOne) {
  expect_answer_of_one(scene + " --set Road/Curvature=-0.5 --set Road/Load=0.2 --set 'Road/Load "
                               "kind=total'");
}

TEST_F(Processes, HaveTwoPatchesInUnitsLikeOne) {
  expect_answer_of_one(
      scene + " --set Material/Density=1.1e-9 --set Material/Width=200 --set 'Cylinder/Inner "
              "radius=17.5' --set 'Cylinder/Outer radius=35' --set 'Cylinder/Angular velocity=86' "
              "--set Road/Distance=28 --set 'Cylinder/Radial "
              "force=-0.2*exp(-((z-4.71238898)/0.12)^2)' --set 'Mesh/Angular cells=120'");
}

// Columns of two lengths.
TEST_F(Processes, MeetTheEndsOfTheZoneLikeOne) {
  expect_answer_of_one(
      scene + " --set 'Road/Contact zone=4.450589592586, 4.9741883681836' --set Mesh/Degree=2");
}

// Jumps, of which some are seen at the points of the load only.
TEST_F(Processes, CertifyForcesWithJumpsLikeOne) {
  expect_answer_of_one(scene + " --set 'Cylinder/Radial force=floor(8*r)/10"
                               "+if((r-0.8)^2+(z-1.4)^2<0.0025,1,0)+if(abs(z-4.52)<0.03,1,0)'"
                               " --set 'Mesh/Degree=2' --set 'Mesh/Adaptive cycles=1'");
}

// The width that the points of a force leave is that of the whole mesh, whatever cells they own.
TEST_F(Processes, SeeAForceInASmallHubLikeOne) {
  expect_answer_of_one(scene + " --set 'Cylinder/Radial force=r*cos(z)' --set 'Cylinder/Inner "
                               "radius=0.001' --set 'Mesh/Radial cells=3' --set 'Mesh/Angular "
                               "cells=60'");
}

// Where cells on both sides touch in a vertex only.
TEST_F(Processes, RefineAcrossTheSeamLikeOne) {
  expect_answer_of_one(
      scene + " --set Mesh/Degree=1 --set 'Cylinder/Angular velocity=0.9' --set Road/Distance=0.95 "
              "--set 'Road/Contact zone=4.5, 5.1' --set 'Cylinder/Radial force=if(r<0.7123,1,0)' "
              "--set 'Mesh/Radial cells=3' --set 'Mesh/Angular cells=20' --set 'Mesh/Global "
              "refinements=1' --set 'Mesh/Adaptive cycles=3' --set Mesh/Indicator=kelly --set "
              "'Mesh/Marked fraction=0.8' --set 'Mesh/Most unknowns=3000'");
}

TEST_F(Processes, ReadAPipeTogether) {
  const Outcome outcome = shell("cat " + scene + " | " + on_processes(2) + "$rollwave /dev/stdin");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_EQ(nlohmann::json::parse(read("summary.json"))["mesh"]["cells"], 4 * 60);
}

void expect_refusal(const Outcome& outcome, const std::string& words) {
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.text.find(words), std::string::npos) << outcome.text;
  EXPECT_EQ(outcome.text.find("rollwave: "), outcome.text.rfind("rollwave: ")) << outcome.text;
}

TEST_F(Processes, ReportBadInputOnce) {
  expect_refusal(shell(on_processes(3) + "$rollwave " + scene + " --set Solver/Kind=direct"),
                 "Solver");
  expect_refusal(shell(on_processes(2) + "$rollwave /no/such/file"), "cannot be read");
}

TEST_F(Processes, EndTogetherWhenOneIsKilled) {
  const std::string run = "$rollwave " + scene +
                          " --set Mesh/Degree=2 --set \"Mesh/Radial cells=200\" --set "
                          "\"Mesh/Angular cells=2000\"";
  std::ofstream(directory / "rank.sh")
      << "if [ $OMPI_COMM_WORLD_RANK = 1 ]; then " << run
      << " & sleep 2; kill -9 $!; wait $!; kill -9 $$; fi\nexec " << run << '\n';
  const Outcome outcome =
      shell("timeout 60 " + on_processes(3) + "sh '" + (directory / "rank.sh").string() + "'");
  EXPECT_NE(outcome.text.find("signal 9"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.exit_code, 124) << "still running";
  EXPECT_FALSE(has("summary.json"));
  EXPECT_FALSE(has("solution.vtu"));
}

#ifndef __SANITIZE_ADDRESS__ // which needs the whole address space
// One process may run out of memory alone. With less address space Open MPI or p4est may end the
// program before.
TEST_F(Processes, EndTogetherWithoutMemory) {
  for (const auto& [radial_cells, angular_cells, kibibytes] :
       {std::tuple(150, 1800, 1200000), {200, 2400, 1700000}}) {
    const Outcome outcome =
        shell("ulimit -c 0; timeout 60 " + on_processes(2) + "sh -c \"ulimit -v " +
              std::to_string(kibibytes) + "; exec $rollwave " + scene +
              " --set Mesh/Degree=2 --set 'Mesh/Radial cells=" + std::to_string(radial_cells) +
              "' --set 'Mesh/Angular cells=" + std::to_string(angular_cells) + "'\"");
    EXPECT_EQ(outcome.exit_code, 2) << radial_cells << outcome.text; // 124: still running
    EXPECT_NE(outcome.text.find("rollwave: not solved: "), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find("memory"), std::string::npos) << outcome.text;
    EXPECT_FALSE(has("summary.json"));
  }
}
#endif

#ifndef __SANITIZE_ADDRESS__
// One process alone, which does not write the files, while the others wait for its messages. Open
// MPI 5 does not start with less than 950000 KiB.
TEST_F(Processes, EndTogetherWhereOneHasNoMemory) {
  for (const int kibibytes : {1000000, 1100000, 1200000}) {
    std::ofstream(directory / "rank.sh")
        << "[ $OMPI_COMM_WORLD_RANK = 1 ] && ulimit -v " << kibibytes << "\nexec $rollwave "
        << scene << " --set Mesh/Degree=2 --set 'Mesh/Radial cells=150' --set 'Mesh/Angular "
        << "cells=1800'\n";
    const Outcome outcome = shell("ulimit -c 0; timeout 60 " + on_processes(3) + "sh '" +
                                  (directory / "rank.sh").string() + "'");
    EXPECT_FALSE(has("summary.json"));
    if (outcome.text.find("Abort: ") != std::string::npos) // by p4est
      continue;
    EXPECT_EQ(outcome.exit_code, 2) << kibibytes << outcome.text; // 124: still running
    EXPECT_NE(outcome.text.find("rollwave: not solved: "), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find("memory"), std::string::npos) << outcome.text;
  }
}
#endif

class StudyOnProcesses : public Processes {
protected:
  /// Expects the rows of study.csv to have the same figures, where these do not depend on the
  /// machine.
  void expect_figures(const std::vector<CsvRow>& expected) const {
    const auto own = csv_rows(read("study.csv"));
    ASSERT_EQ(own.size(), expected.size());
    for (unsigned int run = 0; run < own.size(); ++run)
      for (const char* name : {"mesh.dofs", "iterations.contact", "contact.force",
                               "error.certified_relative", "energy.value"}) {
        const double wanted = std::stod(expected[run].at(name));
        EXPECT_NEAR(std::stod(own[run].at(name)), wanted, 1e-8 * std::abs(wanted)) << name;
      }
  }
};

TEST_F(StudyOnProcesses, IsThatOfOne) {
  const std::string study =
      scene + " --set 'Cylinder/Radial force=20' --set 'Study/Vary=Road/Distance = 0.9 | 0.6'";
  const Outcome alone = shell("$rollwave " + study);
  ASSERT_EQ(alone.exit_code, 0) << alone.text;
  const auto expected = csv_rows(read("study.csv"));
  std::filesystem::remove_all(directory / "out");
  const Outcome many = shell(on_processes(2) + "$rollwave " + study);
  ASSERT_EQ(many.exit_code, 0) << many.text;
  EXPECT_EQ(many.text.find("Distance"), many.text.rfind("Distance"));
  expect_figures(expected);
}

// Those that have nothing to write wait for rank 0 before all of them end.
TEST_F(StudyOnProcesses, WaitForRankZeroToWrite) {
  const std::filesystem::path slow = directory / "gnuplot";
  std::ofstream(slow) << "#!/bin/sh\nsleep 0.3\nexec $(command -v -p gnuplot) \"$@\"\n";
  std::filesystem::permissions(slow, std::filesystem::perms::owner_all);
  // A study of 300 meshes, interrupted once the first of its records is there: long before the
  // last, however fast the machine.
  std::string cells = "400";
  for (int n = 401; n < 700; ++n)
    cells += " | " + std::to_string(n);
  std::ofstream(directory / "rank.sh")
      << "exec $rollwave " << scene << " --set 'Mesh/Radial cells=5' --set 'Study/True errors=true'"
      << " --set 'Study/Vary=Mesh/Angular cells = " << cells << "' &\nuntil ls '"
      << (directory / "out" / "runs").string()
      << "' 2>/dev/null | grep -q 'json$'; do sleep 0.1; done\nkill -TERM $!\nwait $!\n";
  const Outcome outcome = shell("export PATH='" + directory.string() + "':$PATH; timeout 60 " +
                                on_processes(3) + "sh '" + (directory / "rank.sh").string() + "'");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
  EXPECT_NE(outcome.text.find("interrupted after"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("study.tex"), std::string::npos) << outcome.text; // listed in the end
  EXPECT_GT(csv_rows(read("study.csv")).size(), 0u);
}

} // namespace
