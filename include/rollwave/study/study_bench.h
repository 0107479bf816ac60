#ifndef ROLLWAVE_STUDY_STUDY_BENCH_H
#define ROLLWAVE_STUDY_STUDY_BENCH_H

#include "rollwave/study/study_plan.h"
#include "rollwave/study/study_record.h"

#include <mpi.h>

#include <memory>
#include <vector>

namespace rollwave {

/// Makes the runs of a study one after the other on the same processes. They share meshes,
/// factorisations and exact solutions, where they can.
class StudyBench {
public:
  /// @param plans all runs of the study. Where the zone of contact is left to the program, those
  /// that share a mesh share the widest zone, in which the roads of the others cannot be touched
  /// either.
  StudyBench(const std::vector<RunPlan>& plans, MPI_Comm communicator);
  ~StudyBench();

  /// A run, with the reason where it cannot be solved.
  /// @throws Interrupted also when there is a result that lacks something.
  StudyRun make(const RunPlan& plan);

private:
  struct Shared;
  std::unique_ptr<Shared> shared;
};

} // namespace rollwave

#endif
