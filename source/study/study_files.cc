#include "rollwave/study/study_files.h"

#include "rollwave/parameters/parameters.h"
#include "rollwave/study/study_pictures.h"
#include "rollwave/study/study_runner.h"
#include "rollwave/study/study_table.h"

#include <deal.II/base/data_out_base.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace rollwave {

namespace {

/// The times of the runs in study.pvd, each of its own: the numbers of the key, if a single one
/// varies; else the numbers of the runs.
std::vector<double> times_of(const Study& study) {
  std::vector<double> times;
  if (study.plans.front().varied.size() == 1)
    times = fastest_numbers(study);
  if (std::set(times.begin(), times.end()).size() < study.runs.size()) {
    times.resize(study.runs.size());
    std::iota(times.begin(), times.end(), 1);
  }
  return times;
}

std::string pvd_of(const Study& study, const std::filesystem::path& directory) {
  const auto times = times_of(study);
  std::vector<std::pair<double, std::string>> files;
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    if (study.runs[run] && !study.runs[run]->files.empty() &&
        std::filesystem::exists(directory / study.runs[run]->files / "solution.vtu"))
      files.emplace_back(times[run], study.runs[run]->files + "/solution.vtu");
  std::ostringstream text;
  dealii::DataOutBase::write_pvd_record(text, files);
  return text.str();
}

} // namespace

WrittenFiles write_study(const Parameters& parameters, const Study& study,
                         std::vector<std::filesystem::path> older) {
  const std::filesystem::path directory = parameters.output.directory;
  WrittenFiles written;
  for (const char* const name : {"study.csv", "study-profiles.csv", "parameters.prm"})
    written.files.push_back(directory / name);
  std::ostringstream text;
  text << table_as_text(study);
  print_study_notes(text, study);
  written.write(directory / "study.txt", text.str());
  written.write(directory / "study.tex", table_as_tex(study));
  const auto& kinds = parameters.study.files_of_each_run;
  if (kinds.count(OutputFile::solution) > 0)
    written.write(directory / "study.pvd", pvd_of(study, directory));
  const bool is_solved = std::any_of(study.runs.begin(), study.runs.end(),
                                     [](const auto& run) { return run && run->is_solved(); });
  if (parameters.wants(OutputFile::plot) && is_solved)
    draw_study(parameters, study, written);
  std::set<std::string> own;
  for (const auto& run : study.runs)
    if (run)
      own.insert(run->files);
  const auto is_of_this_study = [&](const std::filesystem::path& file) {
    const std::string name = file.filename().string();
    return own.count(name) > 0 || is_table_of_part(name);
  };
  older.erase(std::remove_if(older.begin(), older.end(), is_of_this_study), older.end());
  written.note_older_files(older);
  return written;
}

} // namespace rollwave
