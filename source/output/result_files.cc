#include "rollwave/output/result_files.h"

#include "rollwave/base/atomic_file.h"
#include "rollwave/base/errors.h"
#include "rollwave/base/memory.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/output/gnuplot.h"
#include "rollwave/output/scene_plot.h"
#include "rollwave/output/summary_json.h"
#include "rollwave/output/surface_vtu.h"
#include "rollwave/output/vtu.h"
#include "rollwave/scene/units.h"

#include <exception>
#include <limits>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

std::string contact_csv(const Result& result, const Units& units) {
  const std::string length_unit = units.in_brackets(Quantity::length);
  const double length = units.of(Quantity::length), pressure = units.of(Quantity::pressure),
               area = length * units.material.width;
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  out << "z" << units.in_brackets(Quantity::angle) << ",u" << length_unit << ",phi" << length_unit
      << ",gap" << length_unit << ",pressure" << units.in_brackets(Quantity::pressure) << ",weight"
      << units.in_brackets(Quantity::area) << '\n';
  for (const ContactRow& row : result.contact_rows)
    out << row.angle << ',' << row.displacement * length << ',' << row.phi * length << ','
        << row.gap * length << ',' << row.pressure * pressure << ',' << row.weight * area << '\n';
  return out.str();
}

/// Writes the field, each process its own cells if it has any.
/// @throws NotWritten on all processes
void write_field(const std::filesystem::path& directory, const Parameters& parameters,
                 const Solution& solution, WrittenFiles& written) {
  const MPI_Comm communicator = solution.space().communicator();
  std::string own; // stays empty where there are more processes than cells
  for (const auto& cell : solution.space().dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
      own = is_serial(communicator)
                ? "solution.vtu"
                : "solution." + std::to_string(process_number(communicator)) + ".vtu";
  std::string failure;
  unsigned long n_bytes = 0;
  if (!own.empty())
    try {
      AtomicFile file(directory / own);
      write_solution_vtu(file.stream(), solution, parameters.output.cells);
      n_bytes = file.commit();
    } catch (const NotWritten& error) {
      failure = error.what();
    }
  failure = first_text(communicator, failure);
  if (!failure.empty())
    throw NotWritten(failure);
  std::vector<std::string> pieces;
  for (const std::string& piece : Utilities::MPI::all_gather(communicator, own))
    if (!piece.empty()) {
      pieces.push_back(piece);
      written.files.push_back(directory / piece);
    }
  written.n_bytes += Utilities::MPI::sum(n_bytes, communicator);
  if (process_number(communicator) == 0 && !is_serial(communicator)) {
    std::ostringstream whole;
    write_solution_pvtu(whole, solution, parameters.output.cells, pieces);
    written.write(directory / "solution.pvtu", whole.str());
  }
}

} // namespace

WrittenFiles write_results(const std::filesystem::path& directory, const Parameters& parameters,
                           Solution& solution) {
  const Scene& scene = solution.scene;
  Result& result = solution.result;
  const MPI_Comm communicator = solution.space().communicator();
  const bool is_first = process_number(communicator) == 0;
  WrittenFiles written;
  std::exception_ptr failure;
  {
    const RunStatistics::Phase phase(result.statistics, "output");
    if (is_first)
      write_parameters(directory, parameters, written);
    if (parameters.wants(OutputFile::contact) && is_first)
      written.write(directory / "contact.csv", contact_csv(result, scene.units));
    if (parameters.wants(OutputFile::surface) && is_first) {
      written.write(directory / "surface.vtu", surface_vtu(scene, result));
      written.write(directory / "road.vtu", road_vtu(scene));
    }
    if (parameters.wants(OutputFile::solution))
      try {
        write_field(directory, parameters, solution, written);
      } catch (const NotWritten&) {
        failure = std::current_exception(); // the largest file by far: others may have room
      }
    if (parameters.wants(OutputFile::plot) && is_first)
      draw(plot_scene(scene, result), directory, "scene", written);
  }
  result.statistics.bytes_written += written.n_bytes;
  write_summary(directory, parameters, solution, written);
  if (failure)
    std::rethrow_exception(failure);
  return written;
}

void write_summary(const std::filesystem::path& directory, const Parameters& parameters,
                   Solution& solution, WrittenFiles& written) {
  const MPI_Comm communicator = solution.space().communicator();
  Result& result = solution.result;
  result.peak_memory_mib = Utilities::MPI::max(peak_memory_mib(), communicator);
  if (parameters.wants(OutputFile::summary) && process_number(communicator) == 0)
    written.write(directory / "summary.json", summary_json(solution.scene, parameters, result));
}

} // namespace rollwave
