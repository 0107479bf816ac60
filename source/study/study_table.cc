#include "rollwave/study/study_table.h"

#include "rollwave/base/text.h"
#include "rollwave/run/quantities.h"
#include "rollwave/scene/units.h"
#include "rollwave/study/convergence.h"

#include <boost/algorithm/string/join.hpp>
#include <deal.II/base/table_handler.h>

#include <cmath>
#include <functional>
#include <map>
#include <ostream>
#include <sstream>
#include <vector>

namespace rollwave {

namespace {

/// @p text with the characters escaped that have a meaning in TeX.
std::string in_tex(const std::string& text) {
  std::string escaped;
  for (const char c : text)
    if (c == '\\')
      escaped += "\\textbackslash{}";
    else if (std::string("~^").find(c) != std::string::npos)
      escaped += std::string("\\") + c + "{}";
    else
      escaped += std::string("&%$#_{}").find(c) != std::string::npos ? std::string("\\") + c
                                                                     : std::string(1, c);
  return escaped;
}

std::string outcome_of(const RunRecord& run) {
  return !run.is_solved()                    ? "not solved"
         : shortfall_text(run.notes).empty() ? "solved"
                                             : "target not reached";
}

/// @param in_format makes a text one of the table's format
dealii::TableHandler make_table(const Study& study,
                                const std::function<std::string(const std::string&)>& in_format) {
  dealii::TableHandler table;
  const auto add = [&](const std::string& title, const std::string& text) {
    table.add_value(title, in_format(text.empty() ? "-" : text));
    table.set_tex_caption(title, in_tex(title));
  };
  const Units units = study.units();
  const bool has_published = study.has("published_steps");
  const unsigned int kind = study.is_of_scenes() ? Shown::scene_table : Shown::table;
  std::vector<ResultQuantity> shown;
  for (const ResultQuantity& quantity : result_quantities())
    if ((quantity.shown & kind) && study.has(quantity.name))
      shown.push_back(quantity);
  for (unsigned int run = 0; run < study.runs.size(); ++run) {
    if (!study.runs[run])
      continue;
    add("run", std::to_string(run + 1));
    if (!study.plans[run].scene.empty())
      add("scene", study.plans[run].scene);
    for (const Setting& setting : study.plans[run].varied)
      add(setting.key + units.in_brackets(key_of(setting).quantity), setting.value);
    if (has_published)
      add("published", study.plans[run].published_steps
                           ? std::to_string(*study.plans[run].published_steps)
                           : "-");
    for (const ResultQuantity& quantity : shown) {
      const auto value = study.value(run, quantity.name);
      add((quantity.symbol.empty() ? quantity.words : quantity.symbol) +
              units.in_brackets(quantity.quantity),
          value ? quantity.text(*value, study.value(run, quantity.name + "_uncertainty")) : "");
    }
    add("outcome", outcome_of(*study.runs[run]));
  }
  return table;
}

/// Prints the first of some texts, with its run and the number of runs that have one.
void print_first(std::ostream& out, const std::string& title,
                 const std::map<unsigned int, std::string>& texts, unsigned int n_runs) {
  if (!texts.empty())
    out << title << ", " << texts.size() << " of " << n_runs << " runs; run "
        << texts.begin()->first + 1 << ": " << texts.begin()->second << '\n';
}

/// True if runs have covers of several thicknesses and one shear modulus.
bool has_one_modulus_for_covers(const Study& study) {
  std::map<double, double> thickness_of; // by the shear modulus
  for (const RunPlan& plan : study.plans) {
    const Parameters& p = plan.parameters;
    if (!p.material.is_given() || p.road.calibrates())
      continue;
    const double thickness = p.cylinder.outer_radius - p.cylinder.inner_radius;
    const auto [known, is_first] = thickness_of.emplace(p.material.shear_modulus, thickness);
    if (!is_first && std::abs(known->second - thickness) > 1e-9 * thickness)
      return true;
  }
  return false;
}

} // namespace

std::string line_of_run(const Study& study, unsigned int run) {
  std::ostringstream line;
  line << run + 1 << " of " << study.plans.size() << "  "
       << label(study.plans[run], study.plans[run].varied) << ":  ";
  const bool has_load = !study.plans[run].parameters.road.has_distance();
  const ResultQuantity& result = result_quantity(has_load               ? "scene.road_distance"
                                                 : study.is_of_scenes() ? "contact.vertical_load"
                                                                        : "contact.force");
  if (const auto value = study.value(run, result.name))
    line << (result.symbol.empty() ? result.words : result.symbol) << " = " << rounded(*value, 6)
         << study.units().after(result.quantity) << ", "
         << study.value(run, "iterations.contact").value_or(0)
         << (study.value(run, "iterations.contact") == 1 ? " step, " : " steps, ")
         << rounded(study.value(run, "seconds.total").value_or(0), 3) << " s, ";
  line << outcome_of(*study.runs[run]);
  return line.str();
}

std::string table_as_tex(const Study& study) {
  std::ostringstream table;
  make_table(study, in_tex).write_tex(table, /*with_header=*/false);
  // In T1 the signs < > | are themselves.
  return "\\documentclass[10pt]{report}\n\\usepackage[T1]{fontenc}\n\\usepackage{float}\n\n"
         "\\begin{document}\n" +
         table.str() + "\\end{document}\n";
}

std::string study_text(const Study& study) {
  std::ostringstream out;
  out << table_text(make_table(study, [](const std::string& plain) { return plain; }));
  std::map<unsigned int, std::string> failures, shortfalls, remarks;
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    if (const auto& made = study.runs[run]) {
      if (const auto missed = shortfall_text(made->notes); !missed.empty())
        (made->is_solved() ? shortfalls : failures)[run] = missed;
      if (const auto texts = texts_of(made->notes, Note::Kind::remark); !texts.empty())
        remarks[run] = boost::algorithm::join(texts, "; ");
    }
  out << '\n';
  if (!study.is_of_scenes())
    out << "steps: of the contact iteration on the last mesh, for a given load at its last "
           "distance.\n";
  out << "seconds: with the certificate and the files of each run, if any; without start-up, "
         "exact\n"
         "solutions, and work reused from the run before (column shared of study.csv).\n";
  if (study.has("error.certified_relative"))
    out << "certified: guaranteed bound of the relative error in the energy norm.\n";
  if (study.has("error.exact_relative"))
    out << "error: true relative error in the energy norm, against the semi-analytic solution.\n";
  if (study.has("error.exact_distance"))
    out << "error of c: of the distance for the load; the other errors are those at the computed "
           "distance.\n";
  if (has_one_modulus_for_covers(study))
    out << "Note: the thickness varies under one shear modulus, which is an effective one: "
           "calibrate it anew for each thickness, by Road/Load and Road/Nip.\n";
  print_first(out, "Not solved", failures, study.runs.size());
  print_first(out, "Target not reached", shortfalls, study.runs.size());
  print_first(out, "Note", remarks, study.runs.size());
  report_orders(out, study);
  return out.str();
}

} // namespace rollwave
