#pragma once

#include <string>
#include <vector>

namespace rollwave {

/// @p text as a field of a line of CSV (RFC 4180): in quotation marks where it needs them, with
/// blanks for ends of lines.
std::string csv_field(std::string text);

/// The fields of a line; none if a quotation mark is missing.
std::vector<std::string> csv_fields(const std::string& line);

} // namespace rollwave
