#pragma once

#include <string>

namespace rollwave {

/// "Rollwave X.Y.Z (deal.II A.B.C)".
std::string version_text();

/// A digest of @p text, of version_text() and of the bytes of the running program: it differs if
/// any of them does.
std::string digest_with_build(const std::string& text);

} // namespace rollwave
