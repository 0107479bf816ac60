#include "rollwave/run/attempt.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/text.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <exception>
#include <new>
#include <sstream>

namespace rollwave {

std::string reason_of(const std::exception& failure) {
  if (const auto* const shortage = dynamic_cast<const NotEnoughMemory*>(&failure))
    return shortage->reason;
  if (dynamic_cast<const std::bad_alloc*>(&failure) ||
      dynamic_cast<const dealii::ExcOutOfMemory*>(&failure))
    return NotEnoughMemory().reason;
  const auto* const of_library = dynamic_cast<const dealii::ExceptionBase*>(&failure);
  if (!of_library)
    return failure.what();
  std::ostringstream info;
  of_library->print_info(info);
  std::string reason = of_library->get_exc_name() + (": " + trimmed(info.str()));
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  return reason;
}

void attempt(const std::function<void()>& compute, const std::string& missing,
             const std::string& advice, MPI_Comm communicator, std::vector<Note>& notes) {
  try {
    compute();
  } catch (const std::exception& failure) {
    if (!is_serial(communicator) && !dynamic_cast<const NotSolved*>(&failure))
      throw;
    notes.push_back({Note::Kind::shortfall, missing + ": " + reason_of(failure) + "; " + advice});
  }
}

} // namespace rollwave
