// Where the time and the memory of a run go: what its start and its certificate cost; for meshes
// from 1e3 to 4e6 unknowns, the seconds of each phase, the peak memory, and how both grow; and the
// seconds that an adaptive run from scratch needs for a wanted error of both the force F and the
// energy J. Each run has a process of its own, so that peaks of memory are its own.
#include "rollwave/base/memory.h"
#include "rollwave/output/vtu.h"
#include "test_scenes.h"

#include <deal.II/base/timer.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <numeric>

using namespace rollwave;

namespace {

constexpr int n_numbers = 16;
using Numbers = std::array<double, n_numbers>;

/// What @p work returns, from a process of its own.
Numbers in_own_process(const std::function<Numbers()>& work) {
  int ends[2];
  if (pipe(ends) != 0)
    std::abort();
  Numbers numbers = {};
  std::fflush(stdout); // which the child would print again
  if (const pid_t child = fork(); child == 0) {
    numbers = work();
    const bool is_sent = write(ends[1], numbers.data(), sizeof numbers) == sizeof numbers;
    _exit(is_sent ? 0 : 1);
  } else {
    close(ends[1]);
    if (read(ends[0], numbers.data(), sizeof numbers) != sizeof numbers)
      std::fprintf(stderr, "a run has failed\n");
    close(ends[0]);
    waitpid(child, nullptr, 0);
  }
  return numbers;
}

const std::vector<std::string> phases = {
    "mesh",          "space",      "assembly",          "ordering",
    "factorisation", "contact",    "back-substitution", "measurement",
    "indicator",     "certificate"};

/// Unknowns, the seconds of each phase and of the output, their sum, peak memory in MiB.
Numbers run(const Parameters& parameters) {
  const Scene scene = make_scene(parameters);
  const Solution solution = simulate(scene, parameters);
  Numbers numbers = {};
  numbers[0] = solution.result.mesh.dofs;
  for (const auto& [phase, seconds] : solution.result.work.seconds())
    numbers[1 + (std::find(phases.begin(), phases.end(), phase) - phases.begin())] += seconds;
  const dealii::Timer timer;
  std::ofstream out("/dev/null");
  write_solution_vtu(out, solution, scene.unit);
  numbers[1 + phases.size()] = timer.wall_time();
  numbers[2 + phases.size()] =
      std::accumulate(numbers.begin() + 1, numbers.begin() + 2 + phases.size(), 0.);
  numbers[3 + phases.size()] = peak_memory_mib();
  return numbers;
}

Numbers print_run(const PaperScene& paper, const char* mesh,
                  const std::vector<std::string>& settings) {
  const Parameters parameters = with(paper.parameters(), settings);
  const Numbers numbers = in_own_process([&] { return run(parameters); });
  std::printf("| %d | %u | %s | %.0f |", paper.figure, parameters.mesh.degree, mesh, numbers[0]);
  for (unsigned int i = 1; i < 3 + phases.size(); ++i)
    std::printf(" %.3g |", numbers[i]);
  const double memory = numbers[3 + phases.size()];
  std::printf(" %.3g | %.0f | %.2f |\n", 1e6 * numbers[2 + phases.size()] / numbers[0], memory,
              1024 * memory / numbers[0]);
  std::fflush(stdout);
  return numbers;
}

/// x in y ~ unknowns^x, by least squares.
double exponent(const std::vector<Numbers>& runs, unsigned int column) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const Numbers& numbers : runs) {
    const double x = std::log(numbers[0]), y = std::log(numbers[column]);
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

void benchmark_phases() {
  std::printf("\nSeconds of each phase, microseconds per unknown, peak memory in MiB and KiB per "
              "unknown.\n\n| figure | degree | mesh | unknowns |");
  for (const auto& phase : phases)
    std::printf(" %s |", phase.c_str());
  std::printf(" output | total | us | MiB | KiB |\n|---|---|---|---|");
  for (unsigned int i = 0; i < phases.size() + 5; ++i)
    std::printf("---|");
  std::printf("\n");
  std::vector<std::string> growth;
  for (const int figure : {0, 1})
    for (const int degree : {1, 2}) {
      const PaperScene& paper = paper_scenes()[figure];
      std::vector<Numbers> runs;
      const auto run_uniform = [&](int radial, int angular) {
        return print_run(paper, "uniform",
                         {"Mesh/Degree=" + std::to_string(degree),
                          "Mesh/Radial cells=" + std::to_string(radial / degree),
                          "Mesh/Angular cells=" + std::to_string(angular / degree),
                          "Mesh/Most unknowns=5000000"});
      };
      for (const auto& [radial, angular] : {std::pair(10, 110), {28, 352}, {88, 1112}, {282, 3544}})
        runs.push_back(run_uniform(radial, angular));
      if (figure == 0) // which takes half a minute
        run_uniform(564, 7088);
      print_run(paper, "adaptive",
                {"Mesh/Degree=" + std::to_string(degree), "Mesh/Radial cells=3",
                 "Mesh/Angular cells=38", "Mesh/Adaptive cycles=1000",
                 "Mesh/Most unknowns=100000"});
      runs.erase(runs.begin());
      char line[100];
      std::snprintf(line, sizeof line, "| %d | %d | %.2f | %.2f |", paper.figure, degree,
                    exponent(runs, 2 + phases.size()), exponent(runs, 3 + phases.size()));
      growth.push_back(line);
    }
  std::printf("\nGrowth from 1e4 to 1e6 unknowns, exponents of the unknowns\n\n| figure | degree | "
              "time | memory |\n|---|---|---|---|\n");
  for (const auto& line : growth)
    std::printf("%s\n", line.c_str());
}

/// Numbers; smooth, with a jump on a circle, around a spot, along a curve.
const char* const forces[] = {"0",
                              "1",
                              "1+0.5*r*cos(z)",
                              "if(r<0.7123,1,0)",
                              "if((r-0.7)^2+(z-3)^2<0.01,1,0)",
                              "if(r<0.7+0.1*sin(3*z),1,0)"};

void print_forces_header(const char* columns) {
  std::printf("\n\n%s", columns);
  for (const char* force : forces)
    std::printf(" `%s` |", force);
  std::printf("\n|---|---|");
  for (unsigned int i = 0; i < std::size(forces); ++i)
    std::printf("---|");
  std::printf("\n");
}

/// What the certificate adds to the seconds from the degrees of freedom on, over those without it:
/// part of it is done in threads beside the solution.
void benchmark_certificate() {
  std::printf("\nWhat the certificate adds over the solve where each run has a process of its own, "
              "medians of 9");
  print_forces_header("| degree | unknowns |");
  for (const int degree : {1, 2})
    for (const auto& [radial, angular] : {std::pair(8, 112), {28, 352}, {88, 1112}}) {
      double unknowns = 0;
      std::string ratios;
      for (const char* force : forces) {
        const Parameters certified = with(paper_scenes()[0].parameters(),
                                          {"Mesh/Degree=" + std::to_string(degree),
                                           "Mesh/Radial cells=" + std::to_string(radial / degree),
                                           "Mesh/Angular cells=" + std::to_string(angular / degree),
                                           std::string("Cylinder/Radial force=") + force});
        const Parameters plain = with(certified, {"Certificate/Error bound=false"});
        const auto seconds_of = [&unknowns](const Parameters& parameters) {
          const Numbers numbers = in_own_process([&] { return run(parameters); });
          unknowns = numbers[0];
          const auto after_mesh = numbers.begin() + 2;
          return std::accumulate(after_mesh, after_mesh + phases.size() - 1, 0.);
        };
        std::array<double, 9> sorted;
        for (double& ratio : sorted) {
          const double without = seconds_of(plain);
          ratio = seconds_of(certified) / without - 1;
        }
        std::sort(sorted.begin(), sorted.end());
        char text[20];
        std::snprintf(text, sizeof text, " %.2f |", sorted[4]);
        ratios += text;
      }
      std::printf("| %d | %.0f |%s\n", degree, unknowns, ratios.c_str());
      std::fflush(stdout);
    }
}

/// The seconds of the phase `certificate` over those from the degrees of freedom to the
/// displacement, where each mesh of an adaptive run is certified.
void benchmark_certified_refinement() {
  std::printf("\nCertificates over solves of adaptive runs that certify each mesh, medians of 5");
  print_forces_header("| degree | most unknowns |");
  for (const int degree : {1, 2})
    for (const char* most_unknowns : {"10000", "150000", "390000"}) {
      std::printf("| %d | %s |", degree, most_unknowns);
      for (const char* force : forces) {
        const Parameters parameters =
            with(paper_scenes()[0].parameters(),
                 {"Mesh/Degree=" + std::to_string(degree), "Mesh/Radial cells=4",
                  "Mesh/Angular cells=48", "Mesh/Wanted relative error=1e-9",
                  std::string("Mesh/Most unknowns=") + most_unknowns,
                  std::string("Cylinder/Radial force=") + force});
        std::array<double, 5> sorted;
        for (double& ratio : sorted) {
          const Numbers numbers = in_own_process([&] { return run(parameters); });
          const auto of = [&numbers](const char* phase) {
            return numbers.begin() + 1 +
                   (std::find(phases.begin(), phases.end(), phase) - phases.begin());
          };
          ratio = *of("certificate") / std::accumulate(of("space"), of("measurement"), 0.);
        }
        std::sort(sorted.begin(), sorted.end());
        std::printf(" %.2f |", sorted[2]);
        std::fflush(stdout);
      }
      std::printf("\n");
    }
}

/// Unknowns, cycles, seconds, relative errors of F and J.
Numbers run_for_error(const PaperScene& paper, double most_unknowns) {
  const Parameters parameters = with(
      paper.parameters(), {"Mesh/Degree=2", "Mesh/Radial cells=3", "Mesh/Angular cells=38",
                           "Mesh/Adaptive cycles=1000", "Certificate/Error bound=false",
                           "Mesh/Most unknowns=" + std::to_string(std::llround(most_unknowns))});
  const Scene scene = make_scene(parameters);
  const dealii::Timer timer;
  const Result result = simulate(scene, parameters).result;
  const double seconds = timer.wall_time();
  return {{double(result.mesh.dofs), double(result.cycles.size()), seconds,
           std::abs(result.patch.force / paper.force - 1),
           std::abs(result.energy.value / paper.energy - 1)}};
}

/// From the smallest mesh on from which both errors stay below what is wanted.
void benchmark_time_to_error() {
  std::printf(
      "\nAdaptive quadratic elements from scratch, without certificate, until the relative "
      "errors of F and J stay below the one wanted\n\n| figure | wanted | unknowns | meshes "
      "| seconds | error of F | error of J |\n|---|---|---|---|---|---|---|\n");
  for (const int figure : {0, 1}) {
    const PaperScene& paper = paper_scenes()[figure];
    std::vector<Numbers> runs;
    for (double unknowns = 600; unknowns < 4e5; unknowns *= 1.25)
      runs.push_back(in_own_process([&] { return run_for_error(paper, unknowns); }));
    for (const double wanted : {1e-4, 1e-6, 1e-8}) {
      const auto last_bad = std::find_if(runs.rbegin(), runs.rend(), [&](const Numbers& numbers) {
        return numbers[3] > wanted || numbers[4] > wanted;
      });
      if (last_bad == runs.rbegin()) {
        std::printf("| %d | %.0e | - | | | | |\n", paper.figure, wanted);
        continue;
      }
      const Numbers& first = *last_bad.base();
      std::printf("| %d | %.0e | %.0f | %.0f | %.3f | %.1e | %.1e |\n", paper.figure, wanted,
                  first[0], first[1], first[2], first[3], first[4]);
    }
    std::fflush(stdout);
  }
}

/// Whole processes, in turn with an empty one.
void benchmark_start() {
  const std::string scene =
      ROLLWAVE_EXECUTABLE " " ROLLWAVE_PRM_DIRECTORY "/figure-4.prm --output /tmp/rollwave-start "
                          "--set 'Mesh/Radial cells=1' "
                          "--set 'Mesh/Angular cells=6' --set Output/Files=";
  const std::vector<std::pair<const char*, std::string>> commands = {
      {"empty", EMPTY_EXECUTABLE},
      {"summary, contact, parameters", scene + "'summary, contact, parameters'"},
      {"all files of the default", scene + "'summary, contact, parameters, solution, plot'"}};
  std::vector<std::vector<double>> seconds(commands.size());
  for (int run = 0; run < 15; ++run)
    for (unsigned int i = 0; i < commands.size(); ++i) {
      const dealii::Timer timer;
      if (std::system((commands[i].second + " > /dev/null").c_str()) != 0)
        std::abort();
      seconds[i].push_back(timer.wall_time());
    }
  std::printf("\nThe smallest scene as a whole process, medians of 15 runs\n\n| files | seconds | "
              "over an empty program |\n|---|---|---|\n");
  for (unsigned int i = 0; i < commands.size(); ++i) {
    std::sort(seconds[i].begin(), seconds[i].end());
    std::printf("| %s | %.3f | %.2f |\n", commands[i].first, seconds[i][7],
                seconds[i][7] / seconds[0][7]);
  }
}

} // namespace

int main() {
  benchmark_start();
  benchmark_certificate();
  benchmark_certified_refinement();
  benchmark_phases();
  benchmark_time_to_error();
}
