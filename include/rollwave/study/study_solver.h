#pragma once

#include "rollwave/exact/exact_solution.h"
#include "rollwave/run/simulation.h"
#include "rollwave/study/study_record.h"

#include <mpi.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rollwave {

/// Solves the runs of a study one after the other on the same processes. Runs on one mesh share it,
/// and its factors at one speed, unless true errors are asked for: then each is timed in full.
class StudySolver {
public:
  /// @param study its parameters, whose files of each run go to directories in @p directory
  /// @param progress of each run
  StudySolver(const std::vector<RunPlan>& plans, const Parameters& study,
              const std::filesystem::path& directory, const Progress& progress,
              MPI_Comm communicator);

  /// Solves the run of this number, from 0 on; if that fails the reason is in the outcome.
  /// @throws Interrupted even if there is a partial result; NotWritten
  StudyRun solve(unsigned int number);

private:
  using Settings = std::map<std::string, std::string>;

  void solve(const RunPlan& plan, StudyRun& run);
  Parameters parameters_of_files(const RunPlan& plan, const std::string& files) const;
  Solution solve_timed(const RunPlan& plan);
  Solution solve_on_shared_mesh(const RunPlan& plan, StudyRun& run);
  const std::optional<ExactSolution>& exact_solution(const RunPlan& plan, const Scene& scene);
  std::optional<double> exact_distance(const RunPlan& plan, const Scene& scene);

  const std::vector<RunPlan>& plans;
  const Parameters& study;
  const std::filesystem::path directory;
  const Progress progress;
  const MPI_Comm communicator;
  std::map<Settings, std::pair<double, double>> widest_zone; ///< where several runs share a mesh
  std::optional<Settings> last_mesh; ///< that of solution, where it is shared
  std::optional<Solution> solution;
  /// By the settings of the scene and the distance, which depends on the mesh if a load is given.
  std::map<std::pair<Settings, double>, std::optional<ExactSolution>> exact_solutions;
  std::map<Settings, std::optional<double>> exact_distances; ///< by the settings of the scene
};

} // namespace rollwave
