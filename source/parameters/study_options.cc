#include "rollwave/parameters/study_options.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/text.h"
#include "rollwave/parameters/declarations.h"

#include <cmath>
#include <regex>
#include <set>
#include <stdexcept>

namespace rollwave {

namespace {

/// A study lists all of its combinations before it begins.
constexpr unsigned int most_varied_keys = 20;
constexpr unsigned int most_runs = 100000;

/// The values of "first : last : step" or "first : last / number", otherwise the text itself, which
/// may be an expression with a colon.
std::vector<std::string> values_of(const std::string& text) {
  static const std::regex range(R"(([^:?]+):([^:/]+)([:/])([^:/]+))");
  constexpr unsigned int longest = 200; // regular expressions of the library recurse
  if (text.size() > longest)
    return {text};
  static const std::regex two_numbers(R"([-+.0-9eE ]+:[-+.0-9eE ]+)");
  if (std::regex_match(text, two_numbers))
    throw BadInput(in_quotes(text) +
                   " lacks a part: a range is first : last : step, or first : last / number");
  std::smatch parts;
  if (!std::regex_match(text, parts, range))
    return {text};
  const double first = to_number(trimmed(parts[1])), last = to_number(trimmed(parts[2]));
  const std::string third = trimmed(parts[4]);
  const bool has_step = parts[3] == ":";
  double step = 0, n_values = 0;
  if (has_step) {
    step = to_number(third);
    n_values = step == 0 ? 0 : std::floor((last - first) / step + 1e-9) + 1;
  } else {
    n_values = to_count(third, 2, most_runs);
    step = (last - first) / (n_values - 1);
  }
  if (!(n_values >= 1))
    throw BadInput(in_quotes(text) + " has no value: its step leads away from the last one");
  if (n_values > most_runs)
    throw BadInput(in_quotes(text) + " has more than " + std::to_string(most_runs) + " values");
  std::vector<std::string> values;
  for (unsigned int i = 0; i < n_values; ++i) {
    const double value = first + i * step;
    values.push_back(rounded(std::abs(value) < 1e-12 * std::abs(step) ? 0. : value, 12));
  }
  return values;
}

/// "Key & Key = value & value | ..." or "Key = value | ...".
Variation parse_variation(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos)
    throw BadInput(in_quotes(text) + " has no values; it must be Section/Key = value | value");
  std::vector<Setting> keys;
  for (const std::string& key : split(text.substr(0, equals), '&'))
    keys.push_back(parse_setting(key + "=", "Study/Vary"));
  if (keys.empty())
    throw BadInput(in_quotes(text) + " names no key before its values");
  Variation variation;
  for (const std::string& choice : split(text.substr(equals + 1), '|'))
    for (const std::string& value : keys.size() == 1 ? values_of(choice) : std::vector{choice}) {
      const auto values = keys.size() == 1 ? std::vector{value} : split(value, '&');
      if (values.size() != keys.size())
        throw BadInput(in_quotes(choice) + " does not have one value for each of the " +
                       std::to_string(keys.size()) + " keys that move together");
      variation.push_back(keys);
      for (unsigned int k = 0; k < keys.size(); ++k)
        variation.back()[k].value = values[k];
    }
  return variation;
}

/// Refuses keys of the study itself. @p what changes them
void require_key_of_a_scene(const Setting& setting, const std::string& what) {
  if (setting.section == "Study" || setting.section == "Output")
    throw BadInput(
        what + " cannot change " + in_quotes(setting.path()) +
        ", which is the same for all runs of a study" +
        (setting.section == "Output" ? "; Study/Files of each run writes files of each run" : ""));
}

std::vector<Variation> parse_vary(const std::string& text) {
  std::vector<Variation> vary;
  std::set<std::string> keys;
  double n_runs = 1;
  for (const std::string& part : split(text, ';')) {
    vary.push_back(parse_variation(part));
    n_runs *= vary.back().size();
    if (vary.back().empty())
      throw BadInput(in_quotes(part) + " gives no value");
    if (n_runs > most_runs)
      throw BadInput("these are more than " + std::to_string(most_runs) + " runs");
    for (const Setting& setting : vary.back().front()) {
      require_key_of_a_scene(setting, "Study/Vary");
      if (!keys.insert(setting.path()).second)
        throw BadInput(in_quotes(setting.path()) + " is varied twice");
      if (keys.size() > most_varied_keys)
        throw BadInput("these are more than " + std::to_string(most_varied_keys) + " keys");
    }
  }
  return vary;
}

std::vector<NamedScene> parse_scenes(const std::string& text) {
  std::vector<NamedScene> scenes;
  for (const std::string& part : split(text, ';')) {
    const auto colon = part.find(':');
    if (colon == 0 || colon == std::string::npos || part.find('"') < colon)
      throw std::invalid_argument("");
    scenes.push_back({trimmed(part.substr(0, colon)), {}});
    for (const std::string& assignment : split(part.substr(colon + 1), '&')) {
      scenes.back().settings.push_back(parse_setting(assignment, "Study/Scenes"));
      require_key_of_a_scene(scenes.back().settings.back(), "Study/Scenes");
    }
  }
  return scenes;
}

std::vector<std::optional<unsigned int>> parse_counts(const std::string& text) {
  std::vector<std::optional<unsigned int>> counts;
  for (const std::string& part : split(text, ','))
    if (part == "-")
      counts.emplace_back();
    else
      counts.emplace_back(to_count(part, 1, 1000000000));
  return counts;
}

} // namespace

void declare_study(Declarations& keys, StudyOptions& study) {
  keys.enter("Study");
  keys.add(
      "Vary", "", [&study](const std::string& text) { study.vary = parse_vary(text); },
      "Empty for a single scene, otherwise the keys to vary and their values, as in "
      "\"Mesh/Degree = 1 | 2; Contact/Rho = 1 | 2 | 3\": every combination is run, the last key "
      "varies fastest. A value may be a range, first : last : step or first : last / number, as in "
      "\"Road/Distance = 0.6 : 0.9 : 0.05\". Keys joined by & move together, as in \"Mesh/Radial "
      "cells & Mesh/Angular cells = 4 & 48 | 8 & 96\". At most 20 keys, each once and none of "
      "Study and Output, in at most 100000 combinations.");
  keys.add(
      "Scenes", "", [&study](const std::string& text) { study.scenes = parse_scenes(text); },
      "Empty, or scenes that differ from the file's in several keys at once: a name and settings "
      "for each, as in \"flat: Road/Distance = 0.9; small hub: Cylinder/Inner radius = 0.1 & "
      "Mesh/Radial cells = 8\". Every scene is run with every combination of Vary.");
  keys.add(
      "Published steps", "",
      [&study](const std::string& text) { study.published_steps = parse_counts(text); },
      "Numbers of contact steps to print beside ours: one for each run in the order of the runs, "
      "separated by commas, - where none is known.");
  keys.add_flag("True errors", study.true_errors,
                "whether to compare every run of a study with the exact solution of its scene, and "
                "to time it in full; where none is known, the certified error is all there is.");
  keys.add(
      "Files of each run", "",
      [&study](const std::string& text) {
        study.files_of_each_run = text.empty() ? std::set<OutputFile>() : parse_files(text);
      },
      "The files to write for each run of a study, any of those of Output/Files, into run-001, "
      "run-002 and so on in the directory of the study. With solution, study.pvd is the series of "
      "all fields for ParaView.");
}

} // namespace rollwave
