// Whatever ends a run, it says why, and every file is complete or absent; a stopped study goes on.
#include "program.h"
#include "rollwave/base/interrupt.h"
#include "test_scenes.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <list>
#include <map>
#include <random>
#include <thread>
#include <unistd.h>

namespace fs = std::filesystem;
using namespace rollwave;
using namespace std::chrono_literals;

namespace {

using Seconds = std::chrono::duration<double>;

/// The program as a process that can be watched and signalled.
class RunningProgram {
public:
  explicit RunningProgram(std::vector<std::string> arguments) {
    int ends[2];
    if (pipe(ends) != 0)
      throw std::runtime_error("no pipe");
    process = fork();
    if (process == 0) {
      dup2(ends[1], STDOUT_FILENO);
      dup2(ends[1], STDERR_FILENO);
      close(ends[0]);
      close(ends[1]);
      std::vector<char*> argv = {const_cast<char*>(ROLLWAVE_EXECUTABLE)};
      for (std::string& argument : arguments)
        argv.push_back(argument.data());
      argv.push_back(nullptr);
      std::signal(SIGINT, SIG_DFL); // which a shell ignores for its background jobs
      execv(argv[0], argv.data());
      _exit(126);
    }
    close(ends[1]);
    stream = ends[0];
  }

  ~RunningProgram() {
    if (process > 0)
      end_by(SIGKILL);
    close(stream);
  }
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  /// Returns when the program has said @p words, or has ended without.
  void await(const std::string& words) {
    while (said.find(words) == std::string::npos && listen()) {
    }
  }

  void send(int signal) const { kill(process, signal); }

  Outcome end() {
    while (listen()) {
    }
    int status = 0;
    waitpid(process, &status, 0);
    process = 0;
    return {exit_code_of(status), said};
  }

  Outcome end_by(int signal) {
    send(signal);
    return end();
  }

private:
  bool listen() {
    std::array<char, 4096> buffer;
    const auto count = ::read(stream, buffer.data(), buffer.size());
    if (count > 0)
      said.append(buffer.data(), count);
    return count > 0;
  }

  pid_t process;
  int stream;
  std::string said;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    lines.push_back(line);
  return lines;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

class Faults : public Program {
protected:
  Faults() { testing::FLAGS_gtest_death_test_style = "threadsafe"; }

  /// The arguments of a run of the fixture's scene.
  std::vector<std::string> arguments(const std::vector<std::string>& assignments) const {
    std::vector<std::string> all = {(directory / "scene.prm").string()};
    for (const std::string& assignment : assignments) {
      all.push_back("--set");
      all.push_back(assignment);
    }
    return all;
  }

  Outcome run(const std::vector<std::string>& assignments) const {
    return RunningProgram(arguments(assignments)).end();
  }

  /// The files of a run, without those under temporary names.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> contents;
    if (fs::exists(directory / "out"))
      for (const auto& entry : fs::directory_iterator(directory / "out"))
        if (entry.path().extension() != ".part")
          contents[entry.path().filename().string()] = read(entry.path().filename().string());
    return contents;
  }

  /// Every file that is there is that of the undisturbed run with the files @p undisturbed.
  void expect_complete(const std::map<std::string, std::string>& undisturbed) const {
    for (const auto& [name, content] : files()) {
      const auto file = undisturbed.find(name);
      ASSERT_NE(file, undisturbed.end()) << name;
      if (name == "summary.json") {
        // Times differ.
        EXPECT_EQ(nlohmann::json::parse(content)["contact"],
                  nlohmann::json::parse(file->second)["contact"]);
        EXPECT_TRUE(ends_with(content, "}\n"));
      } else
        EXPECT_TRUE(content == file->second) << name;
    }
  }
};

/// study.csv without its last columns: work, seconds, memory and shared.
std::vector<std::string> figures_of_study(const std::string& csv) {
  std::vector<std::string> rows = lines_of(csv);
  const std::string header = rows.front();
  const auto n_costs = std::count(header.begin() + header.find(",work."), header.end(), ',');
  for (std::string& row : rows)
    for (int i = 0; i < n_costs; ++i)
      row.erase(row.rfind(','));
  return rows;
}

const std::vector<std::string> endless_refinement = {"Mesh/Wanted relative error=1e-12",
                                                     "Mesh/Most unknowns=100000000"};

TEST_F(Faults, InterruptedBetweenMeshesLeavesTheLast) {
  for (const int signal : {SIGINT, SIGUSR1}) {
    RunningProgram program(arguments(endless_refinement));
    program.await("Road");
    std::this_thread::sleep_for(500ms);
    const Outcome outcome = program.end_by(signal);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
    for (const char* name :
         {"summary.json", "contact.csv", "parameters.prm", "solution.vtu", "scene.svg"})
      EXPECT_TRUE(has(name)) << name;
    const auto json = nlohmann::json::parse(read("summary.json"));
    EXPECT_FALSE(json["shortfall"].get<std::string>().empty());
    EXPECT_GT(json["error"]["certified_relative"], 0);
    EXPECT_LT(json["error"]["certified_relative"], 0.1);
    fs::remove_all(directory / "out");
  }
}

TEST_F(Faults, SecondInterruptEndsAtOnce) {
  RunningProgram program(arguments({"Mesh/Radial cells=100", "Mesh/Angular cells=2000"}));
  program.await("Road");
  std::this_thread::sleep_for(100ms);
  program.send(SIGINT);
  program.await("interrupted");
  const Outcome outcome = program.end_by(SIGINT);
  EXPECT_EQ(outcome.exit_code, 128 + SIGINT) << outcome.text;
  EXPECT_TRUE(files().empty());
}

TEST_F(Faults, InterruptEndsAfterTheCurrentMesh) {
  const auto simulate_interrupted = [](const std::vector<std::string>& assignments) {
    install_signal_handlers();
    const Parameters parameters = parameters_of(assignments);
    Scene scene = make_scene(parameters);
    scene.phi.displacement = [phi = scene.phi](double z) {
      if (!is_interrupted(MPI_COMM_SELF))
        std::raise(SIGTERM); // on the first mesh
      return phi(z);
    };
    const Result result = simulate(scene, parameters).result;
    std::cerr << shortfall_text(result.notes) << " [" << result.cycles.size() << " "
              << result.history.size() << " " << result.certified.has_value() << "]";
    std::exit(result.is_interrupted ? 2 : 0);
  };
  EXPECT_EXIT(simulate_interrupted({"Mesh/Adaptive cycles=3"}), testing::ExitedWithCode(2),
              " \\[1 [2-9] 1\\]");
  // The result is complete if the last mesh is solved.
  EXPECT_EXIT(simulate_interrupted({}), testing::ExitedWithCode(0), " \\[1 [2-9] 1\\]");
}

// As nohup and background jobs of a shell's scripts have it.
TEST_F(Faults, SignalsThatTheParentIgnoresStayIgnored) {
  for (const char* name : {"INT", "TERM", "USR1"}) {
    const Outcome outcome =
        shell(std::string("trap '' ") + name + "; $rollwave " + scene +
              " --set Mesh/Angular\\ cells=600 & sleep 0.5; kill -" + name + " $!; wait $!");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
    EXPECT_EQ(outcome.text.find("interrupted"), std::string::npos) << outcome.text;
  }
}

TEST_F(Faults, InterruptedStudyKeepsItsRunsAndGoesOn) {
  const std::vector<std::string> study = {
      "Study/Vary=Mesh/Degree = 1 | 2; Road/Distance = 0.75 | 0.8 | 0.85",
      "Mesh/Wanted relative error=0.01"};
  ASSERT_EQ(run(study).exit_code, 0);
  const auto undisturbed = figures_of_study(read("study.csv"));
  fs::remove_all(directory / "out");

  RunningProgram program(arguments(study));
  program.await("\n2 of ");
  const Outcome outcome = program.end_by(SIGINT);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
  const auto kept = figures_of_study(read("study.csv"));
  ASSERT_GE(kept.size(), 3u);
  ASSERT_LT(kept.size(), undisturbed.size());
  EXPECT_TRUE(std::equal(kept.begin(), kept.end(), undisturbed.begin()));

  const Outcome again = run(study);
  EXPECT_EQ(again.exit_code, 0) << again.text;
  EXPECT_EQ(figures_of_study(read("study.csv")), undisturbed);
}

TEST_F(Faults, KilledAtAnyMomentLeavesCompleteFiles) {
  const std::vector<std::string> settings = {"Mesh/Radial cells=20", "Mesh/Angular cells=480",
                                             "Output/Files=summary, contact, parameters, solution"};
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(run(settings).exit_code, 0);
  const Seconds duration = std::chrono::steady_clock::now() - begin;
  const auto undisturbed = files();

  std::minstd_rand random(1);
  std::uniform_real_distribution<double> share(0.3, 1.1);
  for (unsigned int i = 0; i < 6; ++i) {
    fs::remove_all(directory / "out");
    RunningProgram program(arguments(settings));
    std::this_thread::sleep_for(share(random) * duration);
    program.end_by(i % 2 == 0 ? SIGKILL : SIGHUP);
    expect_complete(undisturbed);
  }
}

// Next to two copies of itself, three parts of it and another study, all in one directory.
TEST_F(Faults, StudyThatIsKilledSideBySideWithOthersEndsAsTheUndisturbedOne) {
  const std::string distances = "Road/Distance = 0.7 : 0.92 : 0.02";
  const std::vector<std::string> tiny = {"Mesh/Radial cells=2", "Mesh/Angular cells=24",
                                         "Output/Files=", "Study/Files of each run=contact"};
  const auto arguments_of = [&](const std::string& vary, const std::string& part = "") {
    auto all = arguments(tiny);
    all.insert(all.end(), {"--set", "Study/Vary=" + vary});
    if (!part.empty())
      all.insert(all.end(), {"--part", part});
    return all;
  };
  const std::string one = distances + "; Mesh/Degree = 1 | 2",
                    other = "Mesh/Degree = 2; " + distances + "; Road/Curvature = 0 | 1 | -0.1";
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(RunningProgram(arguments_of(one)).end().exit_code, 0);
  const Seconds duration = std::chrono::steady_clock::now() - begin;
  const auto undisturbed = figures_of_study(read("study.csv"));
  const auto profiles = read("study-profiles.csv");
  ASSERT_EQ(undisturbed.size(), 25u);
  fs::remove_all(directory / "out");

  std::minstd_rand random(2);
  std::uniform_real_distribution<double> share(0.1, 1.);
  for (unsigned int i = 0; i < 5; ++i) { // six kills each
    std::list<RunningProgram> programs;
    programs.emplace_back(arguments_of(other));
    programs.emplace_back(arguments_of(one));
    programs.emplace_back(arguments_of(one));
    for (const char* const part : {"1/3", "2/3", "3/3"})
      programs.emplace_back(arguments_of(one, part));
    for (RunningProgram& program : programs) {
      std::this_thread::sleep_for(share(random) * duration / 2);
      program.end_by(SIGKILL);
    }
  }
  const Outcome outcome = RunningProgram(arguments_of(one)).end();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_EQ(figures_of_study(read("study.csv")), undisturbed);
  EXPECT_EQ(lines_of(read("study-profiles.csv")).size(), lines_of(profiles).size());
  for (const CsvRow& row : csv_rows(read("study.csv")))
    EXPECT_GT(read(row.at("files") + "/contact.csv").size(), 500u);
}

#ifndef __SANITIZE_ADDRESS__ // which needs the whole address space
TEST_F(Faults, LimitedAddressSpaceIsEnoughOrTheRunEnds) {
  constexpr unsigned int lots = 4000000; // KiB
  std::vector<unsigned int> limits = {lots};
  for (unsigned int limit = 440000; limit < 900000; limit += 20000)
    limits.push_back(limit);
  for (const char* const threads : {"1", "2", ""})
    for (const unsigned int most : limits) {
      const Outcome outcome =
          shell("unset OMP_NUM_THREADS; export OPENBLAS_NUM_THREADS=" + std::string(threads) +
                "; ulimit -v " + std::to_string(most) + "; timeout -s KILL 60 $rollwave " + scene);
      const bool is_loaded = outcome.exit_code != 127; // the loader's, without room for libraries
      if (most == lots && *threads) {
        EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
      } else if (is_loaded) {
        EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 2) << most << outcome.text;
      }
    }
}

// The dense matrices of some 4000 contact nodes do not fit.
TEST_F(Faults, DenseProblemWithoutMemoryIsOneMessage) {
  for (const char* const kibibytes : {"700000", "900000"}) {
    const Outcome outcome =
        shell(std::string("ulimit -v ") + kibibytes + "; timeout 60 $rollwave " + scene +
              " --set 'Mesh/Radial cells=1' --set 'Mesh/Angular cells=20000'");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
    EXPECT_NE(outcome.text.find("memory"), std::string::npos) << outcome.text;
    EXPECT_LE(lines_of(outcome.text.substr(outcome.text.find("rollwave: not solved"))).size(), 2u)
        << outcome.text;
  }
}
#endif

TEST_F(Faults, FullDiskLeavesWhatFitsComplete) {
  ASSERT_EQ(run({}).exit_code, 0);
  const auto undisturbed = files();
  std::size_t largest = 0;
  for (const auto& [name, content] : undisturbed)
    largest = std::max(largest, content.size());
  for (std::size_t blocks = 0; 512 * blocks < largest; blocks = blocks * 4 + 1) {
    fs::remove_all(directory / "out");
    const Outcome outcome = shell("ulimit -f " + std::to_string(blocks) + "; $rollwave " + scene);
    EXPECT_EQ(outcome.exit_code, 3) << outcome.text;
    EXPECT_LT(files().size(), undisturbed.size());
    expect_complete(undisturbed);
    expect_no_partial_files();
  }
}

// The field is not written, so that the picture is the largest file.
TEST_F(Faults, FullDiskForAPictureIsAFailureToWrite) {
  const std::string call = "$rollwave " + scene + " --set 'Output/Files=summary, plot'";
  ASSERT_EQ(shell(call).exit_code, 0);
  const auto undisturbed = files();
  const std::size_t script = undisturbed.at("scene.gp").size(),
                    picture = undisturbed.at("scene.svg").size();
  ASSERT_GT(picture, script + 2048);
  fs::remove_all(directory / "out");
  const Outcome outcome = shell("ulimit -f " + std::to_string(script / 512 + 2) + "; " + call);
  EXPECT_EQ(outcome.exit_code, 3) << outcome.text;
  EXPECT_TRUE(has("scene.gp"));
  EXPECT_FALSE(has("scene.svg"));
  expect_no_partial_files();
}

TEST_F(Faults, NumberOfThreadsThatIsNoneIsBadInput) {
  for (const char* const number : {"", "0", "abc", "-1", "2x"})
    EXPECT_EQ(
        shell("DEAL_II_NUM_THREADS='" + std::string(number) + "' $rollwave --version").exit_code,
        1);
  EXPECT_EQ(shell("DEAL_II_NUM_THREADS=2 $rollwave --version").exit_code, 0);
}

TEST_F(Faults, LostScreenCostsNoFile) {
  ASSERT_EQ(run({}).exit_code, 0);
  const auto undisturbed = files();
  // A full device, and a reader who has gone.
  for (const std::string& call :
       {"$rollwave " + scene + " > /dev/full; exit $?", "{ { $rollwave " + scene +
                                                            "; echo $? >&3; } | true; } 3>&1 | "
                                                            "{ read code; exit $code; }"}) {
    fs::remove_all(directory / "out");
    const Outcome outcome = shell(call);
    EXPECT_EQ(outcome.exit_code, 3) << call << '\n' << outcome.text;
    EXPECT_EQ(files().size(), undisturbed.size()) << call;
    expect_complete(undisturbed);
  }
}

TEST_F(Faults, GnuplotThatFailsCostsThePictureOnly) {
  const fs::path bin = directory / "bin";
  fs::create_directory(bin);
  std::ofstream(bin / "gnuplot") << "#!/bin/sh\necho '<svg'\nexit 1\n";
  fs::permissions(bin / "gnuplot", fs::perms::owner_all);
  const Outcome outcome = shell("PATH='" + bin.string() + "':$PATH $rollwave " + scene);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_FALSE(has("scene.svg"));
  EXPECT_TRUE(has("scene.gp"));
  EXPECT_TRUE(has("summary.json"));
}

// The numbers are there before gnuplot begins, which has a minute: here the test shortens it.
TEST_F(Faults, GnuplotThatHangsCostsThePictureOnly) {
  const fs::path bin = directory / "bin";
  fs::create_directory(bin);
  std::ofstream(bin / "gnuplot") << "#!/bin/sh\ncp summary.json '" << bin.string()
                                 << "/earlier.json'\nsleep 1000\n";
  std::ofstream(bin / "timeout") << "#!/bin/sh\necho $3 > '" << bin.string()
                                 << "/seconds'\nshift 3\nexec /usr/bin/timeout 1 \"$@\"\n";
  for (const char* const name : {"gnuplot", "timeout"})
    fs::permissions(bin / name, fs::perms::owner_all);
  const Outcome outcome = shell("PATH='" + bin.string() + "':$PATH $rollwave " + scene);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("scene.svg was not drawn"), std::string::npos) << outcome.text;
  EXPECT_FALSE(has("scene.svg"));
  double seconds = 0;
  std::ifstream(bin / "seconds") >> seconds;
  EXPECT_GT(seconds, 50);
  EXPECT_LE(seconds, 60);
  std::ostringstream earlier;
  earlier << std::ifstream(bin / "earlier.json").rdbuf();
  EXPECT_EQ(earlier.str(), read("summary.json"));
}

} // namespace
