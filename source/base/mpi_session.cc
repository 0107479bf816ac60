#include "rollwave/base/mpi_session.h"

#include <mpi.h>

namespace rollwave {

namespace {

struct StartedMpi {
  StartedMpi() {
    int is_running = 0;
    MPI_Initialized(&is_running);
    if (is_running)
      return;
    is_own = true;
    MPI_Init(nullptr, nullptr);
  }
  ~StartedMpi() {
    if (is_own)
      MPI_Finalize();
  }
  bool is_own = false;
};

} // namespace

MpiSession::MpiSession() {
  // MPI starts and ends once in a process, so that no solver can own it. It is not deal.II's
  // MPI_InitFinalize, which must end within main(): it empties pools that are gone by then.
  static const StartedMpi until_exit;
}

} // namespace rollwave
