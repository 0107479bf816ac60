#include "atomic_file.h"

#include "errors.h"

#include <cerrno>
#include <cstring>

namespace rollwave {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw NotWritten(path.string() + " could not be written" +
                   (error ? std::string(": ") + std::strerror(error) : std::string()));
}

} // namespace

AtomicFile::AtomicFile(const std::filesystem::path& path) : path(path), part(path) {
  part += ".part";
  errno = 0;
  out.open(part, std::ios::binary);
  if (!out)
    fail(path, errno);
}

AtomicFile::~AtomicFile() {
  out.close();
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
}

unsigned long AtomicFile::commit() {
  errno = 0;
  out.close();
  if (!out)
    fail(path, errno);
  std::error_code error;
  const auto size = std::filesystem::file_size(part, error);
  if (!error)
    std::filesystem::rename(part, path, error);
  if (error)
    fail(path, error.value());
  return size;
}

unsigned long write_file(const std::filesystem::path& path, const std::string& content) {
  AtomicFile file(path);
  file.stream() << content;
  return file.commit();
}

} // namespace rollwave
