#pragma once

#include "rollwave/run/result.h"
#include "rollwave/scene/units.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rollwave {

/// How a quantity is shown outside of summary.json and study.csv, which have every quantity. A
/// quantity may have several of these flags.
struct Shown {
  enum : unsigned int {
    screen = 1,       ///< the report of a single run
    table = 2,        ///< study.txt and study.tex where keys of mesh or method vary
    orders = 4,       ///< the orders of convergence of a study
    curve = 8,        ///< study-curves.svg
    scene_table = 16, ///< study.txt and study.tex where only keys of the scene vary
    tables = table | scene_table,
    upper_bound = 32 ///< rounded up where it is shown
  };
};

/// One number of a result.
struct ResultQuantity {
  std::string name;   ///< in summary.json, where a dot leads into an object, and in study.csv
  std::string words;  ///< such as "contact force"
  std::string symbol; ///< such as "F", the head of a column in tables; may be empty
  Quantity quantity;
  unsigned int shown;  ///< flags of Shown
  unsigned int digits; ///< significant ones on the screen and in tables

  /// The number in the units of the scene; nullopt if it is not known, such as an end without
  /// contact.
  std::function<std::optional<double>(const Result&)> value;

  /// The same in the user's units; nullopt also for a bound that is infinite. It is null in
  /// summary.json and an empty field in study.csv.
  std::optional<double> in_users_units(const Result& result, const Units& units) const;

  /// @p number with its digits, or with those that the estimate of its error leaves.
  std::string text(double number, std::optional<double> uncertainty = {}) const;
};

using Quantities = std::vector<ResultQuantity>;

constexpr unsigned int all_digits = 9;

/// A number of an optional part of a result; nullopt without that part.
template <typename Owner, typename Part>
auto optional_member(std::optional<Part> Owner::*part, double Part::*number) {
  return [part, number](const Result& result) {
    return result.*part ? std::optional((*(result.*part)).*number) : std::nullopt;
  };
}

/// The same where the number is optional too.
template <typename Owner, typename Part>
auto optional_member(std::optional<Part> Owner::*part, std::optional<double> Part::*number) {
  return [part, number](const Result& result) {
    return result.*part ? (*(result.*part)).*number : std::nullopt;
  };
}

} // namespace rollwave
