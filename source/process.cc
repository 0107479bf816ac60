#include "process.h"

#include "interrupt.h"
#include "memory.h"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <string_view>
#include <thread>
#include <unistd.h>
#include <utility>

namespace rollwave {

namespace {

void open_standard_streams() {
  // What cannot be read from or written to stays so.
  for (const auto& [stream, mode] :
       {std::pair(STDIN_FILENO, O_WRONLY), std::pair(STDOUT_FILENO, O_RDONLY),
        std::pair(STDERR_FILENO, O_RDONLY)})
    if (fcntl(stream, F_GETFD) < 0)
      open("/dev/null", mode);
}

/// OpenBLAS gives each of its threads a buffer when the program is loaded, and waits for ever for
/// memory that it does not get.
void limit_blas_threads(char* arguments[]) {
  constexpr double for_the_program = 1024. * 1024 * 1024;
  const char* const variable = "OPENBLAS_NUM_THREADS";
  const char* const threads = std::getenv(variable);
  const auto room = memory_below_limit();
  if (!room || (threads && std::string_view(threads) == "1") ||
      *room > for_the_program + blas_buffer_bytes * std::thread::hardware_concurrency())
    return;
  setenv(variable, "1", 1);
  execv("/proc/self/exe", arguments);
}

} // namespace

void settle_process(char* arguments[]) {
  open_standard_streams();
  limit_blas_threads(arguments);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  heed_interrupts();
}

} // namespace rollwave
