#include "rollwave/run/error_quantities.h"

#include <cmath>

namespace rollwave {

namespace {

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
       Quantity::length, 0, 3, optional_member(&Result::certified, &CertifiedError::sampled_width)},
  };
}

/// Errors against the exact solution.
Quantities true_error_quantities() {
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
      {"error.exact_distance", "true error of the distance for a given load or nip", "error of c",
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

} // namespace

Quantities error_quantities() {
  Quantities all = energy_quantities();
  for (ResultQuantity& quantity : true_error_quantities())
    all.push_back(std::move(quantity));
  return all;
}

} // namespace rollwave
