#pragma once

#include <string>

namespace rollwave {

/// @p text as a field of a line of CSV (RFC 4180): in quotation marks where it needs them, with
/// blanks for ends of lines.
std::string csv_field(std::string text);

} // namespace rollwave
