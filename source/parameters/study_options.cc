#include "rollwave/parameters/study_options.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/text.h"
#include "rollwave/parameters/keys.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rollwave {

using namespace dealii;

namespace {

/// A study lists all of its combinations before it begins.
constexpr unsigned int most_runs = 100000;

/// The parts between separators that are not in double quotes, trimmed; none for an empty text.
std::vector<std::string> split_unquoted(const std::string& text, char separator) {
  if (trimmed(text).empty())
    return {};
  std::vector<std::string> parts(1);
  bool is_quoted = false;
  for (const char c : text) {
    is_quoted = is_quoted != (c == '"');
    if (c == separator && !is_quoted)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  std::transform(parts.begin(), parts.end(), parts.begin(), trimmed);
  return parts;
}

std::string without_quotes(const std::string& text) {
  const bool is_quoted = text.size() > 1 && text.front() == '"' && text.back() == '"';
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

/// The values of "first : last : step" or "first : last / number", otherwise the text itself, which
/// may be an expression with a colon.
std::vector<std::string> values_of(const std::string& text) {
  auto parts = split(text, ':');
  const auto counted = parts.size() == 2 ? split(parts[1], '/') : std::vector<std::string>();
  if (counted.size() == 2)
    parts = {parts[0], counted[0], counted[1]};
  const Patterns::Double number;
  if (parts.size() != 3 || !std::all_of(parts.begin(), parts.end(), [&](const std::string& part) {
        return number.match(part);
      }))
    return {without_quotes(text)};
  const double first = converted<double>(parts[0], number),
               last = converted<double>(parts[1], number),
               third = converted<double>(parts[2], number);
  const double n_values = !counted.empty() ? third
                          : third == 0     ? 0
                                           : std::floor((last - first) / third + 1e-9) + 1;
  if (!(n_values >= 1 && n_values <= most_runs) ||
      (!counted.empty() && (n_values < 2 || n_values != std::floor(n_values))))
    throw BadInput(in_quotes(text) + " is no range of 1 to " + std::to_string(most_runs) +
                   " values: first : last : step, or first : last / number");
  const double step = counted.empty() ? third : (last - first) / (n_values - 1);
  std::vector<std::string> values;
  for (unsigned int i = 0; i < n_values; ++i) {
    const double value = first + i * step;
    values.push_back(rounded(std::abs(value) < 1e-12 * std::abs(step) ? 0. : value, 12));
  }
  return values;
}

/// The assignment to a key that may differ between the runs of a study.
Setting parse_run_setting(const std::string& text, const Keys& keys) {
  Setting setting = parse_setting(text, "section Study");
  if ((keys.at(setting).affects & ~Affects::files) == 0)
    throw BadInput(setting.path() +
                   " cannot be varied; Study/Files of each run writes files of each run");
  setting.value = without_quotes(setting.value);
  setting.origin = keys.current_origin() + ", section Study";
  return setting;
}

/// "Key & Key = value & value | ..." or "Key = value | ...".
Variation parse_variation(const std::string& text, const Keys& keys) {
  const auto equals = text.find('=');
  const auto names = split(text.substr(0, equals), '&');
  if (equals == std::string::npos || names.empty())
    throw BadInput(in_quotes(text) + " is not of the form Section/Key = value | value");
  Variation variation;
  for (const std::string& choice : split_unquoted(text.substr(equals + 1), '|'))
    for (const std::string& value : names.size() == 1 ? values_of(choice) : std::vector{choice}) {
      const auto values = names.size() == 1 ? std::vector{value} : split_unquoted(value, '&');
      if (values.size() != names.size())
        throw BadInput(in_quotes(choice) + " does not have one value for each of the " +
                       std::to_string(names.size()) + " keys that vary together");
      variation.emplace_back();
      for (unsigned int k = 0; k < names.size(); ++k) {
        variation.back().push_back(parse_run_setting(names[k] + "=", keys));
        variation.back().back().value = without_quotes(values[k]);
      }
    }
  if (variation.empty())
    throw BadInput(in_quotes(text) + " gives no value");
  return variation;
}

std::vector<Variation> parse_vary(const std::string& text, const Keys& keys) {
  std::vector<Variation> vary;
  std::set<std::string> paths;
  double n_runs = 1;
  for (const std::string& part : split_unquoted(text, ';')) {
    vary.push_back(parse_variation(part, keys));
    n_runs *= vary.back().size();
    if (n_runs > most_runs)
      throw BadInput("these are more than " + std::to_string(most_runs) + " runs");
    for (const Setting& setting : vary.back().front())
      if (!paths.insert(setting.path()).second)
        throw BadInput(setting.path() + " is varied twice");
  }
  return vary;
}

std::vector<NamedScene> parse_scenes(const std::string& text, const Keys& keys) {
  std::vector<NamedScene> scenes;
  for (const std::string& part : split_unquoted(text, ';')) {
    const auto colon = part.find(':');
    if (colon == 0 || colon == std::string::npos || part.find('"') < colon)
      throw BadInput("");
    scenes.push_back({trimmed(part.substr(0, colon)), {}});
    for (const std::string& assignment : split_unquoted(part.substr(colon + 1), '&'))
      scenes.back().settings.push_back(parse_run_setting(assignment, keys));
  }
  return scenes;
}

std::vector<std::optional<unsigned int>> parse_counts(const std::string& text) {
  const Patterns::Integer count(1);
  std::vector<std::optional<unsigned int>> counts;
  for (const std::string& part : split(text, ','))
    counts.push_back(part == "-" ? std::nullopt
                                 : std::optional(converted<unsigned int>(part, count)));
  return counts;
}

} // namespace

void declare_study(Keys& keys, StudyOptions& study) {
  keys.enter("Study", Affects::files);
  keys.add_parsed(
      "Vary", "", [&](const std::string& text) { study.vary = parse_vary(text, keys); },
      "Empty for a single scene, otherwise the keys to vary and their values, as in "
      "\"Mesh/Degree = 1 | 2; Contact/Rho = 1 | 2 | 3\": every combination is run, the last key "
      "varies fastest. A value may be a range, first : last : step or first : last / number, as in "
      "\"Road/Distance = 0.6 : 0.9 : 0.05\". Keys joined by & vary together, as in \"Mesh/Radial "
      "cells & Mesh/Angular cells = 4 & 48 | 8 & 96\". Double quotes around a value protect the "
      "signs | & ; : in it. Each key at most once and none of Study and Output, in at most 100000 "
      "combinations.");
  keys.add_parsed(
      "Scenes", "", [&](const std::string& text) { study.scenes = parse_scenes(text, keys); },
      "Empty, or scenes that differ from the file's in several keys at once: a name and settings "
      "for each, as in \"flat: Road/Distance = 0.9; small hub: Cylinder/Inner radius = 0.1 & "
      "Mesh/Radial cells = 8\", where double quotes protect the signs & and ; in a value. Every "
      "scene is run with every combination of Vary.");
  keys.add_parsed(
      "Published steps", "",
      [&](const std::string& text) { study.published_steps = parse_counts(text); },
      "Published numbers of contact steps, which tables and plots show next to the computed ones: "
      "one for each run in the order of the runs, separated by commas, - where unknown.");
  keys.add("True errors", study.true_errors, Patterns::Bool(),
           "\"true\" or \"false\": compare every run of a study with the exact solution of its "
           "scene, where it is known, and measure its full time.");
  keys.add_parsed(
      "Files of each run", "",
      [&](const std::string& text) {
        study.files_of_each_run = text.empty() ? std::set<OutputFile>() : parse_files(text);
      },
      "Files to write for each run of a study, any of those of Output/Files, into run-001, "
      "run-002 and so on in the directory of the study. With solution, study.pvd is the series of "
      "all fields for ParaView.");
}

} // namespace rollwave
