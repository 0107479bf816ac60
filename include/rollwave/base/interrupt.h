#ifndef ROLLWAVE_BASE_INTERRUPT_H
#define ROLLWAVE_BASE_INTERRUPT_H

#include <mpi.h>

namespace rollwave {

/// Notes from here on SIGINT (Ctrl-C), SIGTERM, and what batch systems send some time before the
/// end: SIGUSR1, SIGUSR2, SIGXCPU, SIGHUP. The second SIGINT or SIGTERM ends the program at once. A
/// signal that is ignored at the first call, as by nohup, stays ignored.
/// @param tells whether this process says so on the standard error
void heed_interrupts(bool tells = true);

/// Whether any of the processes, all of which must ask, has been told to end. Who repeats steps
/// looks between them, and ends with the best there is: no more steps of Uzawa, no finer mesh, no
/// further run of a study.
bool is_interrupted(MPI_Comm communicator);

} // namespace rollwave

#endif
