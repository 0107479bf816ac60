#include "rollwave/parameters/keys.h"

#include "rollwave/base/text.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// The number of letters to insert or delete between two texts, regardless of case.
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

std::string refusal_of(const Setting& setting, const std::string& reason) {
  return setting.origin + ": section " + in_quotes(setting.section) + ", key " +
         in_quotes(setting.key) + ", value " + in_quotes(setting.value) + ": " + reason;
}

/// Advice on a number that is followed by a comma or letters; empty for other texts.
std::string hint_on_number(const std::string& value) {
  static const std::regex number(R"([+-]?\d[\d.]*([eE][+-]?\d+)?)"),
      number_and_more(R"([+-]?\d[\d.]* *[,a-zA-Z].*)");
  return !std::regex_match(value, number) && std::regex_match(value, number_and_more)
             ? " (a number has a decimal point and no unit)"
             : "";
}

} // namespace

Setting parse_setting(const std::string& text, const std::string& origin) {
  const auto equals = text.find('=');
  if (equals == std::string::npos)
    throw BadInput(origin + ": " + in_quotes(text) + " is not of the form \"Section/Key=value\"");
  const auto slash = std::min(text.find('/'), equals), key = slash < equals ? slash + 1 : 0;
  return {trimmed(text.substr(0, key > 0 ? slash : 0)), trimmed(text.substr(key, equals - key)),
          trimmed(text.substr(equals + 1)), origin};
}

const Setting* last_of(const std::vector<Setting>& settings, const std::string& path) {
  const auto last = std::find_if(settings.rbegin(), settings.rend(),
                                 [&](const Setting& setting) { return setting.path() == path; });
  return last == settings.rend() ? nullptr : &*last;
}

std::string refusal(const std::vector<Setting>& settings, const BadValue& value) {
  if (const Setting* const last = last_of(settings, value.section + '/' + value.key))
    return refusal_of(*last, value.reason);
  return "default value: section " + in_quotes(value.section) + ", key " + in_quotes(value.key) +
         ": " + value.reason;
}

void Keys::enter(const std::string& name, unsigned int affects) {
  section = name;
  affected = affects;
}

void Keys::declare(const std::string& name, const std::string& default_value, const Parse& parse,
                   const std::string& text, const KeyAttributes& attributes) {
  keys.push_back({attributes, section, name, default_value, text});
  keys.back().affects |= affected;
  prm.enter_subsection(section);
  prm.declare_entry(name, default_value, Patterns::Anything(), text);
  prm.add_action(name, [this, section = section, name, text, parse](const std::string& value) {
    const Setting setting{section, name, value, origin ? origin() : ""};
    try {
      parse(setting);
    } catch (const BadInput& error) {
      const std::string reason = error.what();
      throw BadInput(refusal_of(setting, reason.empty() ? "invalid" + hint_on_number(value) +
                                                              ". Expected: " + text
                                                        : reason));
    }
    if (origin)
      settings.push_back(setting);
  });
  prm.leave_subsection();
}

/// The key of a setting. @throws BadInput with the nearest keys where there is none
const Key& Keys::at(const Setting& setting) const {
  const auto key = std::find_if(keys.begin(), keys.end(), [&](const Key& known) {
    return known.section == setting.section && known.name == setting.key;
  });
  if (key == keys.end())
    throw BadInput(setting.origin + ": no key " + in_quotes(setting.key) +
                   (setting.section.empty() ? "" : " in section " + in_quotes(setting.section)) +
                   nearest(setting.section, setting.key));
  return *key;
}

/// The keys, or without a name the sections, that are spelt most like these: up to three.
std::string Keys::nearest(const std::string& section, const std::string& name) const {
  std::set<std::pair<unsigned int, std::string>> known;
  for (const Key& key : keys) {
    const unsigned int distance =
        (section.empty() ? 0 : edit_distance(printable(section), key.section)) +
        (name.empty() ? 0 : edit_distance(printable(name), key.name));
    known.emplace(distance, name.empty() ? key.section : key.path());
  }
  std::string text;
  constexpr unsigned int similar = 3; // further letters
  for (auto candidate = known.begin(); candidate != std::next(known.begin(), 3); ++candidate)
    if (candidate->first <= known.begin()->first + similar)
      text += (text.empty() ? "; did you mean " : ", ") + candidate->second;
  return text + "? (case matters)";
}

void Keys::read(const std::string& text, const std::string& file) {
  std::istringstream in(text + '\n');
  origin = [&] {
    const std::string before = (text + '\n').substr(0, in.tellg());
    return file + ", line " + std::to_string(std::count(before.begin(), before.end(), '\n'));
  };
  for (std::string line; std::getline(in, line);)
    if (line = trimmed(line).substr(0, 7); line == "include" || line == "INCLUDE")
      throw BadInput(origin() + ": a parameter file cannot include others");
  in.clear();
  in.seekg(0);
  try {
    prm.parse_input(in, file);
  } catch (const ExceptionBase& error) {
    constexpr unsigned int longest = 300;
    std::ostringstream complaint;
    error.print_info(complaint);
    std::string message =
        std::regex_replace(trimmed(complaint.str().substr(0, longest)), std::regex("\\s+"), " ");
    // deal.II repeats the name of the file.
    message =
        std::regex_replace(message, std::regex("^Line <(\\d+)> of file <[^:]*: "), "line $1: ");
    message = std::regex_replace(message, std::regex("\\.$"), "");
    std::smatch unknown;
    std::string hint;
    if (std::regex_search(message, unknown, std::regex("No entry with name <(.*)>.*"))) {
      hint = nearest("", unknown[1]);
      message =
          std::string(unknown.prefix()) + "no key " + in_quotes(unknown[1]) + " in this section";
    } else if (std::regex_search(message, unknown, std::regex("could not be parsed.*")))
      message = std::string(unknown.prefix()) + "is not of the form set KEY = VALUE, subsection "
                                                "NAME or end";
    else if (std::regex_search(message, unknown, std::regex("subsection to be entered: (.*)")))
      hint = std::string(unknown[1]).find('.') == std::string::npos
                 ? nearest(unknown[1], "")
                 : "; the section before it may lack its \"end\"";
    throw BadInput(file + ": " + printable(message, longest) + hint);
  }
  for (const Setting& setting : settings)
    if (const Setting& last = *last_of(settings, setting.path()); &last != &setting)
      throw BadInput(refusal_of(last, "this is the second value of the key"));
  // deal.II takes values with a brace as lists for its own studies, without calling actions.
  for (const Key& key : keys) {
    prm.enter_subsection(key.section);
    const std::string value = prm.get(key.name);
    prm.leave_subsection();
    if (value.find('{') != std::string::npos)
      set({key.section, key.name, value, file});
  }
}

void Keys::set(const Setting& setting) {
  const Key& key = at(setting);
  const std::string& value = setting.value;
  if (value != trimmed(value) || value.find('#') != std::string::npos ||
      std::any_of(value.begin(), value.end(), [](unsigned char c) { return std::iscntrl(c); }) ||
      (!value.empty() && value.back() == '\\'))
    throw BadInput(refusal_of(setting, "a parameter file cannot hold #, control characters, blanks "
                                       "at the ends or a backslash at the end of a value"));
  origin = [&] { return setting.origin; };
  prm.enter_subsection(key.section);
  prm.set(key.name, value);
  prm.leave_subsection();
}

void Keys::print(std::ostream& out) const {
  prm.print_parameters(out, ParameterHandler::PRM | ParameterHandler::KeepDeclarationOrder);
}

} // namespace rollwave
