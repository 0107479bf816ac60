#include "output.h"

#include "atomic_file.h"
#include "errors.h"
#include "mesh_plot.h"
#include "scene_plot.h"
#include "solution_vtu.h"
#include "summary.h"
#include "version.h"

#include <cerrno>
#include <limits>
#include <ostream>
#include <sstream>
#include <unistd.h>

namespace rollwave {

namespace {

std::string contact_csv(const Result& result) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  out << "z,u,phi,gap,pressure\n";
  for (const ContactRow& row : result.contact_rows)
    out << row.angle << ',' << row.displacement << ',' << row.road << ',' << row.gap << ','
        << row.pressure << '\n';
  return out.str();
}

} // namespace

std::filesystem::path prepare_directory(const Parameters& parameters) {
  const std::filesystem::path directory = parameters.output.directory;
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error == std::errc::no_space_on_device)
    throw NotWritten(directory.string() + " could not be made: " + error.message());
  if (!error && access(directory.c_str(), W_OK | X_OK) != 0)
    error.assign(errno, std::generic_category());
  if (error)
    throw BadInput(refusal(parameters.settings, "Output", "Directory",
                           "this directory cannot be made or written into: " + error.message()));
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
  const auto add = [&](const std::string& name, const std::string& content) {
    work.bytes_written += write_file(directory / name, content);
    written.files.push_back(directory / name);
  };
  {
    const Work::Phase phase(work, "output");
    if (parameters.wants(OutputFile::contact))
      add("contact.csv", contact_csv(to_lengths(solution.result, scene.unit)));
    if (parameters.wants(OutputFile::parameters)) {
      std::ostringstream text;
      write_parameters(text, parameters);
      add("parameters.prm", text.str());
    }
    if (parameters.wants(OutputFile::solution)) {
      AtomicFile file(directory / "solution.vtu");
      // The format's numbers have single precision.
      const bool fits = 1e-25 < b && b < 1e35;
      write_solution_vtu(file.stream(), solution, fits ? scene.unit : 1 / scene.outer_radius);
      if (!fits)
        written.remarks.push_back("solution.vtu gives lengths over the outer radius, since they "
                                  "leave the range of single precision");
      work.bytes_written += file.commit();
      written.files.push_back(directory / "solution.vtu");
    }
    const auto add_picture = [&](const std::string& name, const std::optional<std::string>& svg) {
      if (svg)
        add(name, *svg);
      else
        written.remarks.push_back(name + " was not drawn: gnuplot is missing or has failed");
    };
    if (parameters.wants(OutputFile::plot))
      add_picture("scene.svg", plot_scene(scene, parameters, solution.result));
    if (parameters.wants(OutputFile::mesh))
      add_picture("mesh.svg", plot_mesh(scene, solution));
  }
  if (parameters.wants(OutputFile::summary))
    add("summary.json", summary_json(scene, parameters, to_lengths(solution.result, scene.unit)));
  return written;
}

} // namespace rollwave
