#include "rollwave/base/interrupt.h"

#include <deal.II/base/mpi.h>

#include <csignal>
#include <set>
#include <string_view>
#include <unistd.h>

namespace rollwave {

namespace {

// Global, since a signal handler reaches no other variable.
volatile std::sig_atomic_t is_flag_set = 0;
volatile std::sig_atomic_t does_report = 0;

extern "C" void set_interrupt_flag(int signal) {
  const bool is_repeated = is_flag_set && signal != SIGINT && signal != SIGTERM;
  is_flag_set = 1;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  constexpr std::string_view message = "\nrollwave: interrupted, ends after the current mesh; "
                                       "Ctrl-C or SIGTERM once more ends it at once\n";
  // SIGXCPU comes every second.
  if (does_report && !is_repeated) [[maybe_unused]]
    const auto written = write(STDERR_FILENO, message.data(), message.size());
}

std::set<int> find_signals_not_ignored() {
  std::set<int> signals;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU}) {
    struct sigaction action = {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN)
      signals.insert(signal);
  }
  return signals;
}

} // namespace

void install_signal_handlers(bool reports) {
  does_report = reports;
  static const std::set<int> signals = find_signals_not_ignored();
  for (const int signal : signals) {
    struct sigaction action = {};
    action.sa_handler = set_interrupt_flag;
    action.sa_flags = SA_RESTART; // reading and writing go on
    sigaction(signal, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

bool is_interrupted(MPI_Comm communicator) {
  return dealii::Utilities::MPI::max(int(is_flag_set), communicator) != 0;
}

} // namespace rollwave
