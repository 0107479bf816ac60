#pragma once

#include "rollwave/run/result_quantity.h"

namespace rollwave {

/// Energies, their guaranteed bounds, and errors: guaranteed, and against the exact solution.
Quantities error_quantities();

} // namespace rollwave
