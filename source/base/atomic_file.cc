#include "rollwave/base/atomic_file.h"

#include "rollwave/base/errors.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace rollwave {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw NotWritten(path.string() + " could not be written" +
                   (error ? std::string(": ") + std::strerror(error) : std::string()));
}

/// Waits until a file is on the disk. Returns whether it is.
bool is_on_disk(const std::filesystem::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
    return false;
  const bool is_synchronised = fsync(descriptor) == 0;
  close(descriptor);
  return is_synchronised;
}

} // namespace

AtomicFile::AtomicFile(const std::filesystem::path& path) : path(path), part(path) {
  part += ".rollwave-" + std::to_string(getpid()) + ".part";
  // Whoever removes the directory during a long computation would lose its result.
  std::error_code ignored;
  std::filesystem::create_directories(path.parent_path(), ignored);
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

unsigned long AtomicFile::finish() {
  const bool has_failed = !out;
  if (has_failed) {
    out.clear();
    out.put('\n'); // fails again when the file is closed, which tells the reason
  }
  errno = 0;
  out.close();
  // Moved before its content is on the disk, a file could be found empty after a crash of the
  // machine; and some file systems notice only here that they are full.
  if (has_failed || !out || !is_on_disk(part))
    fail(path, errno);
  std::error_code error;
  const auto size = std::filesystem::file_size(part, error);
  if (error)
    fail(path, error.value());
  return size;
}

void AtomicFile::commit() {
  std::error_code error;
  std::filesystem::rename(part, path, error);
  if (error)
    fail(path, error.value());
}

bool is_abandoned_part(const std::filesystem::path& path) {
  return path.extension() == ".part" && path.stem().extension().string().find(".rollwave-") == 0;
}

void record_file(const std::filesystem::path& path) {
  const auto record = path.parent_path() / record_name;
  const int descriptor = open(record.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor < 0)
    return;
  const std::string line = path.filename().string() + '\n';
  const bool is_written =
      write(descriptor, line.data(), line.size()) == static_cast<ssize_t>(line.size());
  const int error = errno;
  close(descriptor);
  if (!is_written)
    fail(path, error);
}

unsigned long write_file(const std::filesystem::path& path, const std::string& content) {
  for (;;)
    try {
      AtomicFile file(path);
      file.stream() << content;
      const unsigned long size = file.finish();
      record_file(path); // first: what is not recorded is never removed
      file.commit();
      return size;
    } catch (const NotWritten&) {
      // Once more where somebody has moved the directory away meanwhile: then it can be made anew.
      std::error_code ignored;
      if (std::filesystem::exists(path.parent_path(), ignored) ||
          !std::filesystem::create_directories(path.parent_path(), ignored))
        throw;
    }
}

} // namespace rollwave
