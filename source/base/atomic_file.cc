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

} // namespace rollwave
