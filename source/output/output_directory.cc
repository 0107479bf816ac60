#include "rollwave/output/output_directory.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/version.h"

#include <cerrno>
#include <functional>
#include <map>
#include <optional>
#include <regex>
#include <sstream>
#include <system_error>
#include <unistd.h>

namespace rollwave {

namespace fs = std::filesystem;

namespace {

/// The files that runs write, and for the run of a scene the kind that asks for them. A further
/// output file is added here: later runs that do not write it remove it.
const std::map<std::string, std::optional<OutputFile>> own_files = {
    {"summary.json", OutputFile::summary},
    {"contact.csv", OutputFile::contact},
    {"parameters.prm", OutputFile::parameters},
    {"solution.vtu", OutputFile::solution},
    {"solution.pvtu", {}}, // on several processes, with solution.0.vtu and so on
    {"surface.vtu", OutputFile::surface},
    {"road.vtu", OutputFile::surface},
    {"scene.gp", OutputFile::plot},
    {"scene.svg", OutputFile::plot},
    {"study.csv", {}},
    {"study.txt", {}},
    {"study.tex", {}},
    {"study.pvd", {}},
    {"study-profiles.csv", {}}};

/// True for files that have numbers in their names, and for the pictures of studies.
bool is_of_own_series(const std::string& name) {
  static const std::regex series(
      R"(solution\.\d+\.vtu|study(-(curves|profiles|map|h|unknowns|time))?\.(gp|svg))");
  return std::regex_match(name, series);
}

constexpr const char* first_words = "# All parameters of a run of ";

std::string complete_parameters(const Parameters& parameters) {
  std::ostringstream text;
  text << first_words << version_text() << ".\n\n";
  print_parameters(text, parameters.settings);
  return text.str();
}

/// True if @p path is the parameter file that was read.
bool is_input(const Parameters& parameters, const fs::path& path) {
  std::error_code ignored; // where one of them is not there, they differ
  return fs::equivalent(parameters.file, path, ignored);
}

/// Removes the files of an earlier run in a directory, except those that are @p kept.
void remove_files(const fs::path& directory, const Parameters& parameters,
                  const std::function<bool(const std::string&)>& kept,
                  std::vector<std::string>& removed) {
  std::error_code ignored;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(directory, ignored)) {
    const std::string name = entry.path().filename().string();
    if ((own_files.count(name) > 0 || is_of_own_series(name)) && !kept(name) &&
        entry.symlink_status(ignored).type() == fs::file_type::regular &&
        !is_input(parameters, entry.path()))
      files.push_back(entry.path());
  }
  for (const fs::path& file : files)
    if (fs::remove(file, ignored))
      removed.push_back(file.lexically_relative(parameters.output.directory).string());
}

std::vector<std::string> remove_files_of_earlier_run(const Parameters& parameters, bool is_study,
                                                     bool is_one_process) {
  const fs::path directory = parameters.output.directory;
  std::vector<std::string> removed;
  if (read_file(directory / "parameters.prm").rfind(first_words, 0) != 0 ||
      (is_study && is_of_same_run(parameters))) // a study that continues
    return removed;
  remove_files(
      directory, parameters,
      [&](const std::string& name) {
        const auto own = own_files.find(name);
        return !is_study && own != own_files.end() && own->second &&
               parameters.wants(*own->second) && (is_one_process || name != "solution.vtu");
      },
      removed);
  static const std::regex of_one_run(R"(run-\d{3,})");
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(directory, ignored))
    if (std::regex_match(entry.path().filename().string(), of_one_run)) {
      remove_files(
          entry.path(), parameters, [](const std::string&) { return false; }, removed);
      fs::remove(entry.path(), ignored); // if it is empty
    }
  return removed;
}

} // namespace

void WrittenFiles::write(const fs::path& path, const std::string& content) {
  n_bytes += write_file(path, content);
  files.push_back(path);
}

void write_parameters(const fs::path& directory, const Parameters& parameters,
                      WrittenFiles& written) {
  const fs::path path = directory / "parameters.prm";
  if (is_input(parameters, path))
    written.remarks.push_back("parameters.prm is the file that was read, and is left as it is");
  else
    written.write(path, complete_parameters(parameters));
}

bool is_of_same_run(const Parameters& parameters) {
  return read_file(fs::path(parameters.output.directory) / "parameters.prm") ==
         complete_parameters(parameters);
}

std::vector<std::string> prepare_directory(const Parameters& parameters, bool is_study,
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
  return remove_files_of_earlier_run(parameters, is_study, is_serial(communicator));
}

} // namespace rollwave
