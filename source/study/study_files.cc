#include "rollwave/study/study_files.h"

#include "rollwave/parameters/parameters.h"
#include "rollwave/plot/gnuplot.h"
#include "rollwave/study/study_csv.h"
#include "rollwave/study/study_pictures.h"
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

/// The fields of the runs that have one.
std::string pvd_of(const Study& study) {
  const std::string field = "solution.vtu";
  const auto times = times_of(study);
  std::vector<std::pair<double, std::string>> files;
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    if (study.runs[run] && study.runs[run]->sizes.count(field) > 0)
      files.emplace_back(times[run], (directory_of_run(study.plans[run].digest) / field).string());
  std::ostringstream text;
  dealii::DataOutBase::write_pvd_record(text, files);
  return text.str();
}

} // namespace

std::vector<std::string> study_file_names(const Parameters& parameters) {
  std::vector<std::string> names = {"parameters.prm", "study.csv", "study-profiles.csv",
                                    "study.txt", "study.tex"};
  if (parameters.study.files_of_each_run.count(OutputFile::solution) > 0)
    names.push_back("study.pvd");
  if (parameters.wants(OutputFile::plot))
    for (const char* const picture : study_picture_names)
      for (const std::string& name : picture_files(picture, parameters.output.picture_format))
        names.push_back(name);
  return names;
}

WrittenFiles write_study(const Parameters& parameters, const Study& study, const std::string& text,
                         std::vector<std::filesystem::path> older) {
  const std::filesystem::path directory = parameters.output.directory;
  WrittenFiles written;
  written.write(directory / "study.csv", study_csv(study));
  written.write(directory / "study-profiles.csv", profiles_csv(study));
  written.files.push_back(directory / "parameters.prm");
  written.write(directory / "study.txt", text);
  written.write(directory / "study.tex", table_as_tex(study));
  if (study.files.kinds.count(OutputFile::solution) > 0)
    written.write(directory / "study.pvd", pvd_of(study));
  const bool is_solved = std::any_of(study.runs.begin(), study.runs.end(),
                                     [](const auto& run) { return run && run->is_solved(); });
  if (parameters.wants(OutputFile::plot) && is_solved)
    draw_study(parameters, study, written);
  older.erase(std::remove(older.begin(), older.end(), directory / "runs"), older.end());
  written.note_older_files(older);
  return written;
}

} // namespace rollwave
