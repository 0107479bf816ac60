#include "load_points.h"

#include "interval_map.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

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

/// Legendre polynomials at a radius, for the panel met last.
struct Legendre {
  double begin = 0, end = 0; ///< of the panel; 0 before the first
  ForcePiece::Coefficients values;

  const ForcePiece::Coefficients& at(double r, const ForcePiece& piece) {
    if (begin != piece.begin || end != piece.end) {
      begin = piece.begin;
      end = piece.end;
      values = legendre_values((r - begin) / (end - begin));
    }
    return values;
  }
};

} // namespace

std::vector<MissedAtLoadPoints> missed_at_load_points(const RingSpace& space,
                                                      const ForcePanels& panels, unsigned int first,
                                                      const std::vector<double>& moments,
                                                      const RadialExtents& extents) {
  const QGauss<1> gauss(space.dof_handler().get_fe().degree + 1);
  IntervalMap<std::vector<Line>> known_lines;
  IntervalMap<std::vector<Legendre>> known_legendre;     // at the radii of a radial interval
  std::vector<double> sums(4 * (panels.size() - first)); // of one, the area, m and m^2
  auto moment = moments.begin();
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Point<2> low = cell->vertex(0);
    const Tensor<1, 2> size = cell->vertex(3) - low;
    // Panels of just this size are common, and round-off shall not decide.
    const Tensor<1, 2> covered = (1 + 1e-9) * ForcePanel::n_points / gauss.size() * size;
    const auto& lines = known_lines.at(low[1], cell->vertex(3)[1], [&] {
      const RadialExtent extent = extents.of(low[1], cell->vertex(3)[1]);
      std::vector<Line> made;
      for (const auto& point : gauss.get_points())
        made.emplace_back(panels, first, std::fmod(low[1] + size[1] * point[0], 2 * numbers::PI),
                          extent);
      return made;
    });
    auto& legendre = known_legendre.at(low[0], cell->vertex(3)[0],
                                       [&] { return std::vector<Legendre>(gauss.size()); });
    for (unsigned int p = 0; p < gauss.size(); ++p) {
      const auto& [column, crossed] = lines[p];
      if (column.empty()) {
        moment += gauss.size();
        continue;
      }
      unsigned int piece = piece_at(column, low[0], 0);
      for (unsigned int q = 0; q < gauss.size(); ++q) {
        const double at_point = *moment++;
        const double r = low[0] + size[0] * gauss.point(q)[0];
        while (r > column[piece].end)
          ++piece;
        const auto& [begin, end, coefficients, outside] = column[piece];
        const auto& [number, length, z_is_within] = crossed[piece];
        const bool is_closer = covered[0] < end - begin || covered[1] < length;
        if (number < first || !is_closer || !z_is_within || !is_within(begin, r, end))
          continue;
        const auto& values = legendre[q].at(r, column[piece]);
        double missed = at_point;
        for (unsigned int k = 0; k < ForcePiece::n_coefficients; ++k)
          missed -= coefficients[k] * values[k];
        const double area = size[0] * size[1] * gauss.weight(p) * gauss.weight(q);
        double* const sum = &sums[4 * (number - first)];
        sum[0] += 1;
        sum[1] += area;
        sum[2] += area * missed;
        sum[3] += area * missed * missed;
      }
    }
  }
  Utilities::MPI::sum(sums, space.communicator(), sums);
  std::vector<MissedAtLoadPoints> missed(panels.size() - first);
  for (unsigned int i = 0; i < missed.size(); ++i)
    if (const double* const sum = &sums[4 * i]; sum[0] > 0)
      missed[i] = {static_cast<unsigned int>(sum[0]), sum[2] / sum[1], sum[3] / sum[1]};
  return missed;
}

} // namespace rollwave
