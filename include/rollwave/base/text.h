#ifndef ROLLWAVE_BASE_TEXT_H
#define ROLLWAVE_BASE_TEXT_H

#include <string>
#include <vector>

namespace rollwave {

/// @p text for a message: at most 150 bytes of it; control characters, and in UTF-8 punctuation
/// that looks like a blank or a minus sign, are named by their bytes, as in C2 A0 (in hexadecimal
/// digits).
std::string printable(const std::string& text);

/// printable(text) in quotation marks.
std::string in_quotes(const std::string& text);

/// @p text without white space at both ends.
std::string trimmed(const std::string& text);

/// The parts of @p text between the separators, trimmed; none for an empty text.
std::vector<std::string> split(const std::string& text, char separator);

/// Whether two texts differ at most in ASCII letters being upper or lower case.
bool is_equal_but_for_case(const std::string& one, const std::string& other);

/// @p text as a finite number, in the C locale; subnormal numbers are refused as well.
/// @throws std::invalid_argument when it is none, with the reason where that can be told.
double to_number(const std::string& text);

/// @p text as a whole number from @p least to @p most. @throws std::invalid_argument otherwise.
unsigned int to_count(const std::string& text, unsigned int least, unsigned int most);

/// @p number with at most this number of digits.
std::string rounded(double number, int digits);

/// The shortest text that is read back as @p number.
std::string shortest_text(double number);

/// @p text as TeX sets it.
std::string in_tex(const std::string& text);

} // namespace rollwave

#endif
