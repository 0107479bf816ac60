#include "rollwave/parameters/declarations.h"

#include "rollwave/base/errors.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>

namespace rollwave {

using namespace dealii;

std::string place(const Setting& setting) {
  return setting.origin + ": section " + in_quotes(setting.section) + ", key " +
         in_quotes(setting.key);
}

void Declarations::enter(const std::string& name) {
  section = name;
  prm.enter_subsection(name);
}

void Declarations::add(const std::string& key, const std::string& default_text,
                       const std::function<void(const std::string&)>& parse,
                       const std::string& text) {
  prm.declare_entry(key, default_text, Patterns::Anything(), text);
  prm.add_action(key, parse);
  texts[section].emplace_back(key, text);
}

void Declarations::add_number(const std::string& key, double& number, double least, double most,
                              const std::string& text) {
  std::ostringstream default_text;
  default_text << number;
  add(
      key, default_text.str(),
      [&number, least, most](const std::string& text) {
        number = to_number(text);
        if (number < least || number > most)
          throw std::invalid_argument(text);
      },
      text);
}

void Declarations::add_count(const std::string& key, unsigned int& count, unsigned int least,
                             unsigned int most, const std::string& text) {
  add(
      key, std::to_string(count),
      [&count, least, most](const std::string& text) { count = to_count(text, least, most); },
      text);
}

void Declarations::add_text(const std::string& key, std::string& value, const std::string& text) {
  add(
      key, value,
      [&value](const std::string& text) {
        if (text.empty())
          throw std::invalid_argument(text);
        value = text;
      },
      text);
}

namespace {

/// Levenshtein's distance without regard to case: insertions, deletions and replacements.
unsigned int edit_distance(const std::string& from, const std::string& to) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  std::vector<unsigned int> row(to.size() + 1);
  for (unsigned int j = 0; j < row.size(); ++j)
    row[j] = j;
  for (unsigned int i = 1; i <= from.size(); ++i) {
    unsigned int diagonal = row[0];
    row[0] = i;
    for (unsigned int j = 1; j < row.size(); ++j) {
      const unsigned int replaced = diagonal + (lower(from[i - 1]) == lower(to[j - 1]) ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

} // namespace

/// The message for a setting without a declared key: the nearest keys, then all of its section.
std::string Declarations::unknown_key(const Setting& setting) const {
  // What is longer than every key is far from all of them, and the more the longer to compare.
  const std::string named_section = printable(setting.section), named_key = printable(setting.key);
  std::multimap<unsigned int, std::string> nearest;
  for (const auto& [section, entries] : texts)
    for (const auto& [key, text] : entries)
      nearest.emplace(edit_distance(named_key, key) + edit_distance(named_section, section),
                      section + "/" + key);
  std::string message = place(setting) + ": there is no such key; the nearest known: ";
  auto candidate = nearest.begin();
  for (unsigned int i = 0; i < 3; ++i, ++candidate)
    message += (i > 0 ? ", " : "") + candidate->second;
  const auto own = texts.find(setting.section);
  if (own != texts.end()) {
    message += "; all keys of this section: ";
    for (const auto& entry : own->second)
      message += (&entry != &own->second.front() ? ", " : "") + entry.first;
  }
  return message;
}

void Declarations::refuse(const std::string& section, const std::string& key,
                          const std::string& advice) {
  refused[section + "/" + key] = advice;
}

void Declarations::apply(const std::vector<Setting>& settings) const {
  for (const Setting& setting : settings) {
    if (const auto gone = refused.find(setting.path()); gone != refused.end())
      throw BadInput(place(setting) + ": this key is gone; " + gone->second);
    const auto section = texts.find(setting.section);
    if (section == texts.end())
      throw BadInput(unknown_key(setting));
    const auto entry =
        std::find_if(section->second.begin(), section->second.end(),
                     [&setting](const auto& candidate) { return candidate.first == setting.key; });
    if (entry == section->second.end())
      throw BadInput(unknown_key(setting));
    if (!is_writable(setting.value))
      throw BadInput(
          place(setting) + ", value " + in_quotes(setting.value) +
          " cannot be written into a parameter file: it has a \"#\", a \"\\\" at its end "
          "or several blanks in a row");
    prm.enter_subsection(setting.section);
    try {
      prm.set(setting.key, setting.value);
    } catch (const BadInput& reason) {
      throw BadInput(place(setting) + ": " + reason.what());
    } catch (const std::exception&) {
      throw BadInput(place(setting) + ", value " + in_quotes(setting.value) +
                     " is not admitted. The key: " + entry->second);
    }
    prm.leave_subsection();
  }
}

} // namespace rollwave
