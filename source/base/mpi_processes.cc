#include "rollwave/base/mpi_processes.h"

#include "rollwave/base/errors.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <new>

namespace rollwave {

using namespace dealii;

unsigned int count_processes(MPI_Comm communicator) {
  return Utilities::MPI::job_supports_mpi() ? Utilities::MPI::n_mpi_processes(communicator) : 1;
}

bool is_serial(MPI_Comm communicator) {
  return count_processes(communicator) == 1;
}

unsigned int process_number(MPI_Comm communicator) {
  return is_serial(communicator) ? 0 : Utilities::MPI::this_mpi_process(communicator);
}

bool holds_on_all(MPI_Comm communicator, bool statement) {
  return is_serial(communicator) ? statement
                                 : Utilities::MPI::min(int(statement), communicator) == 1;
}

std::string broadcast(MPI_Comm communicator, const std::string& text) {
  return Utilities::MPI::all_gather(communicator, text).front();
}

std::string first_text(MPI_Comm communicator, const std::string& text) {
  for (const std::string& of_one : Utilities::MPI::all_gather(communicator, text))
    if (!of_one.empty())
      return of_one;
  return {};
}

void do_on_all(MPI_Comm communicator, const std::function<void()>& work) {
  std::string shortage, failure, unwritten;
  try {
    work();
  } catch (const NotEnoughMemory& error) {
    shortage = error.reason;
  } catch (const NotSolved& error) {
    failure = error.what();
  } catch (const NotWritten& error) {
    unwritten = error.what();
  } catch (const std::bad_alloc&) {
    shortage = NotEnoughMemory().reason;
  } catch (const ExcOutOfMemory&) { // by the vectors of deal.II
    shortage = NotEnoughMemory().reason;
  }
  if (holds_on_all(communicator, shortage.empty() && failure.empty() && unwritten.empty()))
    return;
  if (unwritten = first_text(communicator, unwritten); !unwritten.empty())
    throw NotWritten(unwritten);
  if (shortage = first_text(communicator, shortage); !shortage.empty())
    throw NotEnoughMemory(shortage);
  throw NotSolved(first_text(communicator, failure));
}

} // namespace rollwave
