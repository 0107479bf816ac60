#include "settings.h"

#include "errors.h"

#include <fstream>
#include <map>
#include <sstream>

namespace rollwave {

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

namespace {

/// The value with runs of white space folded: continued lines are indented for the eye only.
std::string folded(const std::string& text) {
  std::istringstream words(text);
  std::string result, word;
  while (words >> word)
    result += (result.empty() ? "" : " ") + word;
  return result;
}

/// The next line with its continuations, without comment; advances @p line_number.
bool next_statement(std::istream& in, unsigned& line_number, std::string& statement) {
  statement.clear();
  std::string line;
  while (std::getline(in, line)) {
    ++line_number;
    line = trimmed(line.substr(0, line.find('#')));
    const bool continued = !line.empty() && line.back() == '\\';
    if (continued)
      line.pop_back();
    statement += line;
    if (!continued)
      return true;
  }
  return !statement.empty();
}

/// The rest of @p statement after the word @p keyword and white space; false without that word.
bool follows(const std::string& statement, const std::string& keyword, std::string& rest) {
  if (statement.compare(0, keyword.size(), keyword) != 0)
    return false;
  rest = statement.substr(keyword.size());
  if (!rest.empty() && rest.front() != ' ' && rest.front() != '\t')
    return false;
  rest = trimmed(rest);
  return true;
}

} // namespace

std::vector<Setting> read_settings(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in || std::filesystem::is_directory(file))
    throw BadInput(file.string() + ": this parameter file cannot be read");

  std::vector<Setting> settings;
  std::map<std::string, std::string> seen;
  std::string section, statement, rest, opened_at;
  unsigned line_number = 0;
  while (next_statement(in, line_number, statement)) {
    const std::string origin = file.string() + ", line " + std::to_string(line_number);
    if (statement.empty())
      continue;
    if (follows(statement, "subsection", rest)) {
      if (!section.empty())
        throw BadInput(origin + ": \"" + statement + "\" inside section \"" + section +
                       "\"; close that one by \"end\" first");
      if (rest.empty())
        throw BadInput(origin + ": a subsection needs a name");
      section = rest;
      opened_at = origin;
    } else if (statement == "end") {
      if (section.empty())
        throw BadInput(origin + ": \"end\" without a subsection");
      section.clear();
    } else if (follows(statement, "set", rest) && rest.find('=') != std::string::npos) {
      const auto equals = rest.find('=');
      const Setting setting{section, trimmed(rest.substr(0, equals)),
                            folded(rest.substr(equals + 1)), origin};
      const auto [earlier, is_first] = seen.emplace(setting.path(), origin);
      if (!is_first)
        throw BadInput(origin + ": section \"" + section + "\", key \"" + setting.key +
                       "\" is set a second time; it was set at " + earlier->second);
      settings.push_back(setting);
    } else
      throw BadInput(origin + ": \"" + statement +
                     "\" is none of \"subsection NAME\", \"set KEY = VALUE\", \"end\"");
  }
  if (in.bad())
    throw BadInput(file.string() + ": reading stopped after line " + std::to_string(line_number));
  if (!section.empty())
    throw BadInput(opened_at + ": section \"" + section + "\" is not closed by \"end\"");
  return settings;
}

Setting parse_setting(const std::string& text, const std::string& origin) {
  const auto equals = text.find('=');
  const auto slash = text.find('/');
  if (equals == std::string::npos || slash == std::string::npos || slash > equals)
    throw BadInput(origin + ": \"" + text + "\" is not of the form \"Section/Key=value\"");
  return {trimmed(text.substr(0, slash)), trimmed(text.substr(slash + 1, equals - slash - 1)),
          folded(text.substr(equals + 1)), origin};
}

} // namespace rollwave
