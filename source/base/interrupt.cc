#include "rollwave/base/interrupt.h"

#include <deal.II/base/mpi.h>

#include <csignal>
#include <string_view>
#include <unistd.h>

namespace rollwave {

namespace {

// Global, since a signal handler reaches no other variable.
volatile std::sig_atomic_t is_flag_set = 0;
volatile std::sig_atomic_t does_report = 0;

extern "C" void set_interrupt_flag(int) {
  is_flag_set = 1;
  constexpr std::string_view message = "\nrollwave: interrupted; the program ends after the "
                                       "current mesh, or at once on the same signal\n";
  if (does_report) [[maybe_unused]]
    const auto written = write(STDERR_FILENO, message.data(), message.size());
}

} // namespace

void install_signal_handlers(bool reports) {
  does_report = reports;
  struct sigaction action = {};
  action.sa_handler = set_interrupt_flag;
  action.sa_flags = SA_RESTART | SA_RESETHAND; // reading and writing go on
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGUSR2})
    sigaction(signal, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

bool is_interrupted(MPI_Comm communicator) {
  return dealii::Utilities::MPI::max(int(is_flag_set), communicator) != 0;
}

} // namespace rollwave
