#ifndef ROLLWAVE_BASE_ATOMIC_FILE_H
#define ROLLWAVE_BASE_ATOMIC_FILE_H

#include <filesystem>
#include <fstream>

namespace rollwave {

/**
 * A file that is either complete or absent: it is written beside its place as "NAME.part" and moved
 * there by commit() after finish(). Without commit() nothing remains, unless the process is killed:
 * then "NAME.part" does, until the file is written again.
 */
class AtomicFile {
public:
  /// Makes the directory where it is missing. @throws NotWritten when the file cannot be opened.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return out; }

  /// Waits until all is on the disk and returns the size in bytes.
  /// @throws NotWritten when anything could not be written.
  unsigned long finish();

  /// Moves the file, when it is finished, to its place. @throws NotWritten.
  void commit();

private:
  std::filesystem::path path;
  std::filesystem::path part;
  std::ofstream out;
};

/// Writes @p content and returns its size in bytes. @throws NotWritten.
unsigned long write_file(const std::filesystem::path& path, const std::string& content);

} // namespace rollwave

#endif
