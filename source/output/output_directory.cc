#include "rollwave/output/output_directory.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/memory.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/version.h"
#include "rollwave/output/scene_plot.h"
#include "rollwave/output/summary_json.h"
#include "rollwave/output/vtu.h"

#include <algorithm>
#include <cerrno>
#include <exception>
#include <limits>
#include <ostream>
#include <regex>
#include <sstream>
#include <unistd.h>

namespace rollwave {

using namespace dealii;

namespace {

std::string contact_csv(const Result& result) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  out << "z,u,phi,gap,pressure,weight\n";
  for (const ContactRow& row : result.contact_rows)
    out << row.angle << ',' << row.displacement << ',' << row.road << ',' << row.gap << ','
        << row.pressure << ',' << row.weight << '\n';
  return out.str();
}

/// Removes the fields of earlier runs, which another number of processes left in files of other
/// names.
void remove_other_solutions(const std::filesystem::path& directory,
                            const std::vector<std::filesystem::path>& files) {
  const std::regex name("solution(\\.[0-9]+)?\\.p?vtu");
  std::error_code ignored;
  std::vector<std::filesystem::path> others;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored))
    if (std::regex_match(entry.path().filename().string(), name) &&
        std::find(files.begin(), files.end(), entry.path()) == files.end())
      others.push_back(entry.path());
  for (const auto& other : others)
    std::filesystem::remove(other, ignored);
}

} // namespace

std::filesystem::path prepare_directory(const Parameters& parameters, MPI_Comm communicator) {
  const std::filesystem::path directory = parameters.output.directory;
  if (process_number(communicator) > 0) {
    share_text(communicator, ""); // when it is there
    return directory;
  }
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error == std::errc::no_space_on_device)
    throw NotWritten(directory.string() + " could not be made: " + error.message());
  if (!error && access(directory.c_str(), W_OK | X_OK) != 0)
    error.assign(errno, std::generic_category());
  if (error)
    throw BadInput(refusal(parameters.settings, "Output", "Directory",
                           "this directory cannot be made or written into: " + error.message()));
  share_text(communicator, "");
  return directory;
}

void write_parameters(std::ostream& out, const Parameters& parameters) {
  out << "# All parameters of a run of " << version_text() << ".\n\n";
  print_parameters(out, parameters.settings);
}

WrittenFiles write_results(const std::filesystem::path& directory, const Scene& scene,
                           const Parameters& parameters, Solution& solution) {
  WrittenFiles written;
  Work& work = solution.result.work;
  const double b = parameters.cylinder.outer_radius;
  const MPI_Comm communicator = solution.space->communicator();
  const unsigned int process = process_number(communicator);
  const unsigned int n_processes = count_processes(communicator);
  const auto add = [&](const std::string& name, const std::string& content) {
    if (process > 0)
      return;
    work.bytes_written += write_file(directory / name, content);
    written.files.push_back(directory / name);
  };
  const auto write_field = [&] {
    std::vector<std::string> pieces = {"solution.vtu"};
    if (n_processes > 1)
      for (pieces.clear(); pieces.size() < n_processes;)
        pieces.push_back("solution." + std::to_string(pieces.size()) + ".vtu");
    AtomicFile file(directory / pieces[process]);
    // The format's numbers have single precision.
    const bool fits = 1e-25 < b && b < 1e35;
    write_solution_vtu(file.stream(), solution, fits ? scene.unit : 1 / scene.outer_radius);
    if (!fits)
      written.remarks.push_back("solution.vtu gives lengths over the outer radius, since they "
                                "leave the range of single precision");
    // No piece is moved to its place before all are on the disk.
    work.bytes_written += Utilities::MPI::sum(file.finish(), communicator);
    file.commit();
    for (const std::string& piece : pieces)
      written.files.push_back(directory / piece);
    if (n_processes > 1) {
      std::ostringstream record;
      write_solution_pvtu(record, solution, pieces);
      add("solution.pvtu", record.str());
    }
    if (process == 0)
      remove_other_solutions(directory, written.files);
  };
  std::exception_ptr failure;
  {
    const Work::Phase phase(work, "output");
    std::vector<std::pair<std::string, Drawing>> drawings; // made while the files are written
    if (parameters.wants(OutputFile::plot) && process == 0)
      drawings.emplace_back("scene.svg", plot_scene(scene, solution.result));
    if (parameters.wants(OutputFile::contact))
      add("contact.csv", contact_csv(to_lengths(solution.result, scene.unit)));
    if (parameters.wants(OutputFile::parameters)) {
      std::ostringstream text;
      write_parameters(text, parameters);
      add("parameters.prm", text.str());
    }
    if (parameters.wants(OutputFile::solution))
      try {
        write_field();
      } catch (const NotWritten&) {
        // The largest file by far: where it has no room, the others may.
        if (n_processes > 1)
          throw;
        failure = std::current_exception();
      }
    for (auto& [name, drawing] : drawings)
      if (const auto [svg, failure] = drawing.take(); failure.empty())
        add(name, svg);
      else
        written.remarks.push_back(name + " was not drawn: " + failure);
  }
  solution.result.peak_memory_mib = Utilities::MPI::max(peak_memory_mib(), communicator);
  if (parameters.wants(OutputFile::summary))
    add("summary.json", summary_json(scene, parameters, to_lengths(solution.result, scene.unit)));
  if (failure)
    std::rethrow_exception(failure);
  return written;
}

} // namespace rollwave
