#include "rollwave/solver/mumps_factor.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"

#include <dmumps_c.h>

#include <algorithm>
#include <string>
#include <utility>

namespace rollwave {

/// MUMPS's object. Members have the names of its users' guide.
struct MumpsFactor::Mumps {
  DMUMPS_STRUC_C id = {};

  explicit Mumps(MPI_Comm communicator) {
    id.comm_fortran = MPI_Comm_c2f(communicator);
    id.par = 1; // rank 0 works like the others
    id.sym = 1; // positive definite
    call(-1);
    for (const int stream : {1, 2, 3})
      icntl(stream) = -1; // no messages
    icntl(4) = 0;
  }

  ~Mumps() {
    id.schur = nullptr; // it is not MUMPS's
    call(-2);
  }

  Mumps(const Mumps&) = delete;
  Mumps& operator=(const Mumps&) = delete;

  int& icntl(int number) { return id.icntl[number - 1]; }
  int infog(int number) const { return id.infog[number - 1]; }

  /// Returns the status, which is negative for an error and the same on all processes.
  int call(int job) {
    id.job = job;
    dmumps_c(&id);
    return infog(1);
  }

  /// @throws NotEnoughMemory, NotSolved for a negative status
  void check(const std::string& step) const {
    const int status = infog(1);
    for (const int shortage : {-5, -7, -13, -19})
      if (status == shortage)
        throw NotEnoughMemory("the " + step +
                              " of the system matrix needs more memory than there is");
    constexpr int singular = -10, root_is_not_definite = -40;
    // With sym = 1 negative pivots are counted, and no error.
    if (status == singular || status == root_is_not_definite || infog(12) > 0)
      throw NotSolved("the system matrix is not positive definite in floating-point arithmetic "
                      "(" +
                      step + "); use cells that are less stretched");
    if (status < 0)
      throw NotSolved("the " + step + " of the system matrix failed in MUMPS, status " +
                      std::to_string(status) + ", " + std::to_string(infog(2)));
  }
};

MumpsFactor::MumpsFactor(MPI_Comm communicator, int n, LowerTriplets own_entries,
                         std::vector<int> contact_rows)
    : mumps(std::make_unique<Mumps>(communicator)), entries(std::move(own_entries)),
      contact_rows(std::move(contact_rows)) {
  for (std::vector<int>* const numbers : {&entries.rows, &entries.columns, &this->contact_rows})
    for (int& number : *numbers)
      ++number;
  auto& id = mumps->id;
  id.n = n;
  constexpr int distributed_entries = 3, on_one_process = 1, minimum_degree = 0;
  mumps->icntl(18) = distributed_entries;
  id.nnz_loc = entries.values.size();
  id.irn_loc = entries.rows.data();
  id.jcn_loc = entries.columns.data();
  id.a_loc = entries.values.data();
  mumps->icntl(28) = on_one_process; // the analysis
  mumps->icntl(7) = minimum_degree;
  if (const int m = this->contact_rows.size(); m > 0) {
    mumps->icntl(19) = 1; // S by rows on rank 0
    id.size_schur = m;
    id.listvar_schur = this->contact_rows.data();
    if (process_number(communicator) == 0) {
      schur_complement.reinit(m, m);
      id.schur = &schur_complement(0, 0);
    }
  }
  mumps->call(1);
  mumps->check("analysis");
}

MumpsFactor::~MumpsFactor() = default;

double MumpsFactor::needed_memory() const {
  constexpr double megabyte = 1e6;
  return megabyte * mumps->id.info[15 - 1];
}

void MumpsFactor::factorise(int workspace) {
  constexpr int integer_workspace_is_small = -8, real_workspace_is_small = -9;
  for (int status = real_workspace_is_small;
       status == integer_workspace_is_small || status == real_workspace_is_small;
       workspace = std::max(0, 2 * workspace) + 20) {
    mumps->icntl(14) = workspace;
    status = mumps->call(2);
  }
  mumps->check("factorisation");
  entries = {};
}

std::vector<double> MumpsFactor::solve_interior(std::vector<double> rhs) const {
  auto& id = mumps->id;
  id.nrhs = 1;
  id.lrhs = rhs.size();
  id.rhs = rhs.data();
  mumps->call(3);
  mumps->check("solution");
  return rhs;
}

} // namespace rollwave
