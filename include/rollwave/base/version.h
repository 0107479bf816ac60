#pragma once

#include <string>

namespace rollwave {

/// "Rollwave X.Y.Z (deal.II A.B.C)".
std::string version_text();

/// A digest of the program's sources, which CMake makes when it builds the program.
std::string source_digest();

/// A digest of @p text, of the program's sources, and of the releases of deal.II and CHOLMOD: it
/// differs if any of them does. It does not depend on where the program is, or on how it is linked.
std::string digest_with_program(const std::string& text);

} // namespace rollwave
