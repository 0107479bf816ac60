#include "rollwave/output/verification_report.h"

#include "rollwave/output/screen_report.h"

#include <deal.II/base/table_handler.h>

#include <ostream>
#include <sstream>

namespace rollwave {

using namespace dealii;

void report_verification(std::ostream& out, const Scene& scene, const Result& result,
                         const ExactSolution& exact) {
  const Units& units = scene.units;
  TableHandler table;
  const auto add = [&](const std::string& name, Quantity quantity, double ours, double theirs,
                       double accuracy) {
    const double unit = units.of(quantity);
    const auto number = [](double value, int digits) {
      std::ostringstream text;
      text.precision(digits);
      text << value + 0.; // no -0
      return text.str();
    };
    table.add_value("quantity", name + units.in_brackets(quantity));
    table.add_value("computed", number(ours * unit, 12));
    table.add_value("exact", number(theirs * unit, 12));
    table.add_value("difference", number((ours - theirs) * unit, 3));
    table.add_value("relative", theirs == 0 ? "-" : number(ours / theirs - 1, 3));
    table.add_value("exact to", accuracy > 0 ? number(accuracy, 1) : "-");
  };
  add("force F", Quantity::force, result.patch.force, exact.force, exact.force_accuracy);
  add("vertical load", Quantity::force, result.patch.vertical_load, exact.vertical_load,
      exact.force_accuracy);
  add("work-conjugate load G", Quantity::force, result.patch.work_conjugate_load,
      exact.work_conjugate_load, exact.force_accuracy);
  add("energy J", Quantity::energy, result.energy.value, exact.energy, exact.energy_accuracy);
  add("a(u, u)", Quantity::energy, result.energy.norm_squared, exact.norm_squared, 0);
  add("half-width / rad", Quantity::number, result.patch.half_width(), exact.half_width,
      exact.half_width_accuracy);
  add("peak pressure", Quantity::pressure, result.patch.peak_pressure, exact.peak_pressure, 0);
  if (result.errors && result.errors->exact_distance)
    add("distance c", Quantity::length, result.road_distance, *result.errors->exact_distance,
        1e-10);
  out << "\nVerification against the semi-analytic solution\n";
  print_table(out, table);
  if (!exact.ends_resolved)
    out << "Note: near the critical speed the exact pressure is not resolved at its ends; F and J "
           "are.\n";
  if (const auto errors = in_users_units(result, units).errors) {
    out << "Error in the energy norm ";
    if (errors->is_resolved)
      out << errors->energy_norm << units.after(Quantity::energy_norm) << ", relative "
          << errors->relative_energy_norm;
    else
      out << "too small for the exact answer to tell";
    out << "; in L2 " << errors->l2_norm << units.after(Quantity::area)
        << ", of the pressure in L2 " << errors->pressure << '\n';
  }
}

} // namespace rollwave
