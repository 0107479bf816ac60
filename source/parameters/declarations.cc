#include "rollwave/parameters/declarations.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/text.h"

#include <algorithm>
#include <cctype>

namespace rollwave {

using namespace dealii;

std::string place(const Setting& setting) {
  return setting.origin + ": section " + in_quotes(setting.section) + ", key " +
         in_quotes(setting.key);
}

void Declarations::add(const std::string& key, const std::string& default_text,
                       const std::function<void(const std::string&)>& parse,
                       const std::string& text) {
  keys.push_back({section, key, text, parse});
  parse(default_text);
  prm.enter_subsection(section);
  prm.declare_entry(key, default_text, Patterns::Anything(), text);
  prm.leave_subsection();
}

void Declarations::add_number(const std::string& key, double& number, double least, double most,
                              const std::string& text) {
  add(
      key, rounded(number, 6),
      [&number, least, most](const std::string& text) {
        number = to_number(text);
        if (number < least || number > most)
          throw std::invalid_argument("");
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

void Declarations::add_flag(const std::string& key, bool& flag, const std::string& text) {
  add_choice<bool>(key, flag, {{"false", false}, {"true", true}}, "\"true\" or \"false\": " + text);
}

void Declarations::add_text(const std::string& key, std::string& value, const std::string& text) {
  add(
      key, value,
      [&value](const std::string& text) {
        if (text.empty())
          throw std::invalid_argument("");
        value = text;
      },
      text);
}

namespace {

/// Levenshtein's distance without regard to case: insertions, deletions and replacements.
unsigned int edit_distance(const std::string& from, const std::string& to) {
  const auto lower = [](unsigned char c) { return std::tolower(c); };
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

const Declarations::Key& Declarations::find(const Setting& setting) const {
  const auto exact = std::find_if(keys.begin(), keys.end(), [&](const Key& key) {
    return key.section == setting.section && key.name == setting.key;
  });
  if (exact != keys.end())
    return *exact;
  // What is longer than every key is far from all of them, and the more the longer to compare.
  const std::string named_section = printable(setting.section), named_key = printable(setting.key);
  std::multimap<unsigned int, std::string> nearest;
  std::string sections, own_keys;
  for (const Key& key : keys) {
    const std::string path = key.section + '/' + key.name;
    if (is_equal_but_for_case(setting.path(), path))
      throw BadInput(place(setting) + ": it is written " + path);
    if (setting.section.empty() && setting.key == key.name)
      throw BadInput(setting.origin + ": key " + in_quotes(key.name) +
                     " lacks its section: it is " + path);
    nearest.emplace(edit_distance(named_key, key.name) + edit_distance(named_section, key.section),
                    path);
    if (sections.find(key.section) == std::string::npos)
      sections += (sections.empty() ? "" : ", ") + key.section;
    if (key.section == setting.section)
      own_keys += (own_keys.empty() ? "" : ", ") + key.name;
  }
  std::string message = place(setting) + ": there is no such " +
                        (own_keys.empty() ? "section" : "key") + "; the nearest known: ";
  auto candidate = nearest.begin();
  for (unsigned int i = 0; i < 3; ++i, ++candidate)
    message += (i > 0 ? ", " : "") + candidate->second;
  throw BadInput(message + (own_keys.empty() ? "; all sections: " + sections
                                             : "; all keys of this section: " + own_keys));
}

void Declarations::apply(const std::vector<Setting>& settings) {
  for (const Setting& setting : settings) {
    const Key& key = find(setting);
    try {
      const std::string text = in_file(setting.value);
      key.parse(setting.value);
      prm.enter_subsection(key.section);
      prm.set(key.name, text);
      prm.leave_subsection();
    } catch (const BadInput& reason) {
      throw BadInput(place(setting) + ": " + reason.what());
    } catch (const std::invalid_argument& reason) {
      const std::string why = reason.what();
      throw BadInput(place(setting) + ", value " + in_quotes(setting.value) +
                     (why.empty() ? " is not admitted" : ": " + why) + ". The key: " + key.text);
    }
  }
}

void Declarations::print(std::ostream& out) const {
  prm.print_parameters(out, ParameterHandler::PRM | ParameterHandler::KeepDeclarationOrder);
}

} // namespace rollwave
