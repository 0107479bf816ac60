#include "memory.h"

#include "errors.h"

#include <deal.II/base/utilities.h>

#include <malloc.h>

#include <fstream>
#include <sstream>

namespace rollwave {

void require_memory(double bytes, const std::string& purpose) {
  std::ifstream meminfo("/proc/meminfo");
  std::string name, unit;
  double kibibytes = 0;
  while (meminfo >> name >> kibibytes && std::getline(meminfo, unit))
    if (name == "MemAvailable:" && bytes > 1024 * kibibytes) {
      const double gibibyte = 1024. * 1024 * 1024;
      std::ostringstream message;
      message.precision(3);
      message << purpose << " needs " << bytes / gibibyte << " GiB of memory, and "
              << 1024 * kibibytes / gibibyte << " GiB are available";
      throw NotEnoughMemory(message.str());
    }
}

void release_freed_memory() {
  malloc_trim(0);
}

double peak_memory_mib() {
  dealii::Utilities::System::MemoryStats memory;
  dealii::Utilities::System::get_memory_stats(memory);
  return memory.VmHWM / 1024.;
}

} // namespace rollwave
