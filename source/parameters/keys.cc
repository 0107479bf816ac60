#include "rollwave/parameters/keys.h"

#include "rollwave/base/text.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
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

/// The lines "subsection SECTION" and "set KEY = VALUE" of a parameter file, whose places deal.II
/// does not give completely; the former without a key. @throws BadInput for "include FILE"
std::vector<Setting> places_of(const std::string& text, const std::string& file) {
  std::vector<Setting> places;
  std::istringstream lines(text);
  std::string line, section;
  for (unsigned int i = 1; std::getline(lines, line); ++i) {
    const std::string origin = file + ", line " + std::to_string(i);
    line = trimmed(line.substr(0, line.find('#')));
    const auto end = std::min(line.find_first_of(" \t"), line.size());
    const auto equals = std::min(line.find('=', end), line.size());
    const std::string keyword = line.substr(0, end), name = trimmed(line.substr(end, equals - end));
    if (keyword == "include" || keyword == "INCLUDE")
      throw BadInput(origin + ": a parameter file cannot include others");
    if (keyword == "subsection")
      places.push_back({section = name, "", "", origin});
    else if (keyword == "set" && equals < line.size())
      places.push_back({section, name, trimmed(line.substr(equals + 1)), origin});
    else if (keyword == "end")
      section.clear();
  }
  return places;
}

std::string refusal_of(const Setting& setting, const std::string& reason) {
  return setting.origin + ": section " + in_quotes(setting.section) + ", key " +
         in_quotes(setting.key) + ", value " + in_quotes(setting.value) + ": " + reason;
}

std::string refusal_of(const Setting& setting, const Key& key) {
  return refusal_of(setting, "invalid. Expected: " + key.text);
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
    return refusal_of(*last, value.wanted);
  return "default value: section " + in_quotes(value.section) + ", key " + in_quotes(value.key) +
         ": " + value.wanted;
}

void Keys::enter(const std::string& name, unsigned int affects) {
  section = name;
  affected = affects;
}

void Keys::declare(const std::string& name, const std::string& default_value,
                   const Patterns::PatternBase& pattern, const std::string& text,
                   const KeyAttributes& attributes, const Parse& parse) {
  keys.push_back({attributes, section, name, default_value, text});
  keys.back().affects |= affected;
  prm.enter_subsection(section);
  prm.declare_entry(name, default_value, pattern, text);
  prm.add_action(name, [this, key = keys.back(), parse](const std::string& value) {
    if (!origin.empty())
      settings.push_back({key.section, key.name, value, origin});
    try {
      parse(value);
    } catch (const BadInput& error) {
      const std::string reason = error.what();
      throw BadValue(key.section, key.name,
                     reason.empty() ? "invalid. Expected: " + key.text : reason);
    }
  });
  prm.leave_subsection();
}

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

/// The three keys, or without a name the sections, that are spelt most like these.
std::string Keys::nearest(const std::string& section, const std::string& name) const {
  std::set<std::pair<unsigned int, std::string>> known;
  for (const Key& key : keys) {
    const unsigned int distance =
        (section.empty() ? 0 : edit_distance(printable(section), key.section)) +
        (name.empty() ? 0 : edit_distance(printable(name), key.name));
    known.emplace(distance, name.empty() ? key.section : key.path());
  }
  std::string text;
  for (auto candidate = known.begin(); candidate != std::next(known.begin(), 3); ++candidate)
    text += (text.empty() ? "; did you mean " : ", ") + candidate->second;
  return text + "? (section and case matter)";
}

void Keys::read(const std::string& text, const std::string& file) {
  const std::vector<Setting> places = places_of(text, file);
  origin = file;
  std::istringstream in(text);
  try {
    prm.parse_input(in, file);
  } catch (const BadValue& value) {
    throw BadInput(refusal(places, value));
  } catch (const ExceptionBase& error) {
    throw BadInput(explain(error, places, file));
  }
  for (const Setting& setting : settings)
    if (last_of(settings, setting.path()) != &setting)
      throw BadInput(refusal(
          places, BadValue(setting.section, setting.key, "this is the second value of the key")));
  // deal.II does not check values with a brace, which are lists for its own studies.
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
  origin = setting.origin;
  prm.enter_subsection(key.section);
  try {
    prm.set(key.name, value);
  } catch (const BadValue& refused) {
    throw BadInput(refusal(settings, refused));
  } catch (const ParameterHandler::ExcValueDoesNotMatchPattern&) {
    throw BadInput(refusal_of(setting, key));
  }
  prm.leave_subsection();
}

void Keys::print(std::ostream& out) const {
  prm.print_parameters(out, ParameterHandler::PRM | ParameterHandler::KeepDeclarationOrder);
}

/// The message on a line that deal.II refused: at most the number is taken from its own.
std::string Keys::explain(const ExceptionBase& error, const std::vector<Setting>& places,
                          const std::string& file) const {
  std::ostringstream complaint;
  error.print_info(complaint);
  unsigned int number = 0;
  std::sscanf(complaint.str().c_str(), " Line <%u>", &number);
  const std::string origin = file + ", line " + std::to_string(number);
  const auto place = std::find_if(places.begin(), places.end(),
                                  [&](const Setting& setting) { return setting.origin == origin; });
  if (place != places.end() && !place->key.empty())
    return refusal_of(*place, at(*place));
  constexpr unsigned int longest = 300;
  const std::string text =
      std::regex_replace(trimmed(complaint.str().substr(0, longest)), std::regex("\\s+"), " ");
  return file + ": " + printable(text, longest) +
         (place == places.end() ? "" : nearest(place->section, ""));
}

} // namespace rollwave
