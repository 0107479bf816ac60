#ifndef ROLLWAVE_BASE_VERSION_H
#define ROLLWAVE_BASE_VERSION_H

#include <string>

namespace rollwave {

/// "Rollwave X.Y.Z (deal.II A.B.C)".
std::string version_text();

} // namespace rollwave

#endif
