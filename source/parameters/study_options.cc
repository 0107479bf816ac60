#include "rollwave/parameters/study_options.h"

#include <algorithm>
#include <stdexcept>

namespace rollwave {

namespace {

/// A study lists all of its combinations before it begins.
constexpr unsigned int most_varied_keys = 20;
constexpr unsigned int most_runs = 100000;

} // namespace

std::vector<std::vector<Setting>> parse_vary(const std::string& text) {
  std::vector<std::vector<Setting>> vary;
  double n_runs = 1;
  for (const std::string& part : split(text, ';')) {
    const Setting all = parse_setting(part, "Study/Vary");
    vary.emplace_back();
    for (const std::string& value : split(all.value, '|'))
      vary.back().push_back({all.section, all.key, value, all.origin});
    n_runs *= vary.back().size();
    const auto is_same_key = [&all](const auto& list) { return list[0].path() == all.path(); };
    if (all.section == "Study" || all.section == "Output" || vary.back().empty() ||
        vary.size() > most_varied_keys || n_runs > most_runs ||
        std::any_of(vary.begin(), vary.end() - 1, is_same_key))
      throw std::invalid_argument("");
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
      const std::string& section = scenes.back().settings.back().section;
      if (section == "Study" || section == "Output")
        throw std::invalid_argument("");
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

} // namespace rollwave
