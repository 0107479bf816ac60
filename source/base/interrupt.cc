#include "rollwave/base/interrupt.h"

#include <deal.II/base/mpi.h>

#include <csignal>
#include <map>
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
                                       "current mesh or run, or at once on the same signal\n";
  if (does_report) [[maybe_unused]]
    const auto written = write(STDERR_FILENO, message.data(), message.size());
}

/// True if the parent ignores a signal, as after trap '' INT in a shell; asked before the program
/// or a library sets it.
bool is_ignored_by_parent(int signal) {
  static std::map<int, bool> is_ignored;
  struct sigaction now = {};
  if (is_ignored.count(signal) == 0 && sigaction(signal, nullptr, &now) == 0)
    is_ignored[signal] = now.sa_handler == SIG_IGN;
  return is_ignored[signal];
}

} // namespace

void install_signal_handlers(bool reports) {
  does_report = reports;
  struct sigaction action = {};
  action.sa_flags = SA_RESTART | SA_RESETHAND; // reading and writing go on
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGUSR2}) {
    action.sa_handler = is_ignored_by_parent(signal) ? SIG_IGN : set_interrupt_flag;
    sigaction(signal, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

bool is_interrupted(MPI_Comm communicator) {
  return dealii::Utilities::MPI::max(int(is_flag_set), communicator) != 0;
}

} // namespace rollwave
