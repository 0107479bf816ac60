#include "rollwave/base/text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <system_error>

namespace rollwave {

std::string printable(const std::string& text) {
  constexpr std::size_t longest = 200;
  std::string shown = text.size() <= longest ? text : text.substr(0, longest) + "...";
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, '?');
  return shown;
}

std::string in_quotes(const std::string& text) {
  return '"' + printable(text) + '"';
}

std::string trimmed(const std::string& text) {
  const char* const white = " \t\r\n\v\f";
  const auto first = text.find_first_not_of(white);
  return first == std::string::npos ? std::string()
                                    : text.substr(first, text.find_last_not_of(white) - first + 1);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  if (trimmed(text).empty())
    return parts;
  std::size_t begin = 0;
  for (;;) {
    const auto end = text.find(separator, begin);
    parts.push_back(trimmed(text.substr(begin, end - begin)));
    if (end == std::string::npos)
      return parts;
    begin = end + 1;
  }
}

double to_number(const std::string& text) {
  const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  const char* const end = text.data() + text.size();
  double value = 0;
  const auto [rest, error] = std::from_chars(text.data() + has_plus, end, value);
  if (error != std::errc() || rest != end || !(value == 0 || std::isnormal(value)))
    throw std::invalid_argument(text);
  return value;
}

unsigned int to_count(const std::string& text, unsigned int least, unsigned int most) {
  const double number = to_number(text);
  if (number != std::floor(number) || number < least || number > most)
    throw std::invalid_argument(text);
  return static_cast<unsigned int>(number);
}

std::string shortest_text(double number) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof(text), number).ptr};
}

std::string in_tex(const std::string& text) {
  std::string tex;
  for (const char c : text)
    if (c == '\\')
      tex += "\\textbackslash{}";
    else if (std::string("&%$#_{}").find(c) != std::string::npos)
      tex += std::string("\\") + c;
    else if (c == '^' || c == '~')
      tex += std::string("\\") + c + "{}";
    else if (c == '<' || c == '>' || c == '|')
      tex += std::string("$") + c + '$';
    else
      tex += c;
  return tex;
}

} // namespace rollwave
