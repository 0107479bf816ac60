#include "rollwave/base/memory.h"

#include "rollwave/base/control_group.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"

#include <deal.II/base/utilities.h>

#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace rollwave {

namespace {

constexpr double mebibyte = 1024. * 1024;

} // namespace

double available_memory() {
  double available = memory_of_control_groups();
  std::ifstream meminfo("/proc/meminfo");
  std::string name, unit;
  double kibibytes = 0;
  while (meminfo >> name >> kibibytes && std::getline(meminfo, unit))
    if (name == "MemAvailable:")
      available = std::min(available, 1024 * kibibytes);
  return available;
}

void require_memory(double bytes, const std::string& purpose, MPI_Comm communicator) {
  const double on_machine = sum_on_machine(communicator, bytes), of_machine = available_memory();
  std::string lack;
  if (on_machine > of_machine) {
    std::ostringstream message;
    message.precision(3);
    message << purpose << " needs " << on_machine / mebibyte << " MiB of memory, and "
            << of_machine / mebibyte << " MiB are available";
    lack = message.str();
  }
  lack = first_text(communicator, lack);
  if (!lack.empty())
    throw NotEnoughMemory(lack);
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
