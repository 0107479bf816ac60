#include "load_points.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

namespace {

/// Whether f, which may jump at an end of the interval, has there the value of that side.
bool is_within(double begin, double x, double end) {
  const double roundings = 1e-14 * end;
  return begin + roundings < x && x < end - roundings;
}

/// f_0 on a line z = const at some radii, and which panels it crosses there; nothing where these
/// are none of those looked at.
struct Line {
  struct Crossed {
    unsigned int number;
    double length;  ///< in z
    bool is_within; ///< the line
  };

  Line(const ForcePanels& panels, unsigned int first, double z, const RadialExtent& extent) {
    auto numbers = panels.on(z, extent.begin);
    while (panels[numbers.back()].low[0] >= extent.end)
      numbers.pop_back();
    if (std::all_of(numbers.begin(), numbers.end(), [first](auto i) { return i < first; }))
      return;
    column = panels.column(numbers, z, extent.end);
    for (const unsigned int i : numbers) {
      const double begin = panels[i].low[1], end = panels[i].high[1];
      crossed.push_back({i, end - begin, is_within(begin, z, end)});
    }
  }

  ForceColumn column;
  std::vector<Crossed> crossed;
};

} // namespace

void LoadPoints::Legendre::turn_to(const ForcePiece& piece) {
  if (begin == piece.begin && end == piece.end)
    return;
  begin = piece.begin;
  end = piece.end;
  values = legendre_values((r - begin) / (end - begin));
}

LoadPoints::LoadPoints(const RingSpace& space, const std::vector<double>& moments,
                       const RadialExtents& extents)
    : communicator(space.communicator()), gauss(space.dof_handler().get_fe().degree + 1) {
  const double* of_cell = moments.data();
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    RadialInterval& radial = radial_intervals.at(low[0], high[0], [&] {
      RadialInterval made = {low[0], high[0] - low[0], {}};
      for (const auto& point : gauss.get_points())
        made.points.push_back({made.begin + made.length * point[0]});
      return made;
    });
    Column& column = columns.at(low[1], high[1], [&] {
      return Column{extents.of(low[1], high[1]), {}};
    });
    column.cells.push_back({&radial, of_cell});
    of_cell += gauss.size() * gauss.size();
  }
}

std::vector<MissedAtLoadPoints> LoadPoints::missed(const ForcePanels& panels, unsigned int first) {
  std::vector<double> sums(4 * (panels.size() - first)); // of one, the area, m and m^2
  // Panels of just the size of cells are common, and round-off shall not decide.
  const double points_covered = (1 + 1e-9) * ForcePanel::n_points / gauss.size();
  for (const auto& [interval, column] : columns.entries()) {
    const double angular_length = interval.second - interval.first;
    for (unsigned int p = 0; p < gauss.size(); ++p) {
      const Line line(
          panels, first,
          std::fmod(interval.first + angular_length * gauss.point(p)[0], 2 * numbers::PI),
          column.extent);
      if (line.column.empty())
        continue;
      for (const Cell& cell : column.cells) {
        const double* moment = cell.moments + p * gauss.size();
        unsigned int piece = piece_at(line.column, cell.radial->begin, 0);
        for (unsigned int q = 0; q < gauss.size(); ++q) {
          Legendre& legendre = cell.radial->points[q];
          while (legendre.r > line.column[piece].end)
            ++piece;
          const auto& [begin, end, coefficients, outside] = line.column[piece];
          const auto& [number, length, z_is_within] = line.crossed[piece];
          const bool is_closer = points_covered * cell.radial->length < end - begin ||
                                 points_covered * angular_length < length;
          if (number < first || !is_closer || !z_is_within || !is_within(begin, legendre.r, end))
            continue;
          legendre.turn_to(line.column[piece]);
          double missed = moment[q];
          for (unsigned int k = 0; k < ForcePiece::n_coefficients; ++k)
            missed -= coefficients[k] * legendre.values[k];
          const double area =
              cell.radial->length * angular_length * gauss.weight(p) * gauss.weight(q);
          double* const sum = &sums[4 * (number - first)];
          sum[0] += 1;
          sum[1] += area;
          sum[2] += area * missed;
          sum[3] += area * missed * missed;
        }
      }
    }
  }
  Utilities::MPI::sum(sums, communicator, sums);
  std::vector<MissedAtLoadPoints> missed(panels.size() - first);
  for (unsigned int i = 0; i < missed.size(); ++i)
    if (const double* const sum = &sums[4 * i]; sum[0] > 0)
      missed[i] = {static_cast<unsigned int>(sum[0]), sum[2] / sum[1], sum[3] / sum[1]};
  return missed;
}

} // namespace rollwave
