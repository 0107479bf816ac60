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

} // namespace rollwave
