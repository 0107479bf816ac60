#include "rollwave/base/text.h"

#include <boost/algorithm/string.hpp>
#include <deal.II/base/table_handler.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace rollwave {

std::string printable(const std::string& text, std::size_t longest) {
  std::string shown = text.substr(0, longest);
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return std::iscntrl(c); }, '?');
  return shown + (text.size() > longest ? "..." : "");
}

std::string in_quotes(const std::string& text) {
  return '"' + printable(text) + '"';
}

std::string hint_on_letters(const std::string& text) {
  if (text.find("\xC2\xA0") != std::string::npos)
    return "; it has a no-break space";
  if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c > 0x7f; }))
    return "; it has a letter that is not ASCII";
  return text.find("  ") == std::string::npos ? "" : "; it has two blanks in a row";
}

std::string trimmed(const std::string& text) {
  return boost::algorithm::trim_copy(text, std::locale::classic());
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  if (trimmed(text).empty())
    return parts;
  boost::algorithm::split(parts, text, [=](char c) { return c == separator; });
  for (std::string& part : parts)
    part = trimmed(part);
  return parts;
}

unsigned int edit_distance(const std::string& from, const std::string& to) {
  std::vector<unsigned int> row(to.size() + 1);
  for (unsigned int j = 0; j < row.size(); ++j)
    row[j] = j;
  for (const unsigned char letter : from) {
    unsigned int diagonal = row[0]++;
    for (unsigned int j = 1; j < row.size(); ++j) {
      const bool is_equal = std::tolower(letter) == std::tolower(to[j - 1]);
      const unsigned int edited = is_equal ? diagonal : 1 + std::min(row[j], row[j - 1]);
      diagonal = std::exchange(row[j], edited);
    }
  }
  return row.back();
}

double to_number(const std::string& text) {
  const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  const char* const end = text.data() + text.size();
  double value = 0;
  const auto [rest, error] = std::from_chars(text.data() + has_plus, end, value);
  if (error != std::errc() || rest != end || !(value == 0 || std::isnormal(value)))
    throw std::invalid_argument("");
  return value;
}

std::string rounded(double number, int digits) {
  std::ostringstream text;
  text.precision(digits);
  text << number + 0.; // no -0
  return text.str();
}

std::string rounded_up(double number, int digits) {
  const std::string nearest = rounded(number, digits);
  if (!std::isfinite(number) || number == 0 || std::stod(nearest) >= number)
    return nearest;
  const double last_digit = std::pow(10., std::floor(std::log10(std::abs(number))) + 1 - digits);
  return rounded(number + last_digit / 2, digits);
}

std::string rounded_down(double number, int digits) {
  const std::string up = rounded_up(-number, digits);
  return number > 0 ? up.substr(1) : number < 0 ? '-' + up : up;
}

namespace {

/// An uncertainty rounded up to one digit, to two where the first is a 1, and the power of ten of
/// its last digit.
std::pair<double, int> rounded_uncertainty(double uncertainty) {
  const double up = std::stod(rounded_up(uncertainty, 2));
  const int place = std::floor(std::log10(up));
  if (up < 2 * std::pow(10., place))
    return {up, place - 1};
  const double one_digit = std::stod(rounded_up(uncertainty, 1));
  return {one_digit, std::floor(std::log10(one_digit))};
}

std::string rounded_to_place(double number, int place) {
  constexpr int most_digits = 9;
  const double unit = std::pow(10., place), nearest = std::round(number / unit) * unit;
  if (place < -most_digits || !std::isfinite(nearest))
    return rounded(std::isfinite(nearest) ? nearest : number, most_digits);
  std::ostringstream text;
  text << std::fixed << std::setprecision(std::max(0, -place)) << nearest + 0.; // no -0
  return text.str();
}

} // namespace

std::string rounded_by(double number, double uncertainty) {
  return rounded_to_place(number, rounded_uncertainty(uncertainty).second);
}

std::string with_uncertainty(double number, double uncertainty) {
  if (!(uncertainty > 0 && std::isfinite(uncertainty)))
    return rounded(number, 9) + " +- " + rounded(uncertainty, 1);
  const auto [up, place] = rounded_uncertainty(uncertainty);
  return rounded_to_place(number, place) + " +- " + rounded_to_place(up, place);
}

std::string shortest_text(double number) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof(text), number).ptr};
}

std::string table_text(const dealii::TableHandler& table) {
  std::ostringstream text;
  table.write_text(text, dealii::TableHandler::table_with_headers);
  return text.str();
}

} // namespace rollwave
