#include "rollwave/study/study_record.h"

#include "rollwave/run/quantities.h"

#include <algorithm>
#include <cmath>

namespace rollwave {

std::vector<unsigned int> Study::wanted_runs() const {
  const StudyPart wanted = part.value_or(StudyPart());
  std::vector<unsigned int> numbers;
  for (unsigned int run = wanted.number - 1; run < plans.size(); run += wanted.count)
    numbers.push_back(run);
  return numbers;
}

std::size_t Study::n_ended() const {
  return runs.size() - std::count(runs.begin(), runs.end(), std::nullopt);
}

std::optional<double> Study::value(unsigned int run, const std::string& name) const {
  if (name == "published_steps")
    return plans[run].published_steps;
  if (runs[run])
    if (const auto known = runs[run]->values.find(name); known != runs[run]->values.end())
      return known->second;
  result_quantity(name); // throws for another name
  return {};
}

bool Study::has(const std::string& name) const {
  for (unsigned int run = 0; run < runs.size(); ++run)
    if (value(run, name).value_or(0) > 0)
      return true;
  return false;
}

bool Study::is_of_scenes() const {
  const auto& varied = plans.front().varied;
  return std::all_of(varied.begin(), varied.end(), [](const Setting& setting) {
    return key_of(setting).affects & Affects::scene;
  });
}

std::map<std::string, double> values_of(const Result& result, const Units& units) {
  std::map<std::string, double> values;
  for (const ResultQuantity& quantity : result_quantities())
    if (const auto value = quantity.in_users_units(result, units); value && std::isfinite(*value))
      values[quantity.name] = *value;
  return values;
}

std::vector<std::pair<double, double>> pressure_of(const Result& result, const Units& units) {
  const auto& rows = result.contact_rows;
  const auto presses = [](const ContactRow& row) { return row.pressure > 0; };
  const auto first = std::find_if(rows.begin(), rows.end(), presses);
  const auto last = std::find_if(rows.rbegin(), rows.rend(), presses).base();
  std::vector<std::pair<double, double>> pressure;
  if (first == rows.end())
    return pressure;
  const std::ptrdiff_t begin = std::max<std::ptrdiff_t>(0, first - rows.begin() - 1),
                       end = std::min<std::ptrdiff_t>(rows.size(), last - rows.begin() + 1),
                       step = 1 + (end - begin) / 100;
  for (std::ptrdiff_t i = begin; i < end; ++i)
    if ((i - begin) % step == 0 || i + 1 == end)
      pressure.emplace_back(rows[i].angle, rows[i].pressure * units.of(Quantity::pressure));
  return pressure;
}

} // namespace rollwave
