#include "rollwave/parameters/study_options.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/text.h"
#include "rollwave/parameters/keys.h"
#include "rollwave/scene/expression.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace rollwave {

namespace {

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

/// The values of "first : last : step", otherwise the text itself, which may be an expression with
/// a colon. @throws BadInput for numbers that are no such range
std::vector<std::string> values_in(const std::string& text) {
  const auto parts = split(text, ':');
  const bool is_open = std::count(parts.begin(), parts.end(), "") > 0;
  std::vector<double> numbers;
  for (const std::string& part : parts)
    if (const auto number = value_if_any(part))
      numbers.push_back(*number);
  if (parts.size() < 2 || (numbers.size() < parts.size() && !is_open))
    return {text};
  if (parts.size() != 3 || is_open)
    throw BadInput(in_quotes(text) + " is no range first : last : step");
  const double first = numbers[0], last = numbers[1], step = numbers[2];
  constexpr unsigned int most_values = 100000;
  const double n_values = step == 0 ? 0 : std::floor((last - first) / step + 1e-9) + 1;
  if (!(n_values >= 1 && n_values <= most_values))
    throw BadInput(in_quotes(text) + " is no range first : last : step of 1 to " +
                   std::to_string(most_values) + " values; a range that falls has a negative step");
  std::vector<std::string> values;
  for (unsigned int i = 0; i < n_values; ++i) {
    const double value = first + i * step;
    values.push_back(rounded(std::abs(value) < 1e-12 * std::abs(step) ? 0. : value, 12));
  }
  return values;
}

/// The assignment of a value, which may be in quotes, to a key that may differ between the runs of
/// a study.
Assignment read_run_setting(const std::string& text, const Setting& study) {
  Setting setting = parse_setting(text, study.origin + ", section Study");
  setting.line = study.line;
  if (setting.section == "Study" || setting.section == "Output")
    throw BadInput(setting.path() + " cannot be varied");
  setting.value = without_quotes(setting.value);
  return read(setting);
}

/// "Key & Key = value & value | ..." or "Key = value | ...".
Variation parse_variation(const std::string& text, const Setting& study) {
  const auto equals = text.find('=');
  const auto names = split(text.substr(0, equals), '&');
  if (equals == std::string::npos || names.empty())
    throw BadInput(in_quotes(text) + " is not of the form Section/Key = value | value");
  Variation variation;
  const auto add = [&](const std::vector<std::string>& values) {
    if (values.size() != names.size())
      throw BadInput(in_quotes(text) + " does not have one value for each of the " +
                     std::to_string(names.size()) + " keys that vary together");
    variation.emplace_back();
    for (unsigned int k = 0; k < names.size(); ++k)
      variation.back().push_back(read_run_setting(names[k] + '=' + values[k], study));
  };
  for (const std::string& choice : split_unquoted(text.substr(equals + 1), '|'))
    if (choice.empty())
      throw BadInput(in_quotes(text) + " has no value before or after a |");
    else if (names.size() > 1)
      add(split_unquoted(choice, '&'));
    else
      for (const std::string& value : values_in(choice))
        add({value});
  if (variation.empty())
    throw BadInput(in_quotes(text) + " gives no value");
  return variation;
}

std::vector<Variation> parse_vary(const Setting& setting) {
  std::vector<Variation> vary;
  std::set<std::string> paths;
  for (const std::string& part : split_unquoted(setting.value, ';')) {
    vary.push_back(parse_variation(part, setting));
    for (const Setting& varied : vary.back().front())
      if (!paths.insert(varied.path()).second)
        throw BadInput(varied.path() + " is varied twice");
  }
  return vary;
}

std::vector<NamedScene> parse_scenes(const Setting& setting) {
  std::vector<NamedScene> scenes;
  for (const std::string& part : split_unquoted(setting.value, ';')) {
    const auto colon = part.find(':');
    if (colon == 0 || colon == std::string::npos || part.find('"') < colon)
      throw std::invalid_argument("");
    const std::string name = trimmed(part.substr(0, colon));
    if (std::any_of(scenes.begin(), scenes.end(),
                    [&](const NamedScene& scene) { return scene.name == name; }))
      throw BadInput("there are two scenes of the name " + in_quotes(name));
    scenes.push_back({name, {}});
    for (const std::string& assignment : split_unquoted(part.substr(colon + 1), '&'))
      scenes.back().settings.push_back(read_run_setting(assignment, setting));
  }
  return scenes;
}

std::vector<std::optional<unsigned int>> parse_counts(const std::string& text) {
  std::vector<std::optional<unsigned int>> counts;
  for (std::string& part : split(text, ','))
    counts.push_back(part == "-" ? std::nullopt
                                 : std::optional(convert_number(part, {1, 1e9}, true)));
  return counts;
}

} // namespace

void check_scenes(const StudyOptions& study) {
  std::set<std::string> varied;
  for (const Variation& variation : study.vary)
    for (const Setting& setting : variation.front())
      varied.insert(setting.path());
  // A distance takes the place of load and nip, and the other way round.
  if (varied.count("Road/Distance") > 0)
    varied.insert({"Road/Load", "Road/Nip"});
  else if (varied.count("Road/Load") > 0 || varied.count("Road/Nip") > 0)
    varied.insert("Road/Distance");
  for (const NamedScene& scene : study.scenes) {
    std::set<std::string> paths;
    for (const Setting& setting : scene.settings)
      if (!paths.insert(setting.path()).second || varied.count(setting.path()))
        throw RefusedSetting(setting, "the scene " + in_quotes(scene.name) +
                                          " or Study/Vary gives the key another value");
  }
}

void declare_study(Section<StudyOptions> keys) {
  keys.declare(
      "Vary", "",
      [](Setting& setting) {
        return [vary = parse_vary(setting)](Parameters& p) { p.study.vary = vary; };
      },
      "Empty for a single scene, otherwise the keys to vary and their values, as in "
      "\"Mesh/Degree = 1 | 2; Contact/Rho = 1 | 2 | 3\": every combination is run, the last key "
      "varies fastest. A value may be a range first : last : step, as in \"Road/Distance = 0.6 : "
      "0.9 : 0.05\". Keys joined by & vary together, as in \"Mesh/Radial "
      "cells & Mesh/Angular cells = 4 & 48 | 8 & 96\". Double quotes around a value protect the "
      "signs | & ; : in it. Keys of Study and Output cannot be varied, and each key at most once.");
  keys.declare(
      "Scenes", "",
      [](Setting& setting) {
        return [scenes = parse_scenes(setting)](Parameters& p) { p.study.scenes = scenes; };
      },
      "Empty, or scenes that differ from the file's in several keys at once: a name and settings "
      "for each, as in \"flat: Road/Distance = 0.9; small hub: Cylinder/Inner radius = 0.1 & "
      "Mesh/Radial cells = 8\", where double quotes protect the signs & and ; in a value. Every "
      "scene is run with every combination of Vary.");
  keys.declare(
      "Published steps", "",
      [](Setting& setting) {
        return [counts = parse_counts(setting.value)](Parameters& p) {
          p.study.published_steps = counts;
        };
      },
      "Published numbers of contact steps, which tables and plots show next to the computed ones: "
      "one for each run in the order of the runs, separated by commas, - where unknown.");
  keys.add("True errors", &StudyOptions::true_errors,
           "\"true\" or \"false\": compare every run of a study with the exact solution of its "
           "scene, where it is known. The runs then share no work, so that the seconds of each "
           "are complete.");
  keys.declare(
      "Files of each run", "",
      [](Setting& setting) {
        const auto files =
            setting.value.empty() ? std::set<OutputFile>() : parse_files(setting.value);
        return [=](Parameters& p) { p.study.files_of_each_run = files; };
      },
      "Files to write for each run of a study, any of those of Output/Files, into a directory of "
      "the run, which study.csv names in the column files. With solution, study.pvd is the series "
      "of all fields for ParaView.");
}

} // namespace rollwave
