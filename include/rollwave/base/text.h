#ifndef ROLLWAVE_BASE_TEXT_H
#define ROLLWAVE_BASE_TEXT_H

#include <string>
#include <vector>

namespace rollwave {

/// @p text for a message: at most 200 bytes of it, without the control characters by which a file
/// of another kind would disturb a terminal.
std::string printable(const std::string& text);

/// printable(text) in quotation marks.
std::string in_quotes(const std::string& text);

/// @p text without white space at both ends.
std::string trimmed(const std::string& text);

/// The parts of @p text between the separators, trimmed; none for an empty text.
std::vector<std::string> split(const std::string& text, char separator);

/// @p text as a finite number, in the C locale; subnormal numbers are refused as well.
/// @throws std::invalid_argument when it is none.
double to_number(const std::string& text);

/// @p text as a whole number from @p least to @p most. @throws std::invalid_argument otherwise.
unsigned int to_count(const std::string& text, unsigned int least, unsigned int most);

/// The shortest text that is read back as @p number.
std::string shortest_text(double number);

/// @p text as TeX sets it.
std::string in_tex(const std::string& text);

} // namespace rollwave

#endif
