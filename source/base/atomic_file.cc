#include "rollwave/base/atomic_file.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <random>
#include <sstream>
#include <vector>

namespace rollwave {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, int error) {
  throw NotWritten(path.string() + " could not be written" +
                   (error ? std::string(": ") + std::strerror(error) : std::string()));
}

} // namespace

AtomicFile::AtomicFile(const fs::path& path) : path(path), temporary(path) {
  static const std::string own = "." + std::to_string(std::random_device()()) + ".part";
  temporary += own;
  out.open(temporary, std::ios::binary);
  if (!out) { // perhaps the directory is not there, or was removed during a long computation
    std::error_code ignored;
    fs::create_directories(path.parent_path(), ignored);
    errno = 0;
    out.open(temporary, std::ios::binary);
  }
  if (!out)
    fail(path, errno);
}

AtomicFile::~AtomicFile() {
  out.close();
  std::error_code ignored;
  if (!is_in_place)
    fs::remove(temporary, ignored);
}

unsigned long AtomicFile::commit() {
  out.close();
  if (!out)
    fail(path, errno);
  std::error_code error;
  const auto size = fs::file_size(temporary, error);
  if (!error)
    fs::rename(temporary, path, error);
  if (error)
    fail(path, error.value());
  is_in_place = true;
  return size;
}

std::string read_file(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

unsigned long write_file(const fs::path& path, const std::string& content) {
  AtomicFile file(path);
  file.stream() << content;
  return file.commit();
}

unsigned long write_file_in_parts(const fs::path& path, const std::string& part,
                                  MPI_Comm communicator) {
  if (is_serial(communicator))
    return write_file(path, part);
  const bool is_first = process_number(communicator) == 0;
  std::optional<AtomicFile> file; // of rank 0
  do_on_all(communicator, [&] {
    if (is_first)
      file.emplace(path);
  });
  constexpr int tag = 64;
  constexpr std::size_t most = 1 << 24; // bytes of a message
  const std::vector<std::size_t> sizes =
      dealii::Utilities::MPI::all_gather(communicator, part.size());
  if (is_first) {
    file->stream() << part;
    std::vector<char> piece(most);
    for (unsigned int rank = 1; rank < sizes.size(); ++rank)
      for (std::size_t begin = 0; begin < sizes[rank]; begin += most) {
        const std::size_t size = std::min(most, sizes[rank] - begin);
        MPI_Recv(piece.data(), size, MPI_CHAR, rank, tag, communicator, MPI_STATUS_IGNORE);
        file->stream().write(piece.data(), size);
      }
  } else
    for (std::size_t begin = 0; begin < part.size(); begin += most)
      MPI_Send(part.data() + begin, std::min(most, part.size() - begin), MPI_CHAR, 0, tag,
               communicator);
  unsigned long size = 0;
  do_on_all(communicator, [&] {
    if (file)
      size = file->commit();
  });
  return size;
}

} // namespace rollwave
