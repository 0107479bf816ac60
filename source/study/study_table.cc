#include "rollwave/study/study_table.h"

#include "rollwave/adapt/marking.h"

#include <algorithm>
#include <cctype>
#include <iomanip>
#include <map>
#include <ostream>
#include <sstream>

namespace rollwave {

namespace {

constexpr unsigned int widest_table = 100, widest_outcome = 11;
constexpr unsigned int widest_text = 24, narrowest_text = 4;

std::string text_of(const std::optional<double>& value, int digits) {
  std::ostringstream text;
  text.precision(digits);
  if (value)
    text << *value;
  return value ? text.str() : "-";
}

std::vector<std::string> words_of(const std::string& title) {
  return split(title, ' ');
}

/// @p text in a column.
std::string aligned(std::string text, unsigned int width, bool is_left) {
  if (text.size() > width)
    text = text.substr(0, width - 2) + "..";
  const std::string blanks(width - text.size(), ' ');
  return is_left ? text + blanks : blanks + text;
}

std::string without_blanks_at_end(const std::string& line) {
  return line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
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
  family_of.resize(study.plans.size());
  for (unsigned int i = 0; i < families.size(); ++i)
    for (const unsigned int run : families[i].runs)
      family_of[run] = i;
  const auto figure = [&study](const std::string& name, int digits) {
    return [&study, name, digits](unsigned int run) {
      return text_of(study.figure(run, name), digits);
    };
  };
  add("run", 4, [](unsigned int run) { return std::to_string(run + 1); });
  add_settings();
  const bool is_adaptive =
      any(study, [](const RunPlan& plan) { return most_cycles(plan.parameters.mesh) > 0; });
  if (is_adaptive)
    add("N", 9, figure("dofs", 9));
  else
    add("h", 8, figure("h_max", 3));
  add("steps", 5, figure("contact_steps", 9));
  if (any(study, [](const RunPlan& plan) { return plan.published_steps.has_value(); }))
    add("published", 9, [&study](unsigned int run) {
      const auto& steps = study.plans[run].published_steps;
      return steps ? std::to_string(*steps) : std::string("-");
    });
  const bool has_certificate =
      any(study, [](const RunPlan& plan) { return plan.parameters.certificate.error_bound; });
  if (study.has_true_errors)
    add("error", 8, figure("error_relative", 3));
  if (has_certificate)
    add("certified", 9, figure("certified_relative", 3));
  if ((study.has_true_errors || has_certificate) && families.size() < study.plans.size())
    add("order", 6, [this](unsigned int run) {
      return text_of(observed_order(this->study, families[family_of[run]], run), 3);
    });
  add("F", 14, figure("force", 9));
  add("seconds", 8, figure("seconds", 3));
  make_narrow();
}

void StudyTable::add(const std::string& title, unsigned int width,
                     const std::function<std::string(unsigned int run)>& cell) {
  const bool is_text = width == 0; // whose width is that of its cells
  for (const std::string& word : words_of(title))
    width = std::max<unsigned int>(width, word.size());
  for (unsigned int run = 0; is_text && run < study.plans.size(); ++run)
    width = std::max<unsigned int>(width, cell(run).size());
  columns.push_back({title, is_text, std::min(width, widest_text), cell});
}

void StudyTable::add_settings() {
  if (!study.plans.front().scene.empty())
    add("scene", 0, [this](unsigned int run) { return study.plans[run].scene; });
  for (unsigned int k = 0; k < study.plans.front().varied.size(); ++k)
    add(study.plans.front().varied[k].key, 0,
        [this, k](unsigned int run) { return study.plans[run].varied[k].value; });
}

/// Cuts texts, and leaves the first keys out where that does not suffice.
void StudyTable::make_narrow() {
  const auto width = [this] {
    unsigned int sum = widest_outcome;
    for (const Column& column : columns)
      sum += column.width + 2;
    return sum;
  };
  for (unsigned int most = widest_text; width() > widest_table && most >= narrowest_text; --most)
    for (Column& column : columns)
      if (column.is_text)
        column.width = std::min(column.width, most);
  while (width() > widest_table)
    columns.erase(columns.begin() + 1);
}

std::string StudyTable::header() const {
  unsigned int n_lines = 0;
  for (const Column& column : columns)
    n_lines = std::max<unsigned int>(n_lines, words_of(column.title).size());
  std::string text;
  for (unsigned int line = 0; line < n_lines; ++line) {
    std::string cells;
    for (const Column& column : columns) {
      const auto words = words_of(column.title);
      const unsigned int n_above = n_lines - words.size();
      cells +=
          aligned(line < n_above ? "" : words[line - n_above], column.width, column.is_text) + "  ";
    }
    text += without_blanks_at_end(cells);
  }
  return text;
}

std::string StudyTable::row(unsigned int run, const std::string& outcome) const {
  std::string cells;
  for (const Column& column : columns)
    cells += aligned(column.cell(run), column.width, column.is_text) + "  ";
  const StudyRun& made = *study.runs[run];
  return without_blanks_at_end(cells + (made.failure.empty() ? outcome
                                        : made.is_solved()   ? "falls short"
                                                             : "not solved"));
}

std::string StudyTable::tex() const {
  std::string format, titles, rows;
  for (const Column& column : columns) {
    format += column.is_text ? 'l' : 'r';
    titles += (titles.empty() ? "" : " & ") + in_tex(column.title);
  }
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    if (study.runs[run]) {
      std::string cells;
      for (const Column& column : columns)
        cells += (cells.empty() ? "" : " & ") +
                 in_tex(trimmed(aligned(column.cell(run), column.width, false)));
      rows += cells + " \\\\\n";
    }
  return "\\documentclass{article}\n\\usepackage[margin=15mm]{geometry}\n\\usepackage{longtable}\n"
         "\\begin{document}\n\\footnotesize\\setlength{\\tabcolsep}{3pt}\n\\begin{longtable}{" +
         format + "}\n\\hline\n" + titles + " \\\\\n\\hline\\endhead\n" + rows +
         "\\hline\n\\end{longtable}\n\\end{document}\n";
}

void print_study(std::ostream& out, const Study& study) {
  const StudyTable table(study);
  out << table.header();
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    if (study.runs[run])
      out << table.row(run);
  print_study_notes(out, study);
}

void print_study_notes(std::ostream& out, const Study& study) {
  std::vector<std::pair<unsigned int, std::string>> failures, shortfalls, remarks, shared;
  std::string reference;
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    if (const auto& made = study.runs[run]) {
      if (!made->failure.empty())
        (made->is_solved() ? shortfalls : failures).emplace_back(run, made->failure);
      for (const std::string& remark : made->remarks)
        remarks.emplace_back(run, remark);
      if (!made->shared.empty())
        shared.emplace_back(run, "its seconds are without what it shares with the run before: " +
                                     made->shared);
      reference = made->reference.empty() ? reference : made->reference;
    }
  const unsigned int n_runs = study.runs.size();
  const bool is_certified =
      any(study, [](const RunPlan& plan) { return plan.parameters.certificate.error_bound; });
  out << "\nsteps: of the contact iteration"
      << (study.has_true_errors ? "; error: relative, in the energy norm" : "")
      << (is_certified ? "; certified: guaranteed bound of the relative error in the energy norm"
                       : "")
      << ". The rest is in study.csv.\n";
  if (!reference.empty())
    out << "Errors against " << reference << ".\n";
  print_once(out, "Not solved", failures, n_runs);
  print_once(out, "Falls short", shortfalls, n_runs);
  print_once(out, "Note", remarks, n_runs);
  print_once(out, "Note", shared, n_runs);
  report_orders(out, study);
}

} // namespace rollwave
