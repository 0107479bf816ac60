#include "rollwave/output/output_directory.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/version.h"

#include <algorithm>
#include <cerrno>
#include <sstream>
#include <system_error>
#include <unistd.h>

namespace rollwave {

namespace fs = std::filesystem;

namespace {

constexpr const char* first_words = "# All parameters of a run of ";

/// True if @p path is the parameter file that was read.
bool is_input(const Parameters& parameters, const fs::path& path) {
  std::error_code ignored; // where one of them is not there, they differ
  return fs::equivalent(parameters.file, path, ignored);
}

bool has_own_parameters(const fs::path& directory) {
  return read_file(directory / "parameters.prm").rfind(first_words, 0) == 0;
}

/// @throws BadValue if a file of one of these names may not be written in the directory
void check_names(const fs::path& directory, const Parameters& parameters,
                 const std::vector<std::string>& names) {
  const bool is_own = has_own_parameters(directory);
  for (const std::string& name : names) {
    const fs::path path = directory / name;
    const bool is_read = is_input(parameters, path),
               is_there = fs::exists(fs::symlink_status(path)), // a link without a target as well
        is_left = is_read && name == "parameters.prm";
    if (is_there && !is_left && (is_read || !is_own))
      throw BadValue("Output", "Directory",
                     path.string() +
                         (is_read ? " is the parameter file that is read"
                                  : " may not be a file of Rollwave: there is no parameters.prm of "
                                    "an earlier run next to it") +
                         "; choose another directory by --output, or move the file");
  }
}

} // namespace

void write_parameters(const fs::path& directory, const Parameters& parameters,
                      WrittenFiles& written) {
  const fs::path path = directory / "parameters.prm";
  if (is_input(parameters, path)) {
    written.notes.push_back(
        {Note::Kind::remark, "parameters.prm is the file that was read, and is left as it is"});
    return;
  }
  std::ostringstream text;
  text << first_words << version_text() << ".\n\n";
  print_parameters(text, parameters);
  written.write(path, text.str());
}

std::vector<fs::path> prepare_directory(const Parameters& parameters,
                                        const std::vector<std::string>& names,
                                        MPI_Comm communicator) {
  if (process_number(communicator) > 0)
    return {};
  const fs::path directory = parameters.output.directory;
  std::error_code error;
  fs::create_directories(directory, error);
  if (error == std::errc::no_space_on_device)
    throw NotWritten(directory.string() + " could not be made: " + error.message());
  if (!error && access(directory.c_str(), W_OK) != 0)
    error.assign(errno, std::generic_category());
  if (error)
    throw BadValue("Output", "Directory",
                   "this directory cannot be made or written into: " + error.message());
  check_names(directory, parameters, names);
  std::vector<fs::path> files;
  if (has_own_parameters(directory))
    for (const auto& entry : fs::directory_iterator(directory, error))
      if (!is_input(parameters, entry.path()))
        files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

} // namespace rollwave
