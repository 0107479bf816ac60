#include "rollwave/output/screen_report.h"

#include "rollwave/base/text.h"
#include "rollwave/base/version.h"
#include "rollwave/run/quantities.h"
#include "rollwave/scene/units.h"

#include <boost/algorithm/string/predicate.hpp>
#include <deal.II/base/table_handler.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <optional>
#include <ostream>
#include <tuple>

namespace rollwave {

using namespace dealii;

namespace {

/// The search for the distance of a given load or nip.
void report_distances(std::ostream& out, const std::vector<DistanceStep>& history,
                      const Units& units) {
  const std::string distance = "distance c" + units.in_brackets(Quantity::length),
                    load = "load" + units.in_brackets(Quantity::force),
                    nip = "nip" + units.in_brackets(Quantity::length);
  TableHandler table;
  for (unsigned int step = 0; step < history.size(); ++step) {
    table.add_value("step", step + 1);
    table.add_value(distance, rounded(history[step].distance * units.of(Quantity::length), 9));
    table.add_value(load, rounded(history[step].load * units.of(Quantity::force), 9));
    table.add_value(nip, rounded(history[step].nip * units.of(Quantity::length), 9));
    table.add_value("contact steps", history[step].contact_steps);
  }
  out << "\nDistance steps\n" << table_text(table);
}

/// A longer history is printed without its middle.
constexpr unsigned int most_lines = 40;

void report_history(std::ostream& out, const Result& result, const Units& units) {
  out << "\nContact steps";
  if (result.step_length)
    out << " by Uzawa's method, rho = "
        << result.step_length->rho * units.of(Quantity::force_density)
        << units.after(Quantity::force_density);
  else
    out << " by the active set method";
  out << '\n';
  const std::vector<ContactStep>& history = result.history;
  const double length = units.of(Quantity::length), pressure = units.of(Quantity::pressure);
  const std::string penetration = "penetration" + units.in_brackets(Quantity::length),
                    lowest_pressure = "lowest pressure" + units.in_brackets(Quantity::pressure);
  TableHandler table;
  for (unsigned int step = 0; step < history.size(); ++step) {
    if (history.size() > most_lines && step >= most_lines / 2 &&
        step < history.size() - most_lines / 2)
      continue;
    table.add_value("step", step + 1);
    table.add_value("active", history[step].active);
    table.add_value("changed", history[step].changed);
    table.add_value(penetration, history[step].penetration * length);
    table.add_value(lowest_pressure, history[step].lowest_pressure * pressure);
    if (history[step].residual)
      table.add_value("residual", *history[step].residual);
  }
  std::vector<std::string> columns = {penetration, lowest_pressure};
  if (result.step_length)
    columns.push_back("residual");
  for (const std::string& column : columns) {
    table.set_precision(column, 3);
    table.set_scientific(column, true);
  }
  out << table_text(table);
  if (history.size() > most_lines)
    out << "... steps " << most_lines / 2 + 1 << " to " << history.size() - most_lines / 2
        << " left out\n";
}

/// The first file with one of these endings; empty without one.
std::string first_file(const WrittenFiles& written, const std::vector<std::string>& endings) {
  for (const auto& file : written.files)
    for (const std::string& ending : endings)
      if (boost::algorithm::ends_with(file.string(), ending))
        return file.string();
  return "";
}

void report_certificate(std::ostream& out, const Result& result, const Units& units) {
  const CertifiedError& certified = *result.certified;
  if (!std::isfinite(certified.energy_norm)) {
    out << "Certified  no error bound; see the notes\n";
    return;
  }
  const auto range = [&](const char* what, double lower, double upper, Quantity quantity) {
    const double unit = units.of(quantity);
    out << what << rounded_down(lower * unit, 9) << " to " << rounded_up(upper * unit, 9)
        << units.after(quantity);
  };
  range("Certified  J(u) from ", certified.lower_bound, certified.upper_bound, Quantity::energy);
  out << "\n           error in the energy norm at most "
      << rounded_up(certified.energy_norm * units.of(Quantity::energy_norm), 3)
      << units.after(Quantity::energy_norm) << ", "
      << (std::isfinite(certified.relative) ? "relative " + rounded_up(certified.relative, 3)
                                            : std::string("no relative bound"))
      << "\n           (of the displacement u_h; for the other numbers see Accuracy in "
         "doc/manual.md)\n";
  if (units.material.is_given())
    out << "           (of the model; for its modulus see Material in doc/manual.md)\n";
  const double outside = std::max(certified.lower_bound - result.energy.value,
                                  result.energy.value - certified.upper_bound);
  if (outside > 0)
    out << "           J(u_h) is " << rounded(outside * units.of(Quantity::energy), 2)
        << units.after(Quantity::energy)
        << " outside of these bounds, which hold for the exact J(u)\n";
  if (certified.sampled_width)
    out << "           features of the force smaller than "
        << *certified.sampled_width * units.of(Quantity::length) << units.after(Quantity::length)
        << " may be undetected\n";
}

void report_patches(std::ostream& out, const ContactResultants& contact, const Units& units) {
  if (contact.patches.empty())
    out << "  no contact\n";
  if (contact.patches.size() > 1)
    out << "  contact in " << contact.patches.size() << " patches, " << contact.active_nodes
        << " nodes\n";
  for (const ContactPatch& patch : contact.patches) {
    out << "  contact from " << with_uncertainty(patch.begin, patch.begin_uncertainty) << " to "
        << with_uncertainty(patch.end, patch.end_uncertainty) << " rad, half-width "
        << with_uncertainty(patch.half_width(), patch.half_width_uncertainty()) << " rad";
    if (contact.patches.size() > 1)
      out << ",\n    on "
          << with_uncertainty(patch.length * units.of(Quantity::length),
                              patch.length_uncertainty * units.of(Quantity::length))
          << units.after(Quantity::length) << " of the road, force "
          << rounded(patch.force * units.of(Quantity::force), 9) << units.after(Quantity::force);
    out << '\n';
  }
}

/// The ends, rounded outwards to two digits of their distance.
std::string interval_text(const Interval& interval) {
  const auto place = [](double number) { return std::floor(std::log10(std::abs(number))); };
  const double width = interval.upper - interval.lower;
  constexpr int most_digits = 17;
  const auto digits = [&](double end) {
    return width > 0 && end != 0
               ? int(std::clamp(place(end) - place(width) + 2, 2., 1. * most_digits))
               : most_digits;
  };
  return rounded_down(interval.lower, digits(interval.lower)) + " to " +
         rounded_up(interval.upper, digits(interval.upper));
}

void report_quantities(std::ostream& out, const Result& result, const Units& units) {
  constexpr unsigned int width = 32; // of words and symbol
  const auto values = values_of(result, units);
  const auto number = [&](const std::string& name) {
    const auto known = values.find(name);
    return known != values.end() ? std::optional(known->second) : std::nullopt;
  };
  for (const ResultQuantity& quantity : result_quantities()) {
    const auto value = number(quantity.name);
    if (!(quantity.shown & Shown::screen) || !value)
      continue;
    const double uncertainty = number(quantity.name + "_uncertainty").value_or(0);
    const std::string text =
        uncertainty > 0 ? with_uncertainty(*value, uncertainty) : quantity.text(*value);
    const std::string symbol = quantity.symbol.empty() ? "   " : quantity.symbol + " =";
    out << "  " << std::left << std::setw(width - symbol.size()) << quantity.words << symbol << ' '
        << text << units.after(quantity.quantity);
    const auto lower = number(quantity.name + "_lower_bound"),
               upper = number(quantity.name + "_upper_bound");
    if (lower && upper)
      out << "   guaranteed " << interval_text({*lower, *upper});
    out << '\n';
  }
}

void report_residuals(std::ostream& out, const Result& result) {
  std::string separator = "Residuals  ";
  for (const ResultQuantity& quantity : result_quantities())
    if (quantity.name.rfind("residuals.", 0) == 0) {
      out << separator << quantity.words << ' '
          << rounded(*quantity.value(result), quantity.digits);
      separator = ", ";
    }
  out << '\n';
}

} // namespace

void report_scene(std::ostream& out, const Scene& scene, const Parameters& parameters) {
  const auto& [cylinder, road, material] =
      std::tie(parameters.cylinder, parameters.road, parameters.material);
  const auto unit = [&scene](Quantity quantity) { return scene.units.after(quantity); };
  const std::string length = unit(Quantity::length);
  const double of_critical = scene.angular_velocity * scene.outer_radius;
  out << version_text() << '\n'
      << "Cylinder   a = " << cylinder.inner_radius << length << ", b = " << cylinder.outer_radius
      << length << ", omega = " << cylinder.angular_velocity << unit(Quantity::angular_velocity);
  if (material.is_given())
    out << " (" << of_critical << " of the critical speed), f = ";
  else
    out << " (omega b = " << of_critical << "), f = ";
  out << cylinder.radial_force << '\n';
  if (material.is_given())
    out << "Material   mu = " << material.shear_modulus << unit(Quantity::pressure)
        << ", rho = " << material.density << unit(Quantity::density)
        << ", width = " << material.width << length << ", critical speed "
        << material.wave_speed() / cylinder.outer_radius << unit(Quantity::angular_velocity)
        << '\n';
  out << "Road       ";
  if (road.has_distance())
    out << "distance " << road.distance << length;
  if (road.load)
    out << "load " << *road.load << unit(Quantity::force);
  if (road.nip)
    out << (road.load ? ", nip " : "nip ") << *road.nip << length;
  if (road.curvature != 0)
    out << ", curvature " << road.curvature;
  out << ", zone of possible contact [" << scene.zone_begin << ", " << scene.zone_end << "] rad\n"
      << std::flush;
}

void report_result(std::ostream& out, const Result& result, const Units& units) {
  const MeshFigures& mesh = result.mesh;
  const double length = units.of(Quantity::length);
  out << "Mesh       Q" << mesh.degree << ", " << mesh.n_cells << " cells, " << mesh.n_unknowns
      << " unknowns, " << mesh.n_contact_nodes << " contact nodes, cell diameters from "
      << mesh.h_min * length << " to " << mesh.h_max * length << units.after(Quantity::length)
      << '\n';
  if (!result.distance_history.empty())
    report_distances(out, result.distance_history, units);
  // The last distance step has found the contact already.
  if (result.distance_history.empty() || result.history.size() > 1)
    report_history(out, result, units);
  for (const std::string& remark : texts_of(result.notes, Note::Kind::remark))
    out << "Note: " << remark << '\n';
  out << "\nResult\n";
  report_patches(out, result.contact, units);
  report_quantities(out, result, units);
  if (result.modulus_ratio) {
    const double modulus = units.of(Quantity::pressure);
    out << "Calibrated shear modulus " << rounded(modulus, 4) << units.after(Quantity::pressure)
        << " (given " << rounded(modulus / *result.modulus_ratio, 4)
        << "): write it into Material, with the density " << rounded(units.material.density, 4)
        << '\n';
  }
  if (result.certified)
    report_certificate(out, result, units);
  if (const std::string missed = shortfall_text(result.notes); !missed.empty())
    out << "Shortfall  " << missed << '\n';
  report_residuals(out, result);
}

void report_files(std::ostream& out, const WrittenFiles& written) {
  if (!written.files.empty())
    out << "\nFiles\n";
  for (const auto& file : written.files)
    out << "  " << file.string() << '\n';
  for (const Note& note : written.notes)
    out << "Note: " << note.text << '\n';
  if (const std::string picture = first_file(written, {".svg", ".png", ".pdf"}); !picture.empty()) {
    const std::string field = first_file(written, {"study.pvd", "solution.vtu"}); // one of them
    out << "Look first at " << picture << (field.empty() ? "" : "; in ParaView open ") << field
        << '\n';
  }
}

void report_end(std::ostream& out, const RunStatistics& statistics, const WrittenFiles& written) {
  const auto print = [&out](const std::string& name, double seconds) {
    out << "  " << std::left << std::setw(20) << name << std::right << std::setw(9) << seconds
        << '\n';
  };
  out << "\nSeconds\n" << std::fixed << std::setprecision(3);
  const double phases = statistics.total_seconds(), total = std::max(phases, seconds_of_process());
  print("start-up and other", total - phases);
  for (const std::string& phase : RunStatistics::phase_names())
    if (const auto seconds = statistics.seconds(phase))
      print(phase, *seconds);
  print("total of the process", total);
  out << std::defaultfloat << std::setprecision(6);
  report_files(out, written);
}

} // namespace rollwave
