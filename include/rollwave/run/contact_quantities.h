#pragma once

#include "rollwave/run/result_quantity.h"

namespace rollwave {

/// Loads with their guaranteed intervals; stiffness, ends and pressure of contact with estimates of
/// their errors.
Quantities contact_quantities();

} // namespace rollwave
