#ifndef ROLLWAVE_BASE_INTERRUPT_H
#define ROLLWAVE_BASE_INTERRUPT_H

#include <csignal>
#include <mpi.h>

namespace rollwave {

/// Notes SIGINT (Ctrl-C) and SIGTERM from here on: the first is told on the standard error and
/// shows in is_interrupted(), the second ends the program at once. A signal that is ignored, as
/// scripts do in the background, stays ignored.
void heed_interrupts();

/// Lets this process note interrupts without telling them, since another one speaks.
void note_interrupts_silently();

/// What SIGINT and SIGTERM do when it is made they do again when it goes, whatever libraries change
/// in between: PETSc, which deal.II starts with MPI, lets them end the program.
class KeptInterrupts {
public:
  KeptInterrupts();
  ~KeptInterrupts();
  KeptInterrupts(const KeptInterrupts&) = delete;
  KeptInterrupts& operator=(const KeptInterrupts&) = delete;

private:
  struct sigaction kept[2];
};

/// Whether any of the processes, all of which must ask, has been told to end. Who repeats steps
/// looks between them, and ends with the best there is: no more steps of Uzawa, no finer mesh, no
/// further run of a study.
bool is_interrupted(MPI_Comm communicator);

} // namespace rollwave

#endif
