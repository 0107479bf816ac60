#include "rollwave/output/output_directory.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/version.h"

#include <algorithm>
#include <cerrno>
#include <sstream>
#include <system_error>
#include <tuple>
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

} // namespace

void write_parameters(const fs::path& directory, const Parameters& parameters,
                      WrittenFiles& written) {
  const fs::path path = directory / "parameters.prm";
  if (is_input(parameters, path)) {
    written.remarks.push_back("parameters.prm is the file that was read, and is left as it is");
    return;
  }
  std::ostringstream text;
  text << first_words << version_text() << ".\n\n";
  print_parameters(text, parameters.settings);
  written.write(path, text.str());
}

void check_own_files(const fs::path& directory, const Parameters& parameters,
                     const std::set<OutputFile>& kinds) {
  for (const auto& [kind, name, start] :
       {std::tuple(OutputFile::parameters, "parameters.prm", first_words),
        {OutputFile::summary, "summary.json", "{\n  \"program\": \"Rollwave "}})
    if (const fs::path file = directory / name;
        kinds.count(kind) > 0 && fs::exists(file) && read_file(file).rfind(start, 0) != 0 &&
        !(kind == OutputFile::parameters && is_input(parameters, file)))
      throw BadValue("Output", "Directory",
                     file.string() + " is not a file of Rollwave, and would be overwritten; choose "
                                     "another directory, or move the file");
}

std::vector<fs::path> prepare_directory(const Parameters& parameters, bool is_study,
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
  check_own_files(directory, parameters,
                  is_study ? std::set{OutputFile::parameters} : parameters.output.files);
  std::vector<fs::path> files;
  if (read_file(directory / "parameters.prm").rfind(first_words, 0) == 0)
    for (const auto& entry : fs::directory_iterator(directory, error))
      if (!is_input(parameters, entry.path()))
        files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

} // namespace rollwave
