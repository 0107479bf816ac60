#include "rollwave/study/study_files.h"

#include "rollwave/adapt/marking.h"
#include "rollwave/base/atomic_file.h"
#include "rollwave/base/text.h"
#include "rollwave/parameters/parameters.h"
#include "rollwave/scene/units.h"
#include "rollwave/study/convergence.h"
#include "rollwave/study/study_plot.h"
#include "rollwave/study/study_table.h"

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// The numbers that a key takes in all runs; none where it has a value that is no number.
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

/// Those of a study have names in common.
Units units_of(const Study& study) {
  return {1, study.plans.front().parameters.material};
}

bool is_of_scene(const Setting& setting) {
  return key_of(setting).affects & Affects::scene;
}

/// The values that all runs share: the keys that titles name, and others of the scene that are not
/// at their defaults. Named scenes share the method only.
std::string title_of(const Study& study) {
  const RunPlan& plan = study.plans.front();
  const std::vector<Setting>& settings = plan.parameters.settings;
  std::string title;
  for (const Key& key : all_keys()) {
    const Setting setting{key.section, key.name, value_of(key, settings), ""};
    const bool is_shared =
        !last_of(plan.varied, key.path()) &&
        (plan.scene.empty() || !(key.affects & (Affects::scene | Affects::mesh)));
    const bool is_named = (key.affects & Affects::titles) ||
                          ((key.affects & Affects::scene) && setting.value != key.default_value);
    if (is_shared && is_named && setting.value != "none")
      title += (title.empty() ? "" : ", ") + told(setting, units_of(study));
  }
  return title + (most_cycles(plan.parameters.mesh) > 0 ? ", adaptive" : "");
}

/// For each choice of all keys but those that vary fastest a curve of a figure over the first of
/// these, with that of another as marks.
std::vector<Curve> curves_of(const Study& study, const std::vector<double>& x,
                             const std::string& figure, const std::string& marks = "") {
  std::vector<Curve> curves;
  for (unsigned int run = 0; run < study.plans.size(); ++run) {
    const RunPlan& plan = study.plans[run];
    const Setting* const last = &plan.varied[study.first_keys.back()];
    const std::string title =
        label(plan, [last](const Setting& setting) { return &setting < last; });
    // The keys before them change together with the text.
    if (curves.empty() || curves.back().title != title)
      curves.push_back({title, {}, {}});
    curves.back().points.emplace_back(x[run], study.figure(run, figure).value_or(nothing));
    if (study.has(marks))
      curves.back().marks.emplace_back(x[run], study.figure(run, marks).value_or(nothing));
  }
  return curves;
}

std::string x_label_of(const Study& study) {
  return words(study.plans.front().varied[study.first_keys.back()], units_of(study));
}

/// Loads, stiffness, half-width and pressure over the key that varies fastest.
std::vector<Panel> curves(const Study& study, const std::vector<double>& x) {
  std::vector<Panel> panels;
  for (const auto& [figure, name, quantity] :
       {std::tuple("force", "contact force F", Quantity::force),
        {"vertical_load", "vertical load", Quantity::force},
        {"work_conjugate_load", "work-conjugate load G", Quantity::force},
        {"stiffness_vertical_load", "vertical stiffness", Quantity::stiffness},
        {"half_width", "half-width of contact (angle)", Quantity::angle},
        {"peak_pressure", "peak pressure", Quantity::pressure}})
    panels.push_back({x_label_of(study), name + units_of(study).in_brackets(quantity),
                      curves_of(study, x, figure)});
  return panels;
}

/// The error over a figure for each family of runs that differ in the fineness of their meshes.
/// @param order_factor slopes over expected orders; 0 for none
Panel errors_of_families(const Study& study, const std::string& x, const std::string& x_label,
                         double order_factor) {
  Panel panel{x_label, "relative error in the energy norm", {}, true, true};
  std::set<double> slopes;
  for (const Family& family : find_families(study)) {
    if (x == "h_max" && (family.is_adaptive || !family.is_cut_alike))
      continue;
    Curve curve{family.name, {}};
    for (const unsigned int run : family.runs) {
      if (study.figure(run, x) && study.figure(run, "error_relative"))
        curve.points.emplace_back(*study.figure(run, x), *study.figure(run, "error_relative"));
      if (const auto order = study.figure(run, "expected_order");
          order && order_factor != 0 && family.is_cut_alike)
        slopes.insert(order_factor * *order);
    }
    std::sort(curve.points.begin(), curve.points.end());
    if (!curve.points.empty())
      panel.curves.push_back(std::move(curve));
  }
  panel.slopes.assign(slopes.begin(), slopes.end());
  return panel;
}

/// About as many runs as can be told apart: of the last key some values, of the others at most
/// three.
std::vector<unsigned int> runs_to_show(const Study& study) {
  constexpr unsigned int most = 12, most_rows = 3;
  const unsigned int n_runs = study.plans.size();
  if (n_runs <= most)
    return evenly(n_runs, n_runs);
  unsigned int n_columns = 1;
  const auto value = [&](unsigned int run) {
    return study.plans[run].varied.empty() ? "" : study.plans[run].varied.back().value;
  };
  while (n_columns < n_runs && value(n_columns) != value(0))
    ++n_columns;
  const auto rows = evenly(n_runs / n_columns, most_rows);
  std::vector<unsigned int> runs;
  for (const unsigned int row : rows)
    for (const unsigned int column : evenly(n_columns, most / rows.size()))
      runs.push_back(row * n_columns + column);
  return runs;
}

Panel profiles(const Study& study) {
  Panel panel{"angle from the lowest point, (z - 3π/2) / rad",
              "contact pressure" + units_of(study).in_brackets(Quantity::pressure),
              {}};
  for (const unsigned int run : runs_to_show(study))
    if (study.runs[run] && !study.runs[run]->pressure.empty()) {
      panel.curves.push_back({label(study.plans[run], [](const Setting&) { return true; }), {}});
      for (const auto& [z, pressure] : study.runs[run]->pressure)
        panel.curves.back().points.emplace_back(z - 3 * numbers::PI / 2, pressure);
    }
  return panel;
}

/// The vertical load over two keys; nullopt unless these alone vary, are of cylinder and road, and
/// numbers.
std::optional<Picture> map_of_load(const Study& study) {
  if (study.first_keys.size() != 2 || !study.plans.front().scene.empty())
    return {};
  const auto x = numbers_of(study, 0), y = numbers_of(study, study.first_keys[1]);
  const auto& varied = study.plans.front().varied;
  if (!std::all_of(varied.begin(), varied.end(), is_of_scene) || x.empty() || y.empty() ||
      x.front() == x.back() || y.front() == y.back())
    return {};
  std::vector<std::vector<std::array<double, 3>>> lines;
  for (unsigned int run = 0; run < x.size(); ++run) {
    if (run == 0 || x[run] != x[run - 1])
      lines.emplace_back();
    lines.back().push_back(
        {{x[run], y[run], study.figure(run, "vertical_load").value_or(nothing)}});
  }
  const Units units = units_of(study);
  return plot_map(title_of(study), words(varied[0], units),
                  words(varied[study.first_keys[1]], units),
                  "vertical load" + units.in_brackets(Quantity::force), lines);
}

/// The plots by their names.
std::vector<std::pair<std::string, Picture>> draw_study(const Study& study) {
  std::vector<std::pair<std::string, Picture>> pictures;
  const std::string title = title_of(study);
  const auto add = [&](const std::string& name, const std::vector<Panel>& panels,
                       const std::string& remark = "") {
    if (!panels.front().curves.empty())
      pictures.emplace_back(name, plot_panels(title + remark, panels));
  };
  const auto x =
      study.first_keys.empty() ? std::vector<double>() : numbers_of(study, study.first_keys.back());
  if (auto map = map_of_load(study))
    pictures.emplace_back("study-map.svg", std::move(*map));
  if (x.empty() || is_of_scene(study.plans.front().varied[study.first_keys.back()])) {
    if (!x.empty())
      add("study-curves.svg", curves(study, x));
    const Panel panel = profiles(study);
    const std::size_t n_shown = panel.curves.size(), n_runs = study.runs.size();
    add("study-profiles.svg", {panel},
        n_shown == n_runs
            ? ""
            : "; " + std::to_string(n_shown) + " of " + std::to_string(n_runs) + " runs");
  }
  if (study.has("error_relative") && find_families(study).size() < study.plans.size())
    for (const auto& [name, figure, label, order] :
         {std::tuple("study-h.svg", "h_max", "largest diameter of a cell h", 1.),
          {"study-unknowns.svg", "dofs", "unknowns", -0.5},
          {"study-time.svg", "seconds", "seconds", 0.}})
      add(name, {errors_of_families(study, figure, label, order)});
  if (!x.empty())
    add("study.svg", {{x_label_of(study), "contact steps",
                       curves_of(study, x, "contact_steps", "published_steps"), false, true}});
  return pictures;
}

/// The fields of the runs with the number of the key that varies fastest, or else of the run, as
/// time.
std::string pvd_of(const Study& study, const std::filesystem::path& directory) {
  const auto times =
      study.first_keys.empty() ? std::vector<double>() : numbers_of(study, study.first_keys.back());
  std::vector<std::pair<double, std::string>> files;
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    for (const char* const name : {"solution.vtu", "solution.pvtu"})
      if (study.runs[run] && !study.runs[run]->files.empty() &&
          std::filesystem::exists(directory / study.runs[run]->files / name))
        files.emplace_back(times.empty() ? run + 1 : times[run],
                           study.runs[run]->files + '/' + name);
  std::ostringstream text;
  DataOutBase::write_pvd_record(text, files);
  return text.str();
}

} // namespace

WrittenFiles write_study(const std::filesystem::path& directory, const Parameters& parameters,
                         const Study& study) {
  WrittenFiles written;
  for (const char* const name : {"study.csv", "study.jsonl", "parameters.prm"})
    written.files.push_back(directory / name);
  const auto add = [&](const std::string& name, const std::string& content) {
    write_file(directory / name, content);
    written.files.push_back(directory / name);
  };
  const StudyTable table(study);
  std::ostringstream text;
  text << table.header();
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    if (study.runs[run])
      text << table.row(run);
  print_study_notes(text, study);
  add("study.txt", text.str());
  add("study.tex", table.tex());
  const auto& kinds = parameters.study.files_of_each_run;
  if (std::count(kinds.begin(), kinds.end(), OutputFile::solution) > 0)
    add("study.pvd", pvd_of(study, directory));
  const bool is_solved = std::any_of(study.runs.begin(), study.runs.end(),
                                     [](const auto& run) { return run && run->is_solved(); });
  if (parameters.wants(OutputFile::plot) && is_solved) {
    for (const auto& [name, picture] : draw_study(study))
      if (picture.failure.empty())
        add(name, picture.svg);
      else
        written.remarks.push_back(name + " was not drawn: " + picture.failure);
  }
  return written;
}

} // namespace rollwave
