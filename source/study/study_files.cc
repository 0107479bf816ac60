#include "rollwave/study/study_files.h"

#include "rollwave/parameters/parameters.h"
#include "rollwave/study/study_pictures.h"
#include "rollwave/study/study_table.h"

#include <deal.II/base/data_out_base.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace rollwave {

namespace {

/// The fields of the runs with the number of the key that varies fastest, or else of the run, as
/// time.
std::string pvd_of(const Study& study, const std::filesystem::path& directory) {
  const auto times = fastest_numbers(study);
  std::vector<std::pair<double, std::string>> files;
  for (unsigned int run = 0; run < study.runs.size(); ++run)
    if (study.runs[run] && !study.runs[run]->files.empty() &&
        std::filesystem::exists(directory / study.runs[run]->files / "solution.vtu"))
      files.emplace_back(times.empty() ? run + 1 : times[run],
                         study.runs[run]->files + "/solution.vtu");
  std::ostringstream text;
  dealii::DataOutBase::write_pvd_record(text, files);
  return text.str();
}

} // namespace

WrittenFiles write_study(const Parameters& parameters, const Study& study) {
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
    draw_study(study, directory, written);
  return written;
}

} // namespace rollwave
