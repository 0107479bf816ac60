#include "rollwave/output/result_files.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/memory.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/output/scene_plot.h"
#include "rollwave/output/summary_json.h"
#include "rollwave/output/surface_vtu.h"
#include "rollwave/output/vtu.h"
#include "rollwave/parameters/keys.h"
#include "rollwave/plot/gnuplot.h"
#include "rollwave/scene/units.h"

#include <exception>
#include <limits>
#include <map>
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
  out << "z" << units.in_brackets(Quantity::angle) << ",road_length" << length_unit << ",u"
      << length_unit << ",phi" << length_unit << ",gap" << length_unit << ",pressure"
      << units.in_brackets(Quantity::pressure) << ",weight" << units.in_brackets(Quantity::area)
      << '\n';
  for (const ContactRow& row : result.contact_rows)
    out << row.angle << ',' << row.road_length * length << ',' << row.displacement * length << ','
        << row.phi * length << ',' << row.gap * length << ',' << row.pressure * pressure << ','
        << row.weight * area << '\n';
  return out.str();
}

/// VTU files have numbers of single precision. Those of a scene are of the order of 1 in its units.
bool fits_single_precision(const Units& units) {
  const auto fits = [&units](Quantity quantity) {
    const double unit = units.of(quantity);
    return unit > 1e-36 && unit < 1e37;
  };
  return fits(Quantity::length) && fits(Quantity::pressure) && fits(Quantity::energy_norm);
}

/// The parameters with the calibrated shear modulus and density, with the step length of Uzawa's
/// method in the same ratio, and with the nip alone: with the load another run would calibrate
/// anew, and the load alone would lead to other adaptive meshes.
Parameters parameters_used(const Parameters& given, const Result& result) {
  if (!result.modulus_ratio)
    return given;
  const std::string origin = "calibration";
  const auto scaled = [&](const std::string& section, const std::string& key, double value) {
    return read({section, key, number_text(*result.modulus_ratio * value), origin});
  };
  std::vector<Assignment> changes = {
      scaled("Material", "Shear modulus", given.material.shear_modulus),
      scaled("Material", "Density", given.material.density),
      read({"Road", "Load", "none", origin})};
  if (given.contact.rho)
    changes.push_back(scaled("Contact", "Rho", *given.contact.rho));
  return with_values(given, changes);
}

} // namespace

std::vector<std::string> result_file_names(const OutputOptions& output) {
  const std::map<OutputFile, std::vector<std::string>> names_of = {
      {OutputFile::summary, {"summary.json"}},
      {OutputFile::contact, {"contact.csv"}},
      {OutputFile::parameters, {"parameters.prm"}},
      {OutputFile::solution, {"solution.vtu"}},
      {OutputFile::surface, {"surface.vtu", "road.vtu"}},
      {OutputFile::plot, picture_files("scene", output.picture_format)}};
  std::vector<std::string> names;
  for (const OutputFile kind : output.files)
    names.insert(names.end(), names_of.at(kind).begin(), names_of.at(kind).end());
  return names;
}

WrittenFiles write_results(const std::filesystem::path& directory, const Parameters& parameters,
                           Solution& solution) {
  const Scene& scene = solution.scene;
  Result& result = solution.result;
  const bool is_first = process_number(solution.space().communicator()) == 0;
  WrittenFiles written;
  std::exception_ptr failure;
  {
    const RunStatistics::Phase phase(result.statistics, "output");
    if (is_first)
      write_parameters(directory, parameters_used(parameters, result), written);
    if (parameters.wants(OutputFile::contact) && is_first)
      written.write(directory / "contact.csv", contact_csv(result, scene.units));
    if (parameters.wants(OutputFile::surface) && is_first) {
      written.write(directory / "surface.vtu", surface_vtu(scene, result));
      written.write(directory / "road.vtu", road_vtu(scene));
    }
    if (parameters.wants(OutputFile::solution)) {
      try {
        written.write_parts(directory / "solution.vtu",
                            solution_vtu(solution, parameters.output.cells),
                            solution.space().communicator());
      } catch (const NotWritten&) {
        failure = std::current_exception(); // the largest file by far: others may have room
      }
    }
    if ((parameters.wants(OutputFile::solution) || parameters.wants(OutputFile::surface)) &&
        !fits_single_precision(scene.units))
      written.notes.push_back(
          {Note::Kind::remark,
           "VTU files hold numbers of single precision, up to 3e38, and have lost some here; "
           "choose other units, or see contact.csv and summary.json"});
  }
  result.statistics.bytes_written += written.n_bytes;
  write_summary(directory, parameters, solution, written);
  if (parameters.wants(OutputFile::plot) && is_first) { // last, since gnuplot may hang
    const RunStatistics::Phase phase(result.statistics, "output");
    draw({plot_scene(scene, parameters, result)}, directory, parameters.output.picture_format,
         written);
  }
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
