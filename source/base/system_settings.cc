#include "rollwave/base/system_settings.h"

#include "rollwave/base/interrupt.h"

#include <csignal>
#include <fcntl.h>
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

} // namespace

void settle_process() {
  open_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  heed_interrupts();
}

} // namespace rollwave
