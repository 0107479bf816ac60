#include "rollwave/study/study_table.h"

#include "rollwave/adapt/marking.h"
#include "rollwave/base/text.h"
#include "rollwave/scene/units.h"

#include <algorithm>
#include <cctype>
#include <iomanip>
#include <map>
#include <numeric>
#include <ostream>
#include <sstream>

namespace rollwave {

namespace {

std::string text_of(const std::optional<double>& value, int digits) {
  return value ? rounded(*value, digits) : "-";
}

/// @p text at the right of a column, and two blanks behind it.
std::string in_column(std::string text, unsigned int width) {
  if (text.size() > width)
    text = text.substr(0, width - 2) + "..";
  return std::string(width - text.size(), ' ') + text + "  ";
}

std::string line_of(const std::string& cells) {
  return cells.substr(0, cells.find_last_not_of(' ') + 1) + '\n';
}

/// Says each text once, with the runs that it holds for: texts that differ in their numbers only
/// count as the same.
void print_once(std::ostream& out, const std::string& what,
                const std::vector<std::pair<unsigned int, std::string>>& texts,
                unsigned int n_runs) {
  struct Kind {
    unsigned int first, count;
    std::string text;
  };
  std::map<std::string, Kind> kinds;
  for (const auto& [run, text] : texts) {
    std::string words = text;
    words.erase(
        std::remove_if(words.begin(), words.end(),
                       [](unsigned char c) { return std::isdigit(c) || c == '.' || c == '-'; }),
        words.end());
    ++kinds.try_emplace(words, Kind{run, 0, text}).first->second.count;
  }
  for (const auto& [words, kind] : kinds)
    out << what << ", " << kind.count << " of " << n_runs << " runs"
        << (kind.count > 1 ? ", such as run " : ", run ") << kind.first + 1 << ": " << kind.text
        << '\n';
}

bool any(const Study& study, const std::function<bool(const RunPlan&)>& is) {
  return std::any_of(study.plans.begin(), study.plans.end(), is);
}

} // namespace

StudyTable::StudyTable(const Study& study) : study(study), families(find_families(study)) {
  columns.push_back({"run", 4, [](unsigned int run) { return std::to_string(run + 1); }});
  add_settings();
  const Units units{1, study.plans.front().parameters.material};
  const bool is_certified =
      any(study, [](const RunPlan& plan) { return plan.parameters.certificate.error_bound; });
  if (any(study, [](const RunPlan& plan) { return most_cycles(plan.parameters.mesh) > 0; }))
    add_figure("N", 9, "dofs", 9);
  else
    add_figure("h" + units.in_brackets(Quantity::length), 8, "h_max", 3);
  add_figure("steps", 5, "contact_steps", 9);
  if (study.has("published_steps"))
    add_figure("published", 9, "published_steps", 9);
  if (study.has_true_errors)
    add_figure("error", 8, "error_relative", 3);
  if (is_certified)
    add_figure("certified", 9, "certified_relative", 3);
  if ((study.has_true_errors || is_certified) && families.size() < study.plans.size())
    columns.push_back({"order", 6, [this](unsigned int run) {
                         return text_of(observed_order(this->study, families, run), 3);
                       }});
  add_figure("F" + units.in_brackets(Quantity::force), 14, "force", 9);
  add_figure("seconds", 8, "seconds", 3);
  make_narrower();
}

/// Leaves out what tells least, until the table fits the screen. The keys, which tell the
/// runs apart, stay the longest.
void StudyTable::make_narrower() {
  constexpr unsigned int widest = 100, outcome = 11;
  const auto add_width = [](unsigned int sum, const Column& column) {
    return sum + column.width + 2;
  };
  for (const char* const title : {"steps", "certified", "published", "seconds", "order"}) {
    if (std::accumulate(columns.begin(), columns.end(), outcome, add_width) <= widest)
      return;
    const bool is_only_error = title == std::string("certified") && !study.has_true_errors;
    const auto is_it = [&](const Column& column) {
      return column.title == title && !is_only_error;
    };
    columns.erase(std::remove_if(columns.begin(), columns.end(), is_it), columns.end());
  }
  while (std::accumulate(columns.begin(), columns.end(), outcome, add_width) > widest)
    columns.erase(columns.begin() + 1); // the first of very many keys
}

void StudyTable::add_figure(const std::string& title, unsigned int width, const std::string& figure,
                            int digits) {
  columns.push_back({title, width, [this, figure, digits](unsigned int run) {
                       return text_of(study.figure(run, figure), digits);
                     }});
}

/// The name of the scene and the varied keys, as wide as their words and values are.
void StudyTable::add_settings() {
  const auto add = [this](const std::string& title,
                          const std::function<std::string(const RunPlan&)>& value) {
    constexpr std::size_t widest = 24;
    std::size_t width = 0;
    for (const std::string& word : split(title, ' '))
      width = std::max(width, word.size());
    for (const RunPlan& plan : study.plans)
      width = std::max(width, value(plan).size());
    columns.push_back({title, static_cast<unsigned int>(std::min(width, widest)),
                       [this, value](unsigned int run) { return value(study.plans[run]); }});
  };
  if (!study.plans.front().scene.empty())
    add("scene", [](const RunPlan& plan) { return plan.scene; });
  for (unsigned int k = 0; k < study.plans.front().varied.size(); ++k)
    add(study.plans.front().varied[k].key,
        [k](const RunPlan& plan) { return plan.varied[k].value; });
}

std::string StudyTable::header() const {
  std::size_t n_lines = 0;
  for (const Column& column : columns)
    n_lines = std::max(n_lines, split(column.title, ' ').size());
  std::string text;
  for (std::size_t line = 0; line < n_lines; ++line) {
    std::string cells;
    for (const Column& column : columns) {
      const auto words = split(column.title, ' ');
      const std::size_t n_above = n_lines - words.size();
      cells += in_column(line < n_above ? "" : words[line - n_above], column.width);
    }
    text += line_of(cells);
  }
  return text;
}

std::string StudyTable::row(unsigned int run, const std::string& outcome) const {
  std::string cells;
  for (const Column& column : columns)
    cells += in_column(column.cell(run), column.width);
  const StudyRun& made = *study.runs[run];
  return line_of(cells + (made.failure.empty() ? outcome
                          : made.is_solved()   ? "falls short"
                                               : "not solved"));
}

std::string StudyTable::tex() const {
  std::string format, titles, rows;
  for (const Column& column : columns) {
    format += 'r';
    titles += (titles.empty() ? "" : " & ") + in_tex(column.title);
  }
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    if (study.runs[run]) {
      std::string cells;
      for (const Column& column : columns)
        cells += (cells.empty() ? "" : " & ") +
                 in_tex(trimmed(in_column(column.cell(run), column.width)));
      rows += cells + " \\\\\n";
    }
  return "\\documentclass{article}\n\\usepackage[margin=15mm]{geometry}\n\\usepackage{longtable}\n"
         "\\begin{document}\n\\footnotesize\\setlength{\\tabcolsep}{3pt}\n\\begin{longtable}{" +
         format + "}\n\\hline\n" + titles + " \\\\\n\\hline\\endhead\n" + rows +
         "\\hline\n\\end{longtable}\n\\end{document}\n";
}

void print_study_notes(std::ostream& out, const Study& study) {
  std::vector<std::pair<unsigned int, std::string>> failures, shortfalls, remarks;
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    if (const auto& made = study.runs[run]) {
      if (!made->failure.empty())
        (made->is_solved() ? shortfalls : failures).emplace_back(run, made->failure);
      for (const std::string& remark : made->remarks)
        remarks.emplace_back(run, remark);
    }
  out << "\nsteps: of the contact iteration; error, certified: true and bounded, relative in the "
         "energy norm.\nThe rest is in study.csv; its column shared says what seconds leave out.\n";
  if (study.has("error_relative"))
    out << "Errors against the semi-analytic solution.\n";
  print_once(out, "Not solved", failures, study.runs.size());
  print_once(out, "Falls short", shortfalls, study.runs.size());
  print_once(out, "Note", remarks, study.runs.size());
  report_orders(out, study);
}

} // namespace rollwave
