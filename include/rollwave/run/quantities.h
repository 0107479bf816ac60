#pragma once

#include "rollwave/run/result_quantity.h"
#include "rollwave/scene/loads.h"

#include <optional>
#include <string>
#include <string_view>

namespace rollwave {

/// All numbers of a result, in the order in which they are shown.
const Quantities& result_quantities();

/// The quantity of a name. @throws std::out_of_range
const ResultQuantity& result_quantity(std::string_view name);

/// The estimate of the error of a quantity in the user's units, by the quantity that ends in
/// _uncertainty; nullopt where there is none.
std::optional<double> uncertainty_of(const std::string& name, const Result& result,
                                     const Units& units);

/// The guaranteed interval of a quantity in the user's units, by the quantities that end in
/// _lower_bound and _upper_bound; nullopt where there are none.
std::optional<Interval> guaranteed_interval(const std::string& name, const Result& result,
                                            const Units& units);

} // namespace rollwave
