#pragma once

#include <string>

namespace rollwave {

/// "Rollwave X.Y.Z (deal.II A.B.C)".
std::string version_text();

} // namespace rollwave
