#pragma once

#include "rollwave/run/result_quantity.h"

#include <map>
#include <string>
#include <string_view>

namespace rollwave {

/// All numbers of a result, in the order in which they are shown.
const Quantities& result_quantities();

/// The quantity of a name. @throws std::out_of_range
const ResultQuantity& result_quantity(std::string_view name);

/// The known quantities of a result by their names, in the user's units.
std::map<std::string, double> values_of(const Result& result, const Units& units);

} // namespace rollwave
