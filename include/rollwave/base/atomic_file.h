#pragma once

#include <mpi.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace rollwave {

/**
 * A file that is either complete or absent: it is written next to its place, under a name that no
 * other run uses, and moved there by commit(). Without commit() no file remains. A killed process
 * may leave one that ends in .part.
 */
class AtomicFile {
public:
  /// Makes the directory where it is missing. @throws NotWritten when the file cannot be opened.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return out; }

  /// The temporary path, for another program that writes the file.
  const std::filesystem::path& part() const { return temporary; }

  /// Moves the file to its place and returns its size in bytes.
  /// @throws NotWritten when anything could not be written.
  unsigned long commit();

private:
  std::filesystem::path path;
  std::filesystem::path temporary;
  std::ofstream out;
  bool is_in_place = false;
};

/// The text of a file; empty where it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// Writes a file and returns its size in bytes. @throws NotWritten.
unsigned long write_file(const std::filesystem::path& path, const std::string& content);

/// Writes a file of which each process has a part, in the order of their ranks. Parts go to rank 0
/// in small pieces. All processes must call it.
/// @return on rank 0 its size in bytes @throws NotWritten on all processes
unsigned long write_file_in_parts(const std::filesystem::path& path, const std::string& part,
                                  MPI_Comm communicator);

} // namespace rollwave
