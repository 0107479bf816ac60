#include "rollwave/parameters/prm_reader.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <map>
#include <sstream>

namespace rollwave {

namespace {

/// The value with runs of white space folded: continued lines are indented for the eye only.
std::string folded(const std::string& text) {
  std::istringstream words(text);
  std::string result, word;
  while (words >> word)
    result += (result.empty() ? "" : " ") + word;
  return result;
}

/// All of @p in. What never ends, such as a device, shall not fill the memory.
std::string read_all(std::istream& in, const std::string& name) {
  constexpr std::size_t longest = 1 << 20;
  std::string text;
  std::array<char, 4096> block;
  while (in) {
    in.read(block.data(), block.size());
    text.append(block.data(), in.gcount());
    if (text.size() > longest)
      throw BadInput(name + ": this is no parameter file, it is longer than 1 MiB");
  }
  if (in.bad())
    throw BadInput(name + ": this parameter file cannot be read");
  const std::string byte_order_mark = "\xEF\xBB\xBF"; // which some editors put first
  return text.compare(0, byte_order_mark.size(), byte_order_mark) == 0
             ? text.substr(byte_order_mark.size())
             : text;
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

bool is_writable(const std::string& value) {
  return value == folded(value) && value.find('#') == std::string::npos &&
         (value.empty() || value.back() != '\\');
}

std::vector<Setting> read_settings(std::istream& file, const std::string& name) {
  std::istringstream in(read_all(file, name));
  std::vector<Setting> settings;
  std::map<std::string, std::string> seen;
  std::string section, statement, rest, opened_at;
  unsigned line_number = 0;
  while (next_statement(in, line_number, statement)) {
    const std::string origin = name + ", line " + std::to_string(line_number);
    if (statement.empty())
      continue;
    if (follows(statement, "subsection", rest)) {
      if (!section.empty())
        throw BadInput(origin + ": " + in_quotes(statement) + " inside section " +
                       in_quotes(section) + "; close that one by \"end\" first");
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
        throw BadInput(origin + ": section " + in_quotes(section) + ", key " +
                       in_quotes(setting.key) + " is set a second time; it was set at " +
                       earlier->second);
      settings.push_back(setting);
    } else
      throw BadInput(origin + ": " + in_quotes(statement) +
                     " is none of \"subsection NAME\", \"set KEY = VALUE\", \"end\"");
  }
  if (!section.empty())
    throw BadInput(opened_at + ": section " + in_quotes(section) + " is not closed by \"end\"");
  return settings;
}

std::vector<Setting> read_settings(const std::filesystem::path& file, MPI_Comm communicator) {
  std::string text, failure;
  if (process_number(communicator) == 0)
    try {
      std::ifstream in(file);
      if (!in || std::filesystem::is_directory(file))
        throw BadInput(file.string() + ": this parameter file cannot be read");
      text = read_all(in, file.string());
    } catch (const BadInput& error) {
      failure = error.what();
    }
  failure = share_text(communicator, failure);
  if (!failure.empty())
    throw BadInput(failure);
  std::istringstream in(share_text(communicator, text));
  return read_settings(in, file.string());
}

Setting parse_setting(const std::string& text, const std::string& origin) {
  const auto equals = text.find('=');
  const auto slash = text.find('/');
  if (equals == std::string::npos || slash == std::string::npos || slash > equals)
    throw BadInput(origin + ": " + in_quotes(text) + " is not of the form \"Section/Key=value\"");
  return {trimmed(text.substr(0, slash)), trimmed(text.substr(slash + 1, equals - slash - 1)),
          folded(text.substr(equals + 1)), origin};
}

} // namespace rollwave
