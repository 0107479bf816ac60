#include "refinement.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/grid/grid_refinement.h>
#include <deal.II/grid/tria.h>
#include <deal.II/numerics/error_estimator.h>

#include <algorithm>

namespace rollwave {

using namespace dealii;

std::vector<double> kelly_indicator(const RingSpace& space, const FieldVector& field) {
  Vector<float> indicators(space.dof_handler().get_triangulation().n_active_cells());
  KellyErrorEstimator<2>::estimate(space.mapping(), space.dof_handler(),
                                   QGauss<1>(space.dof_handler().get_fe().degree + 1), {}, field,
                                   indicators);
  return {indicators.begin(), indicators.end()};
}

unsigned int mark_cells(Triangulation<2>& triangulation, const std::vector<double>& indicators,
                        Marking marking, double fraction) {
  Vector<double> squares(indicators.size());
  const double largest = *std::max_element(indicators.begin(), indicators.end());
  for (unsigned int i = 0; i < indicators.size() && largest > 0; ++i)
    squares(i) = indicators[i] / largest * (indicators[i] / largest);
  switch (marking) {
  case Marking::bulk:
    GridRefinement::refine_and_coarsen_fixed_fraction(triangulation, squares, fraction, 0.);
    break;
  case Marking::number:
    GridRefinement::refine_and_coarsen_fixed_number(triangulation, squares, fraction, 0.);
    break;
  case Marking::all:
    triangulation.set_all_refine_flags();
  }
  triangulation.prepare_coarsening_and_refinement();
  unsigned int flagged = 0;
  for (const auto& cell : triangulation.active_cell_iterators())
    flagged += cell->refine_flag_set();
  return triangulation.n_active_cells() + 3 * flagged;
}

} // namespace rollwave
