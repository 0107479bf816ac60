#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace dealii {
class TableHandler;
}

namespace rollwave {

/// @p text for a message: at most @p longest bytes of it, with ? for control characters.
std::string printable(const std::string& text, std::size_t longest = 150);

/// printable(text) in quotation marks.
std::string in_quotes(const std::string& text);

/// A remark on letters of @p text that are not seen; empty without any.
std::string hint_on_letters(const std::string& text);

/// @p text without white space at both ends.
std::string trimmed(const std::string& text);

/// The parts of @p text between the separators, trimmed; none for an empty text.
std::vector<std::string> split(const std::string& text, char separator);

/// The number of letters to insert or delete between two texts, regardless of case.
unsigned int edit_distance(const std::string& from, const std::string& to);

/// @p text as a finite number, in the C locale; subnormal numbers are refused as well.
/// @throws std::invalid_argument for other texts
double to_number(const std::string& text);

/// @p number with at most this number of digits.
std::string rounded(double number, int digits);

/// The same, but not below or not above the number, for bounds.
std::string rounded_up(double number, int digits);
std::string rounded_down(double number, int digits);

/// @p number without the digits that its @p uncertainty makes meaningless, such as 0.89 for 0.8937
/// and 0.053.
std::string rounded_by(double number, double uncertainty);

/// The same with the uncertainty, rounded up to one digit, or two where the first is a 1:
/// "0.89 +- 0.06", "0.894 +- 0.013".
std::string with_uncertainty(double number, double uncertainty);

/// The shortest text that is read back as @p number.
std::string shortest_text(double number);

/// The table as text with column heads. TableHandler::write_text() throws if its stream has failed;
/// printing this text does not.
std::string table_text(const dealii::TableHandler& table);

} // namespace rollwave
