#include "rollwave/parameters/prm_reader.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace rollwave {

namespace {

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
  const auto begins_with = [&text](const std::string& mark) {
    return text.compare(0, mark.size(), mark) == 0;
  };
  if (begins_with("\xFF\xFE") || begins_with("\xFE\xFF"))
    throw BadInput(name + ": this file is in UTF-16 (bytes FF, FE at its start); save it as UTF-8");
  for (auto at = text.find('\r'); at != std::string::npos; at = text.find('\r', at + 1))
    if (at + 1 < text.size() && text[at + 1] != '\n')
      throw BadInput(name + ": lines end with a carriage return alone (byte 0D); save the file "
                            "with line feeds");
  return begins_with("\xEF\xBB\xBF") ? text.substr(3) : text; // which some editors put first
}

/// A line up to its comment: a "#" that is not between two double quotes.
std::string without_comment(const std::string& line) {
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line[i] == '"')
      is_quoted = !is_quoted && line.find('"', i + 1) != std::string::npos;
    else if (line[i] == '#' && !is_quoted)
      return line.substr(0, i);
  return line;
}

/// The next line with its continuations, without comment; advances @p line_number.
bool next_statement(std::istream& in, unsigned& line_number, std::string& statement) {
  statement.clear();
  std::string line;
  while (std::getline(in, line)) {
    ++line_number;
    line = trimmed(without_comment(line));
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

/// The value that @p text stands for in a file.
std::string from_file(const std::string& text) {
  std::string value = trimmed(text);
  if (value.size() > 1 && value.find('"') == 0 && value.find('"', 1) == value.size() - 1)
    return value.substr(1, value.size() - 2);
  std::replace(value.begin(), value.end(), '\t', ' ');
  return value;
}

} // namespace

std::string in_file(const std::string& value) {
  if (std::any_of(value.begin(), value.end(), [](unsigned char c) { return std::iscntrl(c); }))
    throw std::invalid_argument("no parameter file can hold a control character");
  const bool needs_quotes = value != trimmed(value) || value.find('#') != std::string::npos ||
                            (!value.empty() && value.back() == '\\');
  if (value.find('"') == std::string::npos)
    return needs_quotes ? '"' + value + '"' : value;
  if (needs_quotes || value != from_file(value))
    throw std::invalid_argument("no parameter file can hold this with its quotation mark");
  return value;
}

std::vector<Setting> read_settings(std::istream& file, const std::string& name) {
  std::istringstream in(read_all(file, name));
  std::vector<Setting> settings;
  std::map<std::string, std::string> seen;
  std::string section, statement, rest, opened_at;
  unsigned line_number = 0;
  while (next_statement(in, line_number, statement)) {
    const std::string origin = name + ", line " + std::to_string(line_number);
    const auto refuse = [&origin](const std::string& why) { throw BadInput(origin + ": " + why); };
    if (statement.empty())
      continue;
    if (follows(statement, "subsection", rest)) {
      if (!section.empty())
        refuse(in_quotes(statement) + " inside section " + in_quotes(section) +
               "; close that one by \"end\" first");
      if (rest.empty())
        refuse("a subsection needs a name");
      section = rest;
      opened_at = origin;
    } else if (statement == "end") {
      if (section.empty())
        refuse("\"end\" without a subsection");
      section.clear();
    } else if (follows(statement, "set", rest) && rest.find('=') != std::string::npos) {
      const auto equals = rest.find('=');
      const Setting setting{section, trimmed(rest.substr(0, equals)),
                            from_file(rest.substr(equals + 1)), origin};
      const auto [earlier, is_first] = seen.emplace(setting.path(), origin);
      if (!is_first)
        refuse("section " + in_quotes(section) + ", key " + in_quotes(setting.key) +
               " is set a second time; it was set at " + earlier->second);
      settings.push_back(setting);
    } else
      refuse(in_quotes(statement) +
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
      std::error_code ignored;
      std::ifstream in(file);
      const int error = errno;
      const bool is_directory = std::filesystem::is_directory(file, ignored);
      if (!in || is_directory)
        throw BadInput(printable(file.string()) + ": this parameter file cannot be read: " +
                       std::strerror(is_directory ? EISDIR : error));
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
  if (equals == std::string::npos)
    throw BadInput(origin + ": " + in_quotes(text) + " is not of the form \"Section/Key=value\"");
  const auto slash = std::min(text.find('/'), equals);
  const auto key = slash == equals ? 0 : slash + 1;
  return {trimmed(text.substr(0, key > 0 ? slash : 0)), trimmed(text.substr(key, equals - key)),
          from_file(text.substr(equals + 1)), origin};
}

} // namespace rollwave
