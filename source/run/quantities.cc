#include "rollwave/run/quantities.h"

#include "rollwave/base/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <stdexcept>

namespace rollwave {

namespace {

using Quantities = std::vector<ResultQuantity>;

constexpr unsigned int all_digits = 9;
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// A number of an optional part of a result; nullopt without that part.
template <typename Part>
auto optional_member(std::optional<Part> Result::*part, double Part::*number) {
  return [part, number](const Result& result) {
    return result.*part ? std::optional((*(result.*part)).*number) : std::nullopt;
  };
}

/// The same where the number is optional too.
template <typename Part>
auto optional_member(std::optional<Part> Result::*part, std::optional<double> Part::*number) {
  return [part, number](const Result& result) {
    return result.*part ? (*(result.*part)).*number : std::nullopt;
  };
}

/// An end of the guaranteed interval of a load; nullopt without certificate.
auto load_bound(Interval LoadBounds::*load, double Interval::*end) {
  return [load, end](const Result& result) {
    return result.certified ? std::optional(result.certified->loads.*load.*end) : std::nullopt;
  };
}

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

Quantities load_quantities() {
  const auto stiffness_of = [](double (*number)(const Loads&)) {
    return [number](const Result& r) {
      return r.contact.stiffness ? number(*r.contact.stiffness) : not_known;
    };
  };
  return {
      {"contact.vertical_load", "vertical load", "", Quantity::force,
       Shown::screen | Shown::curve | Shown::scene_table, all_digits,
       [](const Result& r) { return r.contact.loads.vertical; }},
      {"contact.vertical_load_lower_bound", "guaranteed lower bound of the vertical load", "",
       Quantity::force, 0, all_digits, load_bound(&LoadBounds::vertical, &Interval::lower)},
      {"contact.vertical_load_upper_bound", "guaranteed upper bound of the vertical load", "",
       Quantity::force, 0, all_digits, load_bound(&LoadBounds::vertical, &Interval::upper)},
      {"contact.length", "contact length (nip)", "", Quantity::length,
       Shown::screen | Shown::curve | Shown::scene_table, 5,
       [](const Result& r) { return r.contact.length(); }},
      {"contact.calibrated_shear_modulus", "calibrated shear modulus", "", Quantity::pressure, 0,
       all_digits,
       [](const Result& r) { return r.modulus_ratio ? std::optional(1.) : std::nullopt; }},
      {"contact.force", "contact force", "F", Quantity::force,
       Shown::screen | Shown::table | Shown::curve, all_digits,
       [](const Result& r) { return r.contact.loads.total; }},
      {"contact.force_lower_bound", "guaranteed lower bound of F", "", Quantity::force, 0,
       all_digits, load_bound(&LoadBounds::total, &Interval::lower)},
      {"contact.force_upper_bound", "guaranteed upper bound of F", "", Quantity::force, 0,
       all_digits, load_bound(&LoadBounds::total, &Interval::upper)},
      {"contact.work_conjugate_load", "work-conjugate load", "G", Quantity::force, Shown::screen,
       all_digits,
       [](const Result& r) { return r.contact.loads.work_conjugate.value_or(not_known); }},
      {"contact.stiffness.vertical_load", "vertical stiffness", "", Quantity::stiffness,
       Shown::screen | Shown::curve | Shown::scene_table, 4,
       stiffness_of([](const Loads& stiffness) { return stiffness.vertical; })},
      {"contact.stiffness.force", "stiffness -dF/dc", "", Quantity::stiffness, 0, 4,
       stiffness_of([](const Loads& stiffness) { return stiffness.total; })},
      {"contact.stiffness.work_conjugate_load", "stiffness -dG/dc", "", Quantity::stiffness, 0, 4,
       stiffness_of([](const Loads& stiffness) { return *stiffness.work_conjugate; })},
  };
}

Quantities contact_quantities() {
  return {
      {"contact.peak_pressure", "peak pressure", "", Quantity::pressure,
       Shown::screen | Shown::curve | Shown::scene_table, 5,
       [](const Result& r) { return r.contact.peak_pressure; }},
      {"contact.half_width", "half-width of contact", "", Quantity::angle, Shown::curve, all_digits,
       [](const Result& r) {
         return r.contact.patches.size() < 2 ? r.contact.half_width() : not_known;
       }},
      {"contact.left_end", "left end of the first patch", "", Quantity::angle, 0, all_digits,
       [](const Result& r) { return r.contact.ends ? r.contact.ends->first : not_known; }},
      {"contact.right_end", "right end of the last patch", "", Quantity::angle, 0, all_digits,
       [](const Result& r) { return r.contact.ends ? r.contact.ends->second : not_known; }},
      {"contact.patch_count", "patches", "", Quantity::count, 0, all_digits,
       [](const Result& r) { return r.contact.patches.size(); }},
      {"contact.active_nodes", "nodes in contact", "", Quantity::count, 0, all_digits,
       [](const Result& r) { return r.contact.active_nodes; }},
  };
}

Quantities energy_quantities() {
  return {
      {"energy.value", "energy J(u_h)", "J", Quantity::energy, Shown::screen, all_digits,
       [](const Result& r) { return r.energy.value; }},
      {"energy.norm_squared", "a(u_h, u_h)", "", Quantity::energy, 0, all_digits,
       [](const Result& r) { return r.energy.norm_squared; }},
      {"energy.lower_bound", "guaranteed lower bound of J(u)", "", Quantity::energy, 0, all_digits,
       optional_member(&Result::certified, &CertifiedError::lower_bound)},
      {"energy.upper_bound", "guaranteed upper bound of J(u)", "", Quantity::energy, 0, all_digits,
       optional_member(&Result::certified, &CertifiedError::upper_bound)},
      {"error.certified_energy_norm", "guaranteed bound of the error in the energy norm", "",
       Quantity::energy_norm, 0, 3,
       optional_member(&Result::certified, &CertifiedError::energy_norm)},
      {"error.certified_relative", "guaranteed bound of the relative error", "certified",
       Quantity::number, Shown::tables | Shown::orders | Shown::upper_bound, 3,
       optional_member(&Result::certified, &CertifiedError::relative)},
      {"error.force_data", "share of the force expression in the bound", "", Quantity::energy_norm,
       0, 3, optional_member(&Result::certified, &CertifiedError::force_data)},
      {"error.force_sampled_width", "width below which features of the force may be undetected", "",
       Quantity::length, 0, 3,
       [](const Result& r) -> std::optional<double> {
         if (!r.certified)
           return {};
         return r.certified->sampled_width > 0 ? r.certified->sampled_width : not_known;
       }},
  };
}

/// Errors against the exact solution.
Quantities error_quantities() {
  const auto if_resolved = [](auto number) {
    return [number](const Result& r) {
      return r.errors && r.errors->is_resolved ? number(r) : std::nullopt;
    };
  };
  return {
      {"error.exact_energy_norm", "true error in the energy norm", "", Quantity::energy_norm, 0, 3,
       if_resolved(optional_member(&Result::errors, &TrueErrors::energy_norm))},
      {"error.exact_relative", "true relative error in the energy norm", "error", Quantity::number,
       Shown::tables | Shown::orders, 3,
       if_resolved(optional_member(&Result::errors, &TrueErrors::relative_energy_norm))},
      {"error.exact_l2_norm", "true error in L2", "L2 norm", Quantity::area, Shown::orders, 3,
       optional_member(&Result::errors, &TrueErrors::l2_norm)},
      {"error.exact_h1_norm", "true error in the H1 norm", "H1 norm", Quantity::length,
       Shown::orders, 3, if_resolved(optional_member(&Result::errors, &TrueErrors::h1_norm))},
      {"error.exact_pressure", "true error of the pressure in the discrete L2 norm", "pressure",
       Quantity::pressure_norm, Shown::orders, 3,
       optional_member(&Result::errors, &TrueErrors::pressure)},
      {"error.exact_force", "true error of F", "error of F", Quantity::force, Shown::orders, 3,
       optional_member(&Result::errors, &TrueErrors::force)},
      {"error.exact_energy", "true error of J", "", Quantity::energy, 0, 3,
       optional_member(&Result::errors, &TrueErrors::energy)},
      {"error.exact_half_width", "true error of the half-width", "", Quantity::angle, 0, 3,
       optional_member(&Result::errors, &TrueErrors::half_width)},
      {"error.exact_distance", "true error of the distance for a given load", "error of c",
       Quantity::length, Shown::tables | Shown::orders, 3,
       [](const Result& r) -> std::optional<double> {
         if (!r.errors || !r.errors->exact_distance)
           return {};
         return std::abs(*r.errors->exact_distance - r.road_distance);
       }},
      {"error.effectivity", "guaranteed bound over true error in the energy norm", "",
       Quantity::number, 0, 3, optional_member(&Result::errors, &TrueErrors::effectivity)},
      {"error.expected_order", "expected order of the energy norm in unknowns^(-1/2)", "",
       Quantity::number, 0, 3, optional_member(&Result::errors, &TrueErrors::expected_order)},
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
  const std::optional<double> number = value(result);
  return number ? std::optional(*number * units.of(quantity)) : std::nullopt;
}

std::string ResultQuantity::text(double number) const {
  return shown & Shown::upper_bound ? rounded_up(number, digits) : rounded(number, digits);
}

const std::vector<ResultQuantity>& result_quantities() {
  static const Quantities all = [] {
    Quantities quantities;
    for (const Quantities& some :
         {mesh_quantities(), load_quantities(), contact_quantities(), energy_quantities(),
          error_quantities(), residual_quantities(), work_quantities()})
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

std::optional<Interval> guaranteed_interval(const std::string& name, const Result& result,
                                            const Units& units) {
  const auto end = [&](const char* which) -> std::optional<double> {
    for (const ResultQuantity& quantity : result_quantities())
      if (quantity.name == name + which)
        return quantity.in_users_units(result, units);
    return {};
  };
  const auto lower = end("_lower_bound"), upper = end("_upper_bound");
  return lower && upper && std::isfinite(*upper - *lower) ? std::optional(Interval{*lower, *upper})
                                                          : std::nullopt;
}

} // namespace rollwave
