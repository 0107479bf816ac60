#include "rollwave/base/atomic_file.h"

#include "rollwave/base/errors.h"

#include <cerrno>
#include <cstring>
#include <random>
#include <sstream>

namespace rollwave {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, int error) {
  throw NotWritten(path.string() + " could not be written" +
                   (error ? std::string(": ") + std::strerror(error) : std::string()));
}

/// Closes a stream. Returns 0, or the number of the error that has befallen it.
int close_stream(std::ofstream& out) {
  errno = 0;
  const bool has_failed = !out;
  if (has_failed)
    out.rdbuf()->sputc('\n'); // fails again, which sets the number
  out.close();
  return has_failed || !out ? (errno ? errno : EIO) : 0;
}

} // namespace

AtomicFile::AtomicFile(const fs::path& path) : path(path), temporary(path) {
  temporary += "." + std::to_string(std::random_device()()) + ".part";
  // A directory that is removed during a long computation does not cost the result.
  std::error_code ignored;
  fs::create_directories(path.parent_path(), ignored);
  errno = 0;
  out.open(temporary, std::ios::binary);
  if (!out)
    fail(path, errno);
}

AtomicFile::~AtomicFile() {
  out.close();
  std::error_code ignored;
  fs::remove(temporary, ignored);
}

unsigned long AtomicFile::commit() {
  if (const int error = close_stream(out))
    fail(path, error);
  std::error_code error;
  const auto size = fs::file_size(temporary, error);
  if (!error)
    fs::rename(temporary, path, error);
  if (error)
    fail(path, error.value());
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

void append_to_file(const fs::path& path, const std::string& text) {
  std::error_code ignored;
  const auto size = fs::file_size(path, ignored);
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::app);
  if (!out)
    fail(path, errno);
  out << text;
  if (const int error = close_stream(out)) {
    fs::resize_file(path, size, ignored);
    fail(path, error);
  }
}

} // namespace rollwave
