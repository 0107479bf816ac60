#pragma once

#include "rollwave/exact/exact_solution.h"
#include "rollwave/run/simulation.h"
#include "rollwave/study/study.h"

#include <mpi.h>

#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace rollwave {

/// Solves the runs of a study one after the other on the same processes. Runs on one mesh share it,
/// and its factors at one speed, unless true errors are asked for: then each is timed in full.
class StudySolver {
public:
  /// @param study its parameters
  /// @param progress of each run
  StudySolver(const std::vector<RunPlan>& plans, const Parameters& study, const Progress& progress,
              MPI_Comm communicator);

  /// Solves the run of this number, from 0 on, and writes its @p files; if that fails the reason is
  /// in the record. The sizes of files are known to rank 0.
  /// @throws Interrupted even if there is a partial result; NotWritten
  RunRecord record_of(unsigned int number, const OwnFiles& files);

private:
  void solve(unsigned int number, RunRecord& run);
  void write_files(const RunPlan& plan, RunRecord& run);
  Solution solve_timed(const RunOptions& options);
  Solution solve_shared(unsigned int number, RunRecord& run);
  std::pair<double, double> widest_zone(unsigned int number) const;
  bool share_system(unsigned int earlier, unsigned int number) const;

  const std::vector<RunPlan>& plans;
  const Parameters& study;
  const Progress progress;
  const MPI_Comm communicator;
  std::optional<Solution> solution;  ///< of the last run
  std::optional<MeshObjects> shared; ///< on its mesh
  std::optional<unsigned int> last;  ///< the number of the run that has left both

  /// The scene of a run, with the distance, which depends on the mesh if a load is given.
  using SceneKey = std::tuple<CylinderOptions, RoadOptions, MaterialOptions, double>;
  std::vector<std::pair<SceneKey, std::optional<ExactSolution>>> exact_solutions;
  std::vector<std::pair<SceneKey, std::optional<double>>> exact_distances;
};

} // namespace rollwave
