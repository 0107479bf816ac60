#include "rollwave/output/screen_report.h"

#include "rollwave/base/version.h"

#include <deal.II/base/table_handler.h>

#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace rollwave {

using namespace dealii;

namespace {

/// A long history is told by its ends.
constexpr unsigned int most_lines = 40;

void report_history(std::ostream& out, const std::vector<ContactStep>& history) {
  TableHandler table;
  for (unsigned int step = 0; step < history.size(); ++step) {
    if (history.size() > most_lines && step >= most_lines / 2 &&
        step < history.size() - most_lines / 2)
      continue;
    table.add_value("step", step + 1);
    table.add_value("active", history[step].active);
    table.add_value("changed", history[step].changed);
    table.add_value("penetration", history[step].penetration);
    table.add_value("lowest pressure", history[step].lowest_pressure);
    table.add_value("residual", history[step].residual);
  }
  for (const char* const column : {"penetration", "lowest pressure", "residual"}) {
    table.set_precision(column, 3);
    table.set_scientific(column, true);
  }
  print_table(out, table);
}

void report_cycles(std::ostream& out, const std::vector<CycleFigures>& cycles) {
  TableHandler table;
  for (unsigned int i = 0; i < cycles.size(); ++i) {
    const auto number = [](bool exists, double value) {
      std::ostringstream text;
      text << std::setprecision(3) << value;
      return exists ? text.str() : std::string("-");
    };
    table.add_value("cycle", i + 1);
    table.add_value("cells", cycles[i].cells);
    table.add_value("unknowns", cycles[i].dofs);
    table.add_value("contact steps", cycles[i].contact_steps);
    table.add_value("indicated error", number(cycles[i].indicated > 0, cycles[i].indicated));
    table.add_value("certified, relative",
                    number(cycles[i].certified.has_value(), cycles[i].certified.value_or(0)));
  }
  out << "\nAdaptive refinement\n";
  print_table(out, table);
}

} // namespace

void print_table(std::ostream& out, const TableHandler& table) {
  // deal.II does not write to a stream that has failed, but throws.
  std::ostringstream text;
  table.write_text(text, TableHandler::table_with_headers);
  out << text.str();
}

void report_scene(std::ostream& out, const Scene& scene, const Parameters& parameters) {
  out << version_text() << '\n'
      << "Cylinder   a = " << parameters.cylinder.inner_radius
      << ", b = " << parameters.cylinder.outer_radius
      << ", omega = " << parameters.cylinder.angular_velocity
      << " (omega b = " << scene.angular_velocity * scene.outer_radius
      << "), f = " << parameters.cylinder.radial_force << '\n'
      << "Road       " << (scene.load ? "load " : "distance ")
      << parameters.road.load.value_or(parameters.road.distance);
  if (scene.road_curvature != 0)
    out << ", curvature " << parameters.road.curvature;
  out << ", zone of possible contact [" << scene.zone_begin << ", " << scene.zone_end << "] rad\n"
      << std::flush;
}

void report_result(std::ostream& out, const Result& result) {
  if (result.cycles.size() > 1)
    report_cycles(out, result.cycles);
  const MeshFigures& mesh = result.mesh;
  out << "Mesh       Q" << mesh.degree << ", " << mesh.cells << " cells, " << mesh.dofs
      << " unknowns, " << mesh.contact_nodes << " contact nodes, h from " << mesh.h_min << " to "
      << mesh.h_max << "\n\nContact steps";
  if (result.rho > 0)
    out << " by Uzawa's method, rho = " << result.rho;
  else
    out << " by the active set method";
  out << '\n';
  report_history(out, result.history);
  for (const std::string& remark : result.remarks)
    out << "Note: " << remark << '\n';

  const ContactResultants& contact = result.patch;
  out << "\nResult\n" << std::setprecision(9);
  out << "  road distance        c = " << result.road_distance << '\n';
  if (contact.patches.size() > 1)
    out << "  contact in " << contact.patches.size() << " patches, " << contact.active_nodes
        << " nodes\n";
  for (const ContactPatch& patch : contact.patches)
    out << "  contact from " << patch.begin << " to " << patch.end << " rad, half-width "
        << (patch.end - patch.begin) / 2 << " rad, on " << patch.length << " of the road, force "
        << patch.force << '\n';
  if (contact.patches.empty())
    out << "  no contact\n";
  out << "  contact force        F = " << contact.force << '\n'
      << "  vertical load            " << contact.vertical_load << '\n'
      << "  work-conjugate load  G = " << contact.work_conjugate_load << '\n'
      << "  peak pressure            " << contact.peak_pressure << '\n'
      << "  stiffness  -d(load)/dc   " << contact.stiffness.vertical << " (vertical)\n"
      << "  energy          J(u_h) = " << result.energy.value
      << ", a(u_h, u_h) = " << result.energy.norm_squared << '\n';
  if (result.certified) {
    const CertifiedError& certified = *result.certified;
    out << "Certified  J(u) from " << std::setprecision(9) << certified.lower_bound << " to "
        << certified.upper_bound << ", error in the energy norm at most " << std::setprecision(3)
        << certified.energy_norm << ", relative " << certified.relative << '\n';
    if (certified.sampled_width > 0)
      out << "           for the force as sampled: strips narrower than " << certified.sampled_width
          << " and spots smaller than a cell may be missed\n";
    if (result.load_bounds)
      out << "           G    from " << std::setprecision(9) << result.load_bounds->lower << " to "
          << result.load_bounds->upper << '\n';
    if (result.distance_bounds)
      out << "           c    from " << std::setprecision(9) << result.distance_bounds->lower
          << " to " << result.distance_bounds->upper << '\n';
  }
  if (!result.shortfalls.empty())
    out << "Shortfall  " << shortfall_text(result) << '\n';
  out << std::setprecision(2) << "Residuals  equilibrium " << result.residuals.equilibrium
      << ", penetration " << result.residuals.penetration << ", negative pressure "
      << result.residuals.negative_pressure << ", complementarity "
      << result.residuals.complementarity << "; rounding u makes " << result.residuals.round_off
      << '\n'
      << std::setprecision(6);
}

void report_files(std::ostream& out, const WrittenFiles& written) {
  if (!written.files.empty())
    out << "\nFiles\n";
  for (const auto& file : written.files) {
    constexpr double megabyte = 1e6, large = 100;
    std::error_code none; // which makes the size that of no file at all
    const double size = std::filesystem::file_size(file, none) / megabyte;
    out << "  " << file.string();
    if (size > large && !none)
      out << "  (" << std::lround(size) << " MB)";
    out << '\n';
  }
  for (const std::string& remark : written.remarks)
    out << "Note: " << remark << '\n';
}

void report_end(std::ostream& out, const Work& work, const WrittenFiles& written) {
  out << "\nSeconds\n" << std::fixed << std::setprecision(3);
  for (const auto& [phase, seconds] : work.seconds())
    out << "  " << std::left << std::setw(20) << phase << std::right << std::setw(9) << seconds
        << '\n';
  out << "  " << std::left << std::setw(20) << "total" << std::right << std::setw(9)
      << work.total_seconds() << '\n'
      << std::defaultfloat << std::setprecision(6);
  report_files(out, written);
}

} // namespace rollwave
