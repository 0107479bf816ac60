#include "rollwave/verify/verification_report.h"

#include "rollwave/base/text.h"
#include "rollwave/run/quantities.h"
#include "rollwave/scene/units.h"

#include <deal.II/base/table_handler.h>

#include <optional>
#include <ostream>
#include <string>

namespace rollwave {

using namespace dealii;

namespace {

/// The errors against the exact solution in norms.
void report_errors(std::ostream& out, const Result& result, const Units& units) {
  const auto print = [&](const std::string& name, const std::string& words) {
    const ResultQuantity& quantity = result_quantity(name);
    const auto value = quantity.in_users_units(result, units);
    out << words
        << (value ? rounded(*value, quantity.digits) + units.after(quantity.quantity)
                  : "below the accuracy of the reference solution");
  };
  print("error.exact_energy_norm", "Error in the energy norm ");
  if (result.errors->is_resolved)
    print("error.exact_relative", ", relative ");
  print("error.exact_l2_norm", "; in L2 ");
  print("error.exact_pressure", ", of the pressure in the discrete L2 norm ");
  out << '\n';
}

} // namespace

void report_verification(std::ostream& out, const Scene& scene, const Result& result,
                         const ExactSolution& exact, std::optional<double> exact_stiffness) {
  const Units& units = scene.units;
  const auto values = values_of(result, units);
  TableHandler table;
  const std::string exact_title = scene.has_distance() ? "exact" : "exact at this distance";
  const auto add = [&](const std::string& name, const std::string& words,
                       std::optional<double> exact_number, double accuracy) {
    const ResultQuantity& quantity = result_quantity(name);
    const auto computed = quantity.value(result);
    if (!computed || !exact_number)
      return;
    const double unit = units.of(quantity.quantity), ours = *computed, theirs = *exact_number;
    table.add_value("quantity", words + units.in_brackets(quantity.quantity));
    table.add_value("computed", rounded(ours * unit, 12));
    table.add_value(exact_title, rounded(theirs * unit, 12));
    table.add_value("difference", rounded((ours - theirs) * unit, 3));
    const auto estimate = values.find(name + "_uncertainty");
    table.add_value("estimated", estimate != values.end() ? rounded(estimate->second, 2) : "-");
    table.add_value("relative", theirs == 0 ? "-" : rounded(ours / theirs - 1, 3));
    table.add_value("accuracy of the reference", accuracy > 0 ? rounded(accuracy, 1) : "-");
  };
  add("contact.force", "force F", exact.loads.total, exact.force_accuracy);
  add("contact.vertical_load", "vertical load", exact.loads.vertical, exact.force_accuracy);
  add("contact.work_conjugate_load", "work-conjugate load G", exact.loads.work_conjugate,
      exact.force_accuracy);
  add("energy.value", "energy J", exact.energy, exact.energy_accuracy);
  add("energy.norm_squared", "a(u, u)", exact.norm_squared, 0);
  add("contact.half_width", "half-width", exact.half_width, exact.half_width_accuracy);
  add("contact.length", "contact length (nip)", 2 * scene.road.arc_length(exact.half_width),
      exact.half_width_accuracy);
  add("contact.peak_pressure", "peak pressure", exact.peak_pressure, 0);
  add("contact.stiffness.vertical_load", "vertical stiffness", exact_stiffness, 0);
  if (result.errors)
    add("scene.road_distance",
        std::string("distance c (exact: for the ") + (scene.nip ? "nip)" : "load)"),
        result.errors->exact_distance, 1e-10);
  out << "\nVerification against the semi-analytic solution";
  if (!scene.has_distance())
    out << " at the computed distance " << rounded(result.road_distance * units.length, 9)
        << units.after(Quantity::length);
  out << '\n';
  out << table_text(table);
  if (!exact.ends_resolved)
    out << "Note: near the critical speed the exact pressure is not resolved at its ends; F and J "
           "are.\n";
  if (result.errors)
    report_errors(out, result, units);
}

} // namespace rollwave
