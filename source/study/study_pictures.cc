#include "rollwave/study/study_pictures.h"

#include "rollwave/adapt/marking.h"
#include "rollwave/base/text.h"
#include "rollwave/plot/plots.h"
#include "rollwave/run/quantities.h"
#include "rollwave/scene/units.h"
#include "rollwave/study/convergence.h"
#include "rollwave/study/study_title.h"

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>
#include <tuple>

namespace rollwave {

namespace {

/// The numbers that a key takes in all runs, without entries where one of its values is no number.
std::vector<double> numbers_of(const Study& study, unsigned int key) {
  std::vector<double> numbers;
  try {
    for (const RunPlan& plan : study.plans)
      numbers.push_back(to_number(plan.varied[key].value));
  } catch (const std::invalid_argument&) {
    return {};
  }
  return numbers;
}

/// The key that varies fastest: the first of the last part of Study/Vary, which must not be empty.
const Setting& fastest_key(const Study& study, const RunPlan& plan) {
  return plan.varied[study.first_key_of_part.back()];
}

/// True for the keys of the scene, false for those of the method.
bool is_of_scene(const Setting& setting) {
  return key_of(setting).affects & Affects::scene;
}

/// Curves of a quantity over the first key of the last part of Study/Vary, one for each choice of
/// the other keys; another quantity gives the marks, and the bounds of a vertical load the band.
/// @param x of each run, where it is known
std::vector<Curve> curves_of(const Study& study, const std::vector<std::optional<double>>& x,
                             const std::string& quantity, const std::string& marks = "") {
  std::vector<Curve> curves;
  const bool has_bounds = quantity == "contact.vertical_load";
  for (unsigned int run = 0; run < study.plans.size(); ++run) {
    const RunPlan& plan = study.plans[run];
    const auto fastest = plan.varied.begin() + study.first_key_of_part.back();
    if (run % study.n_fastest == 0)
      curves.push_back({label(plan, {plan.varied.begin(), fastest}), {}});
    if (!x[run])
      continue;
    CurvePoint point = {*x[run], study.value(run, quantity)};
    if (has_bounds) {
      point.lower = study.value(run, quantity + "_lower_bound");
      point.upper = study.value(run, quantity + "_upper_bound");
    }
    point.mark = study.value(run, marks);
    curves.back().points.push_back(point);
  }
  return curves;
}

std::string x_label_of(const Study& study) {
  return axis_label(fastest_key(study, study.plans.front()), study.units());
}

/// The values of a quantity in all runs.
std::vector<std::optional<double>> values_in_runs(const Study& study, const std::string& quantity) {
  std::vector<std::optional<double>> values;
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    values.push_back(study.value(run, quantity));
  return values;
}

std::string label_of(const Study& study, const ResultQuantity& quantity) {
  return quantity.words + (quantity.symbol.empty() ? "" : ' ' + quantity.symbol) +
         study.units().in_brackets(quantity.quantity);
}

/// True if all runs are calibrations.
bool calibrates(const Study& study) {
  return std::all_of(study.plans.begin(), study.plans.end(),
                     [](const RunPlan& plan) { return plan.parameters.road.calibrates(); });
}

/// The result of a scene: the shear modulus if all runs are calibrations, the deflection if all
/// give a load or a nip, otherwise the vertical load.
const ResultQuantity& main_result(const Study& study) {
  if (calibrates(study))
    return result_quantity("contact.calibrated_shear_modulus");
  const bool has_load =
      std::all_of(study.plans.begin(), study.plans.end(),
                  [](const RunPlan& plan) { return !plan.parameters.road.has_distance(); });
  return result_quantity(has_load ? "scene.deflection" : "contact.vertical_load");
}

/// True if a curve goes back and forth: keys that vary together may repeat the first one's numbers.
bool is_zigzag(const Panel& panel) {
  for (const Curve& curve : panel.curves) {
    std::set<double> x;
    for (const CurvePoint& point : curve.points)
      if (!x.insert(point.x).second)
        return true;
  }
  return false;
}

/// A panel for each quantity that is drawn over the key that varies fastest. If this key is the
/// distance, the load or the nip, the first panel is the vertical load over the deflection;
/// otherwise, and for calibrations, it is the main_result() over this key.
std::vector<Panel> curve_panels(const Study& study, const std::vector<std::optional<double>>& x) {
  const std::string& key = fastest_key(study, study.plans.front()).key;
  const bool has_deflections =
      !calibrates(study) && (key == "Distance" || key == "Load" || key == "Nip");
  const ResultQuantity& deflection = result_quantity("scene.deflection");
  std::vector<Panel> panels;
  const auto add = [&](const std::string& x_label, const std::vector<std::optional<double>>& over,
                       const ResultQuantity& quantity) {
    const Panel panel = {x_label, label_of(study, quantity), curves_of(study, over, quantity.name)};
    if (!is_zigzag(panel))
      panels.push_back(panel);
  };
  for (const ResultQuantity& quantity : result_quantities())
    if (!(quantity.shown & Shown::curve))
      continue;
    else if (quantity.name != "contact.vertical_load")
      add(x_label_of(study), x, quantity);
    else if (has_deflections)
      add(label_of(study, deflection), values_in_runs(study, deflection.name), quantity);
    else
      add(x_label_of(study), x, main_result(study));
  return panels;
}

/// True if no run has a value: gnuplot refuses such a panel.
bool is_empty(const Panel& panel) {
  for (const Curve& curve : panel.curves)
    for (const CurvePoint& point : curve.points)
      if (point.y)
        return false;
  return true;
}

/// The pressure of a run over the length along the road, in the user's units.
std::vector<CurvePoint> points_of_profile(const Study& study, unsigned int run) {
  std::vector<CurvePoint> points;
  for (const ProfilePoint& point : study.runs[run]->profile)
    points.push_back({point.road_length, point.pressure});
  return points;
}

/// Pressures over the length along the road. Of many runs it has the same few values of the key
/// that varies fastest, in colours, for each choice of the others, in dashes.
Panel profile_panel(const Study& study, std::string& title) {
  const Units units = study.units();
  Panel panel{"length along the road" + units.in_brackets(Quantity::length),
              "contact pressure" + units.in_brackets(Quantity::pressure),
              {}};
  const unsigned int n_values = study.n_fastest, n_choices = study.runs.size() / n_values;
  const auto choices = spread(n_choices, n_values > 1 ? most_curves / 2 : most_curves),
             values = spread(n_values, most_curves / choices.size());
  for (unsigned int i = 0; i < choices.size(); ++i)
    for (unsigned int k = 0; k < values.size(); ++k) {
      const unsigned int run = choices[i] * n_values + values[k];
      if (!study.runs[run] || study.runs[run]->profile.empty())
        continue;
      panel.curves.push_back(
          {label(study.plans[run], study.plans[run].varied), points_of_profile(study, run)});
      if (choices.size() > 1 && values.size() > 1)
        panel.curves.back().style = LineStyle{k, i};
    }
  if (panel.curves.size() < study.runs.size())
    title += ", " + std::to_string(panel.curves.size()) + " of " +
             std::to_string(study.runs.size()) + " runs";
  return panel;
}

/// The main_result() over two keys of the scene that have more numbers than curves can show;
/// nullopt for other studies.
std::optional<Picture> map_of_result(const Study& study, const std::string& title) {
  if (study.first_key_of_part.size() != 2 || !study.plans.front().scene.empty())
    return {};
  const auto x = numbers_of(study, 0), y = numbers_of(study, study.first_key_of_part[1]);
  const auto& varied = study.plans.front().varied;
  const std::size_t n_x = std::set(x.begin(), x.end()).size(),
                    n_y = std::set(y.begin(), y.end()).size();
  // Keys that vary together may repeat the first one's numbers.
  if (!study.is_of_scenes() || n_x <= most_curves || n_y <= most_curves ||
      n_x * n_y != study.plans.size())
    return {};
  const ResultQuantity& result = main_result(study);
  std::vector<std::vector<MapPoint>> lines;
  for (unsigned int run = 0; run < x.size(); ++run) {
    if (run == 0 || x[run] != x[run - 1])
      lines.emplace_back();
    lines.back().push_back({x[run], y[run], study.value(run, result.name)});
  }
  for (auto& line : lines)
    std::sort(line.begin(), line.end(),
              [](const MapPoint& one, const MapPoint& other) { return one.y < other.y; });
  std::sort(lines.begin(), lines.end(),
            [](const auto& one, const auto& other) { return one[0].x < other[0].x; });
  const Units units = study.units();
  return plot_map(title, axis_label(varied[0], units),
                  axis_label(varied[study.first_key_of_part[1]], units), label_of(study, result),
                  lines);
}

} // namespace

std::vector<double> fastest_numbers(const Study& study) {
  return study.first_key_of_part.empty() ? std::vector<double>()
                                         : numbers_of(study, study.first_key_of_part.back());
}

void draw_study(const Parameters& parameters, const Study& study, WrittenFiles& written) {
  const std::string title = study_title(study, parameters.settings);
  std::vector<Picture> pictures;
  const auto add = [&](const std::string& name, std::vector<Panel> panels,
                       const std::string& title) {
    panels.erase(std::remove_if(panels.begin(), panels.end(), is_empty), panels.end());
    if (!panels.empty())
      pictures.push_back(plot_panels(name, title, panels));
  };
  const auto numbers = fastest_numbers(study);
  const std::vector<std::optional<double>> x(numbers.begin(), numbers.end());
  const bool is_over_method = !x.empty() && !is_of_scene(fastest_key(study, study.plans.front()));
  if (const auto map = map_of_result(study, title))
    pictures.push_back(*map);
  if (!is_over_method) {
    if (!x.empty() && study.n_fastest > 1) // one point is no curve
      add("study-curves", curve_panels(study, x), title);
    std::string title_of_profiles = title;
    const Panel profiles = profile_panel(study, title_of_profiles);
    add("study-profiles", {profiles}, title_of_profiles);
  }
  const bool has_errors =
      study.has("error.exact_relative") || study.has("error.certified_relative");
  if (has_errors && find_families(study).size() < study.plans.size())
    for (const auto& [name, figure, label, order] :
         {std::tuple("study-h", "mesh.h_max",
                     "h, the largest diameter of a cell" +
                         study.units().in_brackets(Quantity::length),
                     1.),
          {"study-unknowns", "mesh.dofs", std::string("unknowns"), -0.5},
          {"study-time", "seconds.total", std::string("seconds"), 0.}})
      add(name, {error_panel(study, figure, label, order)}, title);
  // On an adaptive mesh the contact iteration begins with the contact of the mesh before, so that
  // its steps are few and not comparable.
  const bool is_adaptive =
      std::any_of(study.plans.begin(), study.plans.end(),
                  [](const RunPlan& plan) { return most_cycles(plan.parameters.mesh) > 0; });
  if (!x.empty() && !is_adaptive && (is_over_method || study.has("published_steps"))) {
    const Panel steps = {x_label_of(study), "contact steps",
                         curves_of(study, x, "iterations.contact", "published_steps"), false, true};
    if (!is_zigzag(steps))
      add("study", {steps}, title);
  }
  draw(pictures, parameters.output.directory, parameters.output.picture_format, written);
}

} // namespace rollwave
