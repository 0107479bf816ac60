#include "rollwave/base/interrupt.h"

#include <deal.II/base/mpi.h>

#include <csignal>
#include <set>
#include <string_view>
#include <unistd.h>

namespace rollwave {

namespace {

/// A signal handler can reach nothing but what is global.
volatile std::sig_atomic_t noted = 0;
volatile std::sig_atomic_t is_told = 0;

extern "C" void note_interrupt(int signal) {
  const bool was_noted = noted, is_impatient = signal == SIGINT || signal == SIGTERM;
  noted = 1;
  if (is_impatient) { // before the message, on which the user may send the next one
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
  }
  constexpr std::string_view message =
      "\nrollwave: interrupted, ends after the step at hand; Ctrl-C or SIGTERM once more ends it "
      "at once\n";
  // SIGXCPU comes every second from then on.
  if (is_told && (is_impatient || !was_noted)) [[maybe_unused]]
    const auto written = write(STDERR_FILENO, message.data(), message.size());
}

std::set<int> find_heeded_signals() {
  std::set<int> heeded;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU}) {
    struct sigaction action = {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN)
      heeded.insert(signal);
  }
  return heeded;
}

} // namespace

void heed_interrupts(bool tells) {
  is_told = tells;
  static const std::set<int> heeded = find_heeded_signals();
  for (const int signal : heeded) {
    struct sigaction action = {};
    action.sa_handler = note_interrupt;
    action.sa_flags = SA_RESTART; // reading and writing go on
    sigaction(signal, &action, nullptr);
  }
}

bool is_interrupted(MPI_Comm communicator) {
  return dealii::Utilities::MPI::max(int(noted), communicator) != 0;
}

} // namespace rollwave
