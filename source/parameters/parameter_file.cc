#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/text.h"
#include "rollwave/parameters/keys.h"
#include "rollwave/parameters/parameters.h"

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// The next line of a parameter file with those that continue it after a backslash, without comment
/// and with blanks for tabulators. @return false at the end of the file
bool next_line(std::istream& in, std::string& line, unsigned int& number) {
  line.clear();
  bool is_read = false;
  for (std::string part; std::getline(in, part);) {
    ++number;
    is_read = true;
    line += part = trimmed(part);
    if (part.empty() || part.back() != '\\')
      break;
    line.pop_back();
  }
  std::replace(line.begin(), line.end(), '\t', ' ');
  line = trimmed(line.substr(0, line.find('#')));
  return is_read;
}

/// The first word of a line in small letters, and the rest.
std::pair<std::string, std::string> split_word(const std::string& line) {
  const auto end = std::min(line.find(' '), line.size());
  return {boost::algorithm::to_lower_copy(line.substr(0, end)), trimmed(line.substr(end))};
}

} // namespace

std::vector<Setting> parse_settings(const std::string& text, const std::string& name) {
  const std::string beginning = text.substr(0, 2);
  if (beginning == "\xFF\xFE" || beginning == "\xFE\xFF" ||
      beginning.find('\0') != std::string::npos)
    throw BadInput(name + ": this file is in UTF-16; save it in UTF-8");
  const std::string byte_order_mark = "\xEF\xBB\xBF";
  const bool has_mark = boost::algorithm::starts_with(text, byte_order_mark);
  std::istringstream in(has_mark ? text.substr(byte_order_mark.size()) : text);
  std::vector<Setting> settings;
  std::string line, section;
  unsigned int number = 0;
  const auto refuse = [&](const std::string& reason) {
    throw BadInput(name + ", line " + std::to_string(number) + ": " + reason);
  };
  while (next_line(in, line, number)) {
    const auto [word, rest] = split_word(line);
    const auto equals = rest.find('=');
    if (word == "subsection" && !rest.empty()) {
      if (!section.empty())
        refuse("subsection " + in_quotes(rest) + " begins before the \"end\" of " +
               in_quotes(section));
      section = rest;
      check_section(section, name + ", line " + std::to_string(number));
    } else if (word == "end" && rest.empty() && !section.empty())
      section.clear();
    else if (word == "set" && equals != std::string::npos) {
      const Setting setting = {section, trimmed(rest.substr(0, equals)),
                               trimmed(rest.substr(equals + 1)), name, number};
      if (last_of(settings, setting.path()))
        throw BadInput(refusal(setting, "this is the second value of the key"));
      settings.push_back(setting);
    } else if (word == "include")
      refuse("a parameter file cannot include others");
    else if (!line.empty())
      refuse(in_quotes(line) +
             " is not of the form set KEY = VALUE, subsection NAME, or end after "
             "a subsection" +
             hint_on_letters(line));
  }
  if (!section.empty())
    throw BadInput(name + ": subsection " + in_quotes(section) + " lacks its \"end\"");
  return settings;
}

std::vector<Setting> read_settings(const std::filesystem::path& file, MPI_Comm communicator) {
  const std::string name = file.string();
  std::ostringstream text;
  if (process_number(communicator) == 0) {
    std::ifstream in(file);
    in.peek(); // fails for a directory
    if (!in.is_open() || in.bad())
      throw BadInput(printable(name) +
                     ": this parameter file cannot be read: " + std::strerror(errno));
    text << in.rdbuf();
  }
  return parse_settings(broadcast(communicator, text.str()), name);
}

void print_parameters(std::ostream& out, const Parameters& parameters) {
  ParameterHandler prm;
  for (const Key& key : all_keys()) {
    prm.enter_subsection(key.section);
    prm.declare_entry(key.name, key.default_value, Patterns::Anything(), key.text);
    prm.set(key.name, value_of(key, parameters.settings));
    prm.leave_subsection();
  }
  prm.print_parameters(out, ParameterHandler::PRM | ParameterHandler::KeepDeclarationOrder);
}

} // namespace rollwave
