#include "rollwave/output/result_files.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/memory.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/output/scene_plot.h"
#include "rollwave/output/summary_json.h"
#include "rollwave/output/surface_vtu.h"
#include "rollwave/output/vtu.h"
#include "rollwave/scene/units.h"

#include <exception>
#include <limits>
#include <optional>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

std::string contact_csv(const Result& result, const Units& units) {
  const std::string length = units.in_brackets(Quantity::length);
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  out << "z" << units.in_brackets(Quantity::angle) << ",u" << length << ",phi" << length << ",gap"
      << length << ",pressure" << units.in_brackets(Quantity::pressure) << ",weight"
      << units.in_brackets(Quantity::area) << '\n';
  for (const ContactRow& row : result.contact_rows)
    out << row.angle << ',' << row.displacement << ',' << row.road << ',' << row.gap << ','
        << row.pressure << ',' << row.weight << '\n';
  return out.str();
}

/// Writes the field, each process its own cells if it has any. Returns the number of bytes.
unsigned long write_field(const std::filesystem::path& directory, const Parameters& parameters,
                          const Solution& solution, WrittenFiles& written) {
  const MPI_Comm communicator = solution.space->communicator();
  const unsigned int process = process_number(communicator);
  std::vector<std::string> pieces;
  std::string own = "solution.vtu";
  if (is_alone(communicator))
    pieces = {own};
  else {
    own.clear(); // more processes than cells
    for (const auto& cell : solution.space->dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        own = "solution." + std::to_string(process) + ".vtu";
    for (const std::string& piece : Utilities::MPI::all_gather(communicator, own))
      if (!piece.empty())
        pieces.push_back(piece);
  }
  if (process == 0)
    for (const std::string& piece : pieces)
      record_file(directory / piece);
  std::optional<AtomicFile> file;
  unsigned long bytes = 0;
  if (!own.empty()) {
    file.emplace(directory / own);
    write_solution_vtu(file->stream(), solution, parameters.output.cells);
    bytes = file->finish();
  }
  // No piece is moved to its place before all are on the disk.
  bytes = Utilities::MPI::sum(bytes, communicator);
  if (file)
    file->commit();
  for (const std::string& piece : pieces)
    written.files.push_back(directory / piece);
  if (process == 0 && !is_alone(communicator)) {
    std::ostringstream whole;
    write_solution_pvtu(whole, solution, parameters.output.cells, pieces);
    written.files.push_back(directory / "solution.pvtu");
    bytes += write_file(written.files.back(), whole.str());
  }
  return bytes;
}

/// summary.json with what has been done so far; all processes must ask.
std::string summary_of(const Parameters& parameters, const Solution& solution) {
  Result result = in_users_units(solution.result, solution.scene.units);
  result.peak_memory_mib = Utilities::MPI::max(peak_memory_mib(), solution.space->communicator());
  return summary_json(solution.scene, parameters, result);
}

} // namespace

WrittenFiles write_results(const std::filesystem::path& directory, const Parameters& parameters,
                           Solution& solution) {
  const Scene& scene = solution.scene;
  const Result result = in_users_units(solution.result, scene.units);
  WrittenFiles written;
  Work& work = solution.result.work;
  const MPI_Comm communicator = solution.space->communicator();
  const bool is_first = process_number(communicator) == 0;
  const auto add = [&](const std::string& name, const std::string& content) {
    if (is_input(parameters, directory / name)) {
      written.remarks.push_back(name + " is the file that was read, and is left as it is");
      return;
    }
    work.bytes_written += write_file(directory / name, content);
    written.files.push_back(directory / name);
  };
  std::exception_ptr failure;
  {
    const Work::Phase phase(work, "output");
    if (parameters.wants(OutputFile::contact) && is_first)
      add("contact.csv", contact_csv(result, scene.units));
    if (is_first) {
      std::ostringstream text;
      write_parameters(text, parameters);
      add("parameters.prm", text.str());
    }
    if (parameters.wants(OutputFile::surface) && is_first) {
      add("surface.vtu", surface_vtu(scene, result));
      add("road.vtu", road_vtu(scene));
    }
    if (parameters.wants(OutputFile::solution))
      try {
        work.bytes_written += write_field(directory, parameters, solution, written);
      } catch (const NotWritten&) {
        // The largest file by far: where it has no room, the others may.
        if (!is_alone(communicator))
          throw;
        failure = std::current_exception();
      }
    if (parameters.wants(OutputFile::plot) && is_first) {
      if (const auto [svg, reason] = plot_scene(scene, result); reason.empty())
        add("scene.svg", svg);
      else
        written.remarks.push_back("scene.svg was not drawn: " + reason);
    }
  }
  const std::string summary = summary_of(parameters, solution);
  if (parameters.wants(OutputFile::summary) && is_first)
    add("summary.json", summary);
  if (failure)
    std::rethrow_exception(failure);
  return written;
}

void write_summary(const std::filesystem::path& directory, const Parameters& parameters,
                   const Solution& solution) {
  const std::string summary = summary_of(parameters, solution);
  const std::filesystem::path file = directory / "summary.json";
  if (parameters.wants(OutputFile::summary) && !is_input(parameters, file) &&
      process_number(solution.space->communicator()) == 0)
    write_file(file, summary);
}

} // namespace rollwave
