#include "rollwave/output/progress_report.h"

#include "rollwave/base/text.h"

#include <deal.II/base/timer.h>

#include <iomanip>
#include <memory>
#include <ostream>
#include <vector>

namespace rollwave {

Progress report_progress(std::ostream& out, const Scene& scene) {
  Progress progress;
  constexpr double long_seconds = 1;
  const auto since_last_line = std::make_shared<dealii::Timer>();
  progress.phase_ended = [&out, since_last_line](const std::string& phase, double seconds) {
    if (seconds > long_seconds) {
      out << "  " << phase << ", " << rounded(seconds, 3) << " s" << std::endl;
      since_last_line->restart();
    }
  };
  progress.contact_step_ended = [&out, since_last_line](const std::vector<ContactStep>& history) {
    if (since_last_line->wall_time() > long_seconds) {
      out << "  contact step " << history.size() << ", " << history.back().active << " active, "
          << history.back().changed << " changed" << std::endl;
      since_last_line->restart();
    }
  };
  progress.mesh_solved = [&out, units = scene.units, has_load = !scene.has_distance()](
                             unsigned int number, const CycleFigures& mesh) {
    const Quantity quantity = has_load ? Quantity::length : Quantity::force;
    if (number == 1)
      out << "Adaptive refinement\n"
          << " mesh    cells unknowns  steps  certified  "
          << (has_load ? "   distance c" : "vertical load") << units.in_brackets(quantity)
          << (has_load ? "" : "  guaranteed +-") << "  indicated error"
          << units.in_brackets(Quantity::energy_norm) << '\n';
    const double result = (has_load ? mesh.road_distance : mesh.vertical_load) * units.of(quantity);
    out << std::setw(5) << number << std::setw(9) << mesh.n_cells << std::setw(9) << mesh.n_unknowns
        << std::setw(7) << mesh.contact_steps << std::setw(11)
        << (mesh.certified ? rounded_up(*mesh.certified, 3) : "-") << std::setw(15)
        << rounded(result, 8);
    if (!has_load)
      out << std::setw(15)
          << (mesh.load_half_width
                  ? rounded_up(*mesh.load_half_width * units.of(Quantity::force), 3)
                  : "-");
    out << std::setw(17)
        << (mesh.indicated ? rounded(*mesh.indicated * units.of(Quantity::energy_norm), 3) : "-")
        << '\n'
        << std::flush;
  };
  return progress;
}

Progress report_long_runs(std::ostream& out) {
  Progress progress;
  const auto since_last_line = std::make_shared<dealii::Timer>();
  progress.mesh_solved = [&out, since_last_line](unsigned int number, const CycleFigures& mesh) {
    constexpr double seconds_between_lines = 5;
    if (since_last_line->wall_time() < seconds_between_lines)
      return;
    out << "  mesh " << number << ", " << mesh.n_unknowns << " unknowns"
        << (mesh.certified ? ", certified " + rounded_up(*mesh.certified, 3) : "") << std::endl;
    since_last_line->restart();
  };
  return progress;
}

} // namespace rollwave
