#include "rollwave/run/quantities.h"

#include "rollwave/base/text.h"
#include "rollwave/run/contact_quantities.h"
#include "rollwave/run/error_quantities.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rollwave {

namespace {

Quantities mesh_quantities() {
  return {
      {"scene.road_distance", "road distance", "c", Quantity::length, Shown::screen, all_digits,
       [](const Result& r) { return r.road_distance; }},
      {"scene.deflection", "deflection", "b - c", Quantity::length,
       Shown::screen | Shown::scene_table, all_digits,
       [](const Result& r) { return r.deflection; }},
      {"scene.relative_deflection", "deflection over thickness", "", Quantity::number,
       Shown::screen, 3, [](const Result& r) { return r.relative_deflection; }},
      {"mesh.degree", "degree of the elements", "", Quantity::count, 0, all_digits,
       [](const Result& r) { return r.mesh.degree; }},
      {"mesh.cells", "cells", "", Quantity::count, 0, all_digits,
       [](const Result& r) { return r.mesh.n_cells; }},
      {"mesh.dofs", "unknowns", "unknowns", Quantity::count, Shown::table, all_digits,
       [](const Result& r) { return r.mesh.n_unknowns; }},
      {"mesh.contact_nodes", "nodes in the zone of possible contact", "", Quantity::count, 0,
       all_digits, [](const Result& r) { return r.mesh.n_contact_nodes; }},
      {"mesh.h_min", "smallest diameter of a cell in (r, b z)", "", Quantity::length, 0, all_digits,
       [](const Result& r) { return r.mesh.h_min; }},
      {"mesh.h_max", "h, the largest diameter of a cell in (r, b z)", "", Quantity::length, 0,
       all_digits, [](const Result& r) { return r.mesh.h_max; }},
  };
}

Quantities residual_quantities() {
  return {
      {"residuals.equilibrium", "equilibrium", "", Quantity::number, 0, 2,
       [](const Result& r) { return r.residuals.equilibrium; }},
      {"residuals.penetration", "penetration", "", Quantity::number, 0, 2,
       [](const Result& r) { return r.residuals.penetration; }},
      {"residuals.negative_pressure", "negative pressure", "", Quantity::number, 0, 2,
       [](const Result& r) { return r.residuals.negative_pressure; }},
      {"residuals.complementarity", "complementarity", "", Quantity::number, 0, 2,
       [](const Result& r) { return r.residuals.complementarity; }},
  };
}

Quantities work_quantities() {
  Quantities all = {
      {"iterations.meshes", "meshes", "", Quantity::count, 0, all_digits,
       [](const Result& r) { return r.cycles.size(); }},
      {"iterations.contact", "contact steps on the last mesh", "steps", Quantity::count,
       Shown::table, all_digits, [](const Result& r) { return r.history.size(); }},
      {"iterations.rho", "step length of Uzawa's method", "", Quantity::force_density, 0,
       all_digits, optional_member(&Result::step_length, &StepLength::rho)},
      {"iterations.safe_rho", "step length below which Uzawa's method converges from any start", "",
       Quantity::force_density, 0, all_digits,
       optional_member(&Result::step_length, &StepLength::safe)},
      {"iterations.largest_rho", "step length from which Uzawa's method diverges", "",
       Quantity::force_density, 0, all_digits,
       optional_member(&Result::step_length, &StepLength::largest)},
  };
  const auto add_count = [&all](const std::string& name, const std::string& words, auto count) {
    all.push_back({"work." + name, words, "", Quantity::count, 0, all_digits,
                   [count](const Result& r) { return r.statistics.*count; }});
  };
  add_count("load_assemblies", "assemblies of the load", &RunStatistics::load_assemblies);
  add_count("stiffness_assemblies", "assemblies of the stiffness",
            &RunStatistics::stiffness_assemblies);
  add_count("orderings", "symbolic analyses of sparse matrices", &RunStatistics::orderings);
  add_count("factorisations", "factorisations of sparse matrices", &RunStatistics::factorisations);
  add_count("dense_factorisations", "factorisations of dense matrices",
            &RunStatistics::dense_factorisations);
  add_count("sparse_solves", "solutions with a factor of a sparse matrix",
            &RunStatistics::sparse_solves);
  add_count("bytes_written", "bytes written before summary.json and pictures",
            &RunStatistics::bytes_written);
  for (const std::string& phase : RunStatistics::phase_names())
    all.push_back({"seconds." + phase, "seconds of the phase " + phase, "", Quantity::number, 0, 3,
                   [phase](const Result& r) { return r.statistics.seconds(phase); }});
  all.push_back({"seconds.total", "seconds", "seconds", Quantity::number, Shown::tables, 3,
                 [](const Result& r) { return r.statistics.total_seconds(); }});
  all.push_back({"peak_memory_mib", "largest memory of a process in MiB", "", Quantity::number, 0,
                 4, [](const Result& r) { return r.peak_memory_mib; }});
  return all;
}

} // namespace

std::optional<double> ResultQuantity::in_users_units(const Result& result,
                                                     const Units& units) const {
  std::optional<double> number = value(result);
  if (number)
    *number *= units.of(quantity);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::string ResultQuantity::text(double number, std::optional<double> uncertainty) const {
  if (uncertainty && *uncertainty > 0)
    return rounded_by(number, *uncertainty);
  return shown & Shown::upper_bound ? rounded_up(number, digits) : rounded(number, digits);
}

const Quantities& result_quantities() {
  static const Quantities all = [] {
    Quantities quantities;
    for (const Quantities& some : {mesh_quantities(), contact_quantities(), error_quantities(),
                                   residual_quantities(), work_quantities()})
      quantities.insert(quantities.end(), some.begin(), some.end());
    return quantities;
  }();
  return all;
}

const ResultQuantity& result_quantity(std::string_view name) {
  const auto& all = result_quantities();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [name](const auto& quantity) { return quantity.name == name; });
  if (found == all.end())
    throw std::out_of_range(std::string(name));
  return *found;
}

std::map<std::string, double> values_of(const Result& result, const Units& units) {
  std::map<std::string, double> values;
  for (const ResultQuantity& quantity : result_quantities())
    if (const auto value = quantity.in_users_units(result, units))
      values[quantity.name] = *value;
  return values;
}

} // namespace rollwave
