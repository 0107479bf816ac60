#include "rollwave/parameters/keys.h"

#include "rollwave/base/text.h"
#include "rollwave/scene/expression.h"

#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace rollwave {

namespace {

/// The keys, or without a name the sections, that are spelt most like these: up to three.
std::string nearest(const std::string& section, const std::string& name) {
  std::set<std::pair<unsigned int, std::string>> known;
  for (const Key& key : all_keys()) {
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
  return text + "? (case matters)" + hint_on_letters(section + ' ' + name);
}

/// A remark on values for several runs, which only Study/Vary takes; empty without any.
std::string hint_on_values(const Setting& setting) {
  const auto values = split(boost::algorithm::replace_all_copy(setting.value, "|", ":"), ':');
  return values.size() > 1 && std::all_of(values.begin(), values.end(), value_if_any)
             ? "; several values make a study, as in Study/Vary = " + setting.path() + " = " +
                   setting.value
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

std::string refusal(const Setting& setting, const std::string& reason) {
  return setting.place() + ": section " + in_quotes(setting.section) + ", key " +
         in_quotes(setting.key) + ", value " + in_quotes(setting.value) + ": " + reason;
}

std::string refusal(const std::vector<Setting>& settings, const BadValue& value) {
  if (const Setting* const last = last_of(settings, value.section + '/' + value.key))
    return refusal(*last, value.reason);
  return "default value: section " + in_quotes(value.section) + ", key " + in_quotes(value.key) +
         ": " + value.reason;
}

const Key& key_of(const Setting& setting) {
  const auto& keys = all_keys();
  const auto key = std::find_if(keys.begin(), keys.end(), [&](const Key& known) {
    return known.name == setting.key && known.section == setting.section;
  });
  if (key == keys.end())
    throw BadInput(setting.place() + ": no key " + in_quotes(setting.key) +
                   (setting.section.empty() ? "" : " in section " + in_quotes(setting.section)) +
                   nearest(setting.section, setting.key));
  return *key;
}

std::string value_of(const Key& key, const std::vector<Setting>& settings) {
  const Setting* const last = last_of(settings, key.path());
  return last ? last->value : key.default_value;
}

void check_section(const std::string& name, const std::string& place) {
  const auto& keys = all_keys();
  if (std::none_of(keys.begin(), keys.end(), [&](const Key& key) { return key.section == name; }))
    throw BadInput(place + ": no section " + in_quotes(name) + nearest(name, ""));
}

Assignment read(const Setting& setting) {
  const Key& key = key_of(setting);
  const std::string& value = setting.value;
  if (value != trimmed(value) || value.find('#') != std::string::npos ||
      std::any_of(value.begin(), value.end(), [](unsigned char c) { return std::iscntrl(c); }) ||
      (!value.empty() && value.back() == '\\'))
    throw RefusedSetting(setting, "a parameter file cannot hold #, control characters, blanks at "
                                  "the ends or a backslash at the end of a value");
  try {
    Assignment assignment{setting, {}};
    assignment.assign = key.read(assignment);
    return assignment;
  } catch (const std::invalid_argument& error) {
    throw RefusedSetting(setting, std::string("invalid. ") + error.what() +
                                      (*error.what() ? " " : "") + "Expected: " + key.text +
                                      hint_on_letters(value) + hint_on_values(setting));
  } catch (const RefusedSetting&) {
    throw;
  } catch (const BadInput& error) {
    throw RefusedSetting(setting, error.what());
  }
}

double convert_number(std::string& text, const Range& range, bool is_whole) {
  const double number = evaluate(text);
  if (!(range.least <= number && number <= range.most))
    throw std::invalid_argument("");
  if (is_whole && number != std::floor(number))
    throw std::invalid_argument("It must be a whole number.");
  text = number_text(number);
  return number;
}

std::string number_text(double number) {
  constexpr int exact = std::numeric_limits<double>::digits10;
  const bool is_plain = number == std::floor(number) && std::abs(number) < 1e15;
  return is_plain ? rounded(number, exact) : shortest_text(number);
}

} // namespace rollwave
