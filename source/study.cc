#include "study.h"

#include "atomic_file.h"
#include "errors.h"
#include "output.h"
#include "simulation.h"
#include "true_errors.h"
#include "verification.h"

#include <deal.II/grid/tria.h>

#include <fstream>
#include <iomanip>
#include <map>
#include <ostream>
#include <sstream>
#include <tuple>

namespace rollwave {

namespace {

/// All combinations of one setting from each list, the last list varying fastest.
std::vector<std::vector<Setting>> combinations(const std::vector<std::vector<Setting>>& lists) {
  std::vector<std::vector<Setting>> all(1);
  for (const auto& list : lists) {
    std::vector<std::vector<Setting>> longer;
    for (const auto& combination : all)
      for (const Setting& setting : list) {
        longer.push_back(combination);
        longer.back().push_back(setting);
      }
    all = std::move(longer);
  }
  return all;
}

/// The parameters of one run, which is no study itself.
Parameters run_parameters(const Parameters& parameters, const std::vector<Setting>& varied) {
  std::vector<Setting> settings = parameters.settings;
  settings.insert(settings.end(), varied.begin(), varied.end());
  return read_parameters(settings);
}

/// The adaptive solution with quadratic elements that errors are measured against where no exact
/// one is known.
Reference compute_reference(const Scene& scene, const Parameters& parameters) {
  std::vector<Setting> settings = parameters.settings;
  const auto set = [&](const std::string& section, const std::string& key,
                       const std::string& value) {
    settings.push_back({section, key, value, "reference of the study"});
  };
  set("Mesh", "Degree", "2");
  set("Mesh", "Global refinements", "0");
  set("Mesh", "Adaptive cycles", "1000");
  set("Mesh", "Wanted relative error", "0");
  set("Mesh", "Indicator", "residual");
  set("Mesh", "Marking", "bulk");
  set("Mesh", "Most unknowns", std::to_string(parameters.study.reference_unknowns));
  set("Contact", "Method", "active set");
  set("Certificate", "Error bound", "true");
  const Solution solution = simulate(scene, read_parameters(settings));
  std::ostringstream name;
  name << "an adaptive solution with " << solution.result.mesh.dofs
       << " unknowns, its own relative error certified to " << std::setprecision(2)
       << solution.result.certified->relative;
  return discrete_reference(scene, *solution.space, solution.result, name.str());
}

/// Runs that differ in their mesh only share their reference.
class References {
public:
  const Reference& find(const Scene& scene, const Parameters& parameters) {
    const auto key = std::tuple(scene.inner_radius, scene.outer_radius, scene.angular_velocity,
                                parameters.road.distance, parameters.cylinder.radial_force,
                                scene.zone_begin, scene.zone_end);
    const auto known = references.find(key);
    if (known != references.end())
      return known->second;
    const auto exact = find_exact_solution(scene, parameters);
    return references
        .emplace(key, exact ? exact_reference(*exact) : compute_reference(scene, parameters))
        .first->second;
  }

private:
  std::map<std::tuple<double, double, double, double, std::string, double, double>, Reference>
      references;
};

/// The runs that an earlier call has finished; otherwise makes the directory that of
/// this study.
std::vector<StudyRun> finished_runs(const Parameters& parameters,
                                    const std::filesystem::path& directory) {
  std::ostringstream own, earlier;
  write_parameters(own, parameters);
  earlier << std::ifstream(directory / "parameters.prm").rdbuf();
  if (own.str() == earlier.str())
    return read_study_csv(directory / "study.csv");
  std::error_code ignored;
  std::filesystem::remove(directory / "study.csv", ignored);
  write_file(directory / "parameters.prm", own.str());
  return {};
}

} // namespace

std::vector<StudyRun> run_study(const Parameters& parameters,
                                const std::filesystem::path& directory, std::ostream& progress) {
  const auto varied = combinations(parameters.study.vary);
  const auto& published = parameters.study.published_steps;
  if (!published.empty() && published.size() != varied.size())
    throw BadInput(refusal(parameters.settings, "Study", "Published steps",
                           "there are " + std::to_string(published.size()) + " entries for " +
                               std::to_string(varied.size()) + " runs"));
  for (const auto& settings : varied)
    make_scene(run_parameters(parameters, settings));

  const auto finished = finished_runs(parameters, directory);
  std::vector<StudyRun> runs;
  References references;
  for (const auto& settings : varied) {
    StudyRun run;
    run.settings = settings;
    if (!published.empty())
      run.published_steps = published[runs.size()];
    progress << "run " << runs.size() + 1 << " of " << varied.size() << ':';
    for (const Setting& setting : settings)
      progress << "  " << setting.path() << " = " << setting.value;
    if (runs.size() < finished.size()) {
      progress << "  (done before)" << std::endl;
      run.figures = finished[runs.size()].figures;
      run.reference = finished[runs.size()].reference;
      runs.push_back(std::move(run));
      continue;
    }
    progress << std::endl;
    try {
      const Parameters own = run_parameters(parameters, settings);
      const Scene scene = make_scene(own);
      Solution solution = simulate(scene, own);
      if (parameters.study.true_errors) {
        const Reference& reference = references.find(scene, own);
        solution.result.errors =
            measure_true_errors(*solution.space, solution.displacement, solution.result,
                                solution.certificate, reference);
        run.reference = reference.name;
      }
      run.figures = figures_of(solution.result);
    } catch (const NotSolved& failure) {
      progress << "  not solved: " << failure.what() << std::endl;
    }
    runs.push_back(std::move(run));
    write_file(directory / "study.csv", study_csv(runs));
  }
  return runs;
}

} // namespace rollwave
