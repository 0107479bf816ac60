#include "work_of_force.h"

#include "lexicographic_dofs.h"
#include "shape_products.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <numeric>

namespace rollwave {

using namespace dealii;

double work_of_force(const ForceInterpolant& force, const RingSpace& space,
                     const FieldVector& field) {
  const unsigned int degree = space.dof_handler().get_fe().degree, n = degree + 1;
  const auto lagrange = lobatto_lagrange(degree);
  // Exact between the ends of panels for f_0 times w
  const QGauss<1> gauss((ForcePiece::n_coefficients + n) / 2);
  LexicographicDofs dofs(space.dof_handler());
  std::vector<double> on_line(n);
  double work = 0;
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    const Point<2> low = cell->vertex(0), high = cell->vertex(3);
    const Tensor<1, 2> size = high - low;
    const auto& of_cell = dofs.of(cell);
    std::vector<double> ends = force.panel_ends(low[1], high[1], low[0]);
    ends.insert(ends.begin(), low[1]);
    ends.push_back(high[1]);
    for (unsigned int part = 0; part + 1 < ends.size(); ++part)
      for (unsigned int p = 0; p < gauss.size(); ++p) {
        const double length = ends[part + 1] - ends[part];
        const double z = ends[part] + length * gauss.point(p)[0];
        std::fill(on_line.begin(), on_line.end(), 0.);
        for (unsigned int j = 0; j < n; ++j) {
          const double shape = lagrange[j].value((z - low[1]) / size[1]);
          for (unsigned int i = 0; i < n; ++i)
            on_line[i] += shape * field(of_cell[i + n * j]);
        }
        for (const ForcePiece& piece : force.column(z, low[0])) {
          const double begin = std::max(piece.begin, low[0]), end = std::min(piece.end, high[0]);
          if (begin >= end)
            break;
          for (unsigned int q = 0; q < gauss.size(); ++q) {
            const double r = begin + (end - begin) * gauss.point(q)[0];
            const auto legendre = legendre_values((r - piece.begin) / (piece.end - piece.begin));
            double w = 0;
            for (unsigned int i = 0; i < n; ++i)
              w += on_line[i] * lagrange[i].value((r - low[0]) / size[0]);
            work += length * gauss.weight(p) * (end - begin) * gauss.weight(q) * w *
                    std::inner_product(legendre.begin(), legendre.end(), piece.coefficients.begin(),
                                       0.);
          }
        }
      }
  }
  return Utilities::MPI::sum(work, space.communicator());
}

} // namespace rollwave
