#pragma once

#include "rollwave/run/result.h"
#include "rollwave/scene/units.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
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
    tables = 18,      ///< both tables
    upper_bound = 32  ///< rounded up where it is shown
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

  /// The number in the units of the scene: nullopt if the run was not asked for it, which leaves it
  /// out of summary.json; NaN if it is not known, such as an end without contact, which is null
  /// there. Both are empty fields in study.csv.
  std::function<std::optional<double>(const Result&)> value;

  std::optional<double> in_users_units(const Result& result, const Units& units) const;

  /// @p number with its digits.
  std::string text(double number) const;
};

/// All numbers of a result, in the order in which they are shown.
const std::vector<ResultQuantity>& result_quantities();

/// The quantity of a name. @throws std::out_of_range
const ResultQuantity& result_quantity(std::string_view name);

/// The guaranteed interval of a quantity in the user's units, by the quantities that end in
/// _lower_bound and _upper_bound; nullopt where these do not exist or are infinite.
std::optional<Interval> guaranteed_interval(const std::string& name, const Result& result,
                                            const Units& units);

} // namespace rollwave
