#include "rollwave/base/csv.h"

#include <boost/algorithm/string/replace.hpp>

#include <algorithm>

namespace rollwave {

std::string csv_field(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  if (text.find_first_of(",\"") == std::string::npos)
    return text;
  return '"' + boost::algorithm::replace_all_copy(text, "\"", "\"\"") + '"';
}

std::vector<std::string> csv_fields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  char before = ',';
  for (const char c : line) {
    if (c == '"') {
      is_quoted = !is_quoted;
      if (is_quoted && before == '"') // a doubled one
        fields.back() += c;
    } else if (c == ',' && !is_quoted)
      fields.emplace_back();
    else
      fields.back() += c;
    before = c;
  }
  return is_quoted ? std::vector<std::string>() : fields;
}

} // namespace rollwave
