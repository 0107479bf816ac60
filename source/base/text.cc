#include "rollwave/base/text.h"

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace rollwave {

std::string printable(const std::string& text, std::size_t longest) {
  const char* const digits = "0123456789ABCDEF";
  std::string shown;
  bool is_plain = true;
  for (std::size_t i = 0; i < std::min(text.size(), longest); ++i) {
    const unsigned char c = text[i], before = i > 0 ? text[i - 1] : ' ';
    if (c < 0x80)
      is_plain = !std::iscntrl(c);
    else if (c >= 0xC0) // of punctuation some looks like a blank or a minus sign
      is_plain = c != 0xC2 && c != 0xE2 && c != 0xEF;
    else // goes with the first byte of its letter
      is_plain = is_plain && before >= 0x80;
    shown += is_plain ? std::string(1, c) : std::string("\\x") + digits[c / 16] + digits[c % 16];
  }
  return shown + (text.size() > longest ? "..." : "");
}

std::string in_quotes(const std::string& text) {
  return '"' + printable(text) + '"';
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
