#ifndef ROLLWAVE_BASE_ATOMIC_FILE_H
#define ROLLWAVE_BASE_ATOMIC_FILE_H

#include <filesystem>
#include <fstream>
#include <string>

namespace rollwave {

/**
 * A file that is either complete or absent: it is written beside its place, under a name that no
 * other process uses, and moved there by commit() after finish(). Without commit() nothing remains,
 * unless the process is killed.
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

/// Whether a file has the name of a part that an AtomicFile leaves when its process is killed.
bool is_abandoned_part(const std::filesystem::path& path);

/// The file that lists what this program has written into a directory, one name in a line.
inline constexpr const char* record_name = ".rollwave";

/// Notes a file in the record of its directory, if that has one. @throws NotWritten.
void record_file(const std::filesystem::path& path);

/// Records and writes a file, and returns its size in bytes. @throws NotWritten.
unsigned long write_file(const std::filesystem::path& path, const std::string& content);

} // namespace rollwave

#endif
