#include "rollwave/output/output_directory.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/version.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <ostream>
#include <sys/file.h>
#include <unistd.h>

namespace rollwave {

namespace fs = std::filesystem;

void write_parameters(std::ostream& out, const Parameters& parameters) {
  out << "# All parameters of a run of " << version_text() << ".\n\n";
  print_parameters(out, parameters.settings);
}

bool is_input(const Parameters& parameters, const fs::path& path) {
  std::error_code ignored; // where one of them is not there, they differ
  return fs::equivalent(parameters.file, path, ignored);
}

std::string set_study_aside(const fs::path& directory) {
  const auto exists = [&](const std::string& name) {
    return fs::exists(directory / (name + ".csv")) || fs::exists(directory / (name + ".jsonl"));
  };
  if (!exists("study"))
    return "";
  std::string kept = "study-before";
  for (unsigned int number = 2; exists(kept); ++number)
    kept = "study-before-" + std::to_string(number);
  for (const std::string ending : {".jsonl", ".csv"}) {
    std::error_code error;
    if (fs::exists(directory / ("study" + ending), error))
      fs::rename(directory / ("study" + ending), directory / (kept + ending), error);
    if (error)
      throw NotWritten((directory / ("study" + ending)).string() +
                       " could not be moved: " + error.message());
  }
  return kept;
}

OutputDirectory::OutputDirectory(const Parameters& parameters, MPI_Comm communicator)
    : directory(parameters.output.directory), parameters(parameters) {
  if (process_number(communicator) > 0) {
    share_text(communicator, ""); // when it is there
    return;
  }
  const auto refuse = [](const std::string& why) { throw BadValue("Output", "Directory", why); };
  std::error_code error;
  fs::create_directories(directory, error);
  if (error == std::errc::no_space_on_device)
    throw NotWritten(directory.string() + " could not be made: " + error.message());
  if (!error) {
    record = open((directory / record_name).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (record < 0)
      error.assign(errno, std::generic_category());
  }
  if (error)
    refuse("this directory cannot be made or written into: " + error.message());
  const bool is_locked = flock(record, LOCK_EX | LOCK_NB) == 0;
  if (!is_locked && errno == EWOULDBLOCK) {
    close(record);
    refuse("another run of rollwave writes into this directory; wait for its end, or choose "
           "another directory");
  }
  n_earlier = recorded().size();
  std::error_code ignored;
  std::vector<fs::path> abandoned;
  if (is_locked) // which not every file system can
    for (const auto& entry : fs::directory_iterator(directory, ignored))
      if (is_abandoned_part(entry.path()))
        abandoned.push_back(entry.path());
  for (const fs::path& part : abandoned)
    fs::remove(part, ignored);
  share_text(communicator, "");
}

OutputDirectory::~OutputDirectory() {
  if (record >= 0)
    close(record);
}

std::vector<std::string> OutputDirectory::recorded() const {
  std::vector<std::string> names;
  std::ifstream in(directory / record_name);
  for (std::string name; std::getline(in, name);)
    names.push_back(name);
  return names;
}

std::vector<std::string> OutputDirectory::files_of_earlier_runs() const {
  const std::vector<std::string> names = recorded();
  const auto own = names.begin() + std::min(n_earlier, names.size());
  std::vector<std::string> earlier;
  std::error_code ignored;
  for (auto name = names.begin(); name != own; ++name)
    if (std::find(own, names.end(), *name) == names.end() &&
        std::find(names.begin(), name, *name) == name && fs::path(*name).filename() == *name &&
        fs::is_regular_file(fs::symlink_status(directory / *name, ignored)) &&
        !is_input(parameters, directory / *name))
      earlier.push_back(*name);
  return earlier;
}

void OutputDirectory::remove_files_of_earlier_runs(WrittenFiles& written) {
  if (record < 0)
    return;
  for (const fs::path& file : written.files)
    record_file(file); // also what this run has found as it would write it
  std::string removed;
  std::error_code ignored;
  for (const std::string& name : files_of_earlier_runs())
    if (name == "study.csv" || name == "study.jsonl") {
      if (const std::string kept = set_study_aside(directory); !kept.empty())
        written.remarks.push_back("study.csv is of an earlier run, and kept as " + kept + ".csv");
    } else if (fs::remove(directory / name, ignored))
      removed += (removed.empty() ? "" : ", ") + name;
  if (!removed.empty())
    written.remarks.push_back("removed, since they were of an earlier run: " + removed);
  // The record is locked, so that it cannot be replaced by another file.
  std::string names;
  for (const fs::path& file : written.files)
    names += file.filename().string() + '\n';
  if (pwrite(record, names.data(), names.size(), 0) == static_cast<ssize_t>(names.size()) &&
      ftruncate(record, names.size()) == 0)
    n_earlier = 0;
}

} // namespace rollwave
