#ifndef ROLLWAVE_BASE_MPI_PROCESSES_H
#define ROLLWAVE_BASE_MPI_PROCESSES_H

#include <mpi.h>

#include <memory>
#include <string>

namespace dealii::Utilities::MPI {
class MPI_InitFinalize;
}

namespace rollwave {

/// The processes that an MPI launcher (mpirun, srun) has started together. MPI is started where
/// there are several, and ends with this object.
class Processes {
public:
  /// @param argv of main()
  explicit Processes(char** argv);
  ~Processes();
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;

  MPI_Comm communicator() const { return mpi ? MPI_COMM_WORLD : MPI_COMM_SELF; }

  /// Whether this is the process that speaks for all.
  bool is_first() const;

  /// Refuses processes that do not know of each other, as those of the launcher of another MPI:
  /// each would do the work of all. @throws BadInput
  void require_company() const;

  /// Waits until the first process is here as well, such as with files that it alone writes.
  void wait_for_first() const;

  /// Waits, on all but the first process, until that should have ended them all: what has failed on
  /// all of them is told once.
  void let_first_speak() const;

  /// Ends the other processes, wherever they are, after a failure of this one; returns @p
  /// exit_code.
  int end(int exit_code) const;

private:
  std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> mpi;
};

/// Proves that MPI runs, which Trilinos' matrices and multigrid need on one process as well: a
/// member of this type goes before them. The first one starts MPI, which then lasts until the
/// program ends.
struct MpiSession {
  MpiSession();
};

/// Whether a communicator is that of one process: then MPI may not even be running.
bool is_alone(MPI_Comm communicator);

unsigned int count_processes(MPI_Comm communicator);

/// The number of this process among those of a communicator, from 0 on.
unsigned int process_number(MPI_Comm communicator);

/// The text that the first process has, on all of them.
std::string share_text(MPI_Comm communicator, const std::string& text);

/// The text of the first process that has one, on all of them; empty when none has.
std::string first_text(MPI_Comm communicator, const std::string& text);

} // namespace rollwave

#endif
