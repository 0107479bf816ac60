#include "rollwave/base/interrupt.h"

#include <deal.II/base/mpi.h>

#include <csignal>
#include <iterator>
#include <string_view>
#include <unistd.h>

namespace rollwave {

namespace {

/// A signal handler can reach nothing but what is global.
volatile std::sig_atomic_t noted = 0;
volatile std::sig_atomic_t is_silent = 0;

constexpr int interrupts[] = {SIGINT, SIGTERM};

extern "C" void note_interrupt(int) {
  noted = 1;
  for (const int signal : interrupts)
    std::signal(signal, SIG_DFL);
  if (is_silent)
    return;
  constexpr std::string_view message =
      "\nrollwave: interrupted, ends after the step at hand; once more ends it at once\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message.data(), message.size());
}

} // namespace

void heed_interrupts() {
  for (const int signal : interrupts) {
    struct sigaction action = {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_IGN)
      continue;
    action = {};
    action.sa_handler = note_interrupt;
    action.sa_flags = SA_RESTART; // reading and writing go on
    sigaction(signal, &action, nullptr);
  }
}

void note_interrupts_silently() {
  is_silent = 1;
}

KeptInterrupts::KeptInterrupts() {
  for (unsigned int i = 0; i < std::size(interrupts); ++i)
    sigaction(interrupts[i], nullptr, &kept[i]);
}

KeptInterrupts::~KeptInterrupts() {
  for (unsigned int i = 0; i < std::size(interrupts); ++i)
    sigaction(interrupts[i], &kept[i], nullptr);
}

bool is_interrupted(MPI_Comm communicator) {
  return dealii::Utilities::MPI::max(int(noted), communicator) != 0;
}

} // namespace rollwave
