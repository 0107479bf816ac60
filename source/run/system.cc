#include "rollwave/run/system.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/run_statistics.h"
#include "rollwave/error_bound/radial_shapes.h"
#include "rollwave/scene/scene.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <cmath>
#include <new>
#include <numeric>
#include <string>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

/// @throws NotEnoughMemory, on one process also in place of std::bad_alloc and deal.II's
/// ExcOutOfMemory. Of several processes one may be short of memory alone, which ends the program.
std::unique_ptr<const StiffnessFactor> make_factor(const ContactBoundary& boundary,
                                                   const Scene& scene, RunStatistics& statistics) {
  if (!is_serial(boundary.space().communicator()))
    return std::make_unique<StiffnessFactor>(boundary, scene, statistics);
  try {
    return std::make_unique<StiffnessFactor>(boundary, scene, statistics);
  } catch (const std::bad_alloc&) {
  } catch (const ExcOutOfMemory&) { // by the vectors of deal.II
  }
  throw NotEnoughMemory("the factor needs more memory than there is");
}

/// The squared l2 norm, which may overflow, unlike FieldVector::norm_sqr().
double sum_of_squares(const FieldVector& field) {
  const double own = std::inner_product(field.begin(), field.end(), field.begin(), 0.);
  return Utilities::MPI::sum(own, field.get_mpi_communicator());
}

} // namespace

void require_finite(double number, const std::string& what) {
  if (!std::isfinite(number))
    throw NotSolved(what +
                    " overflows double precision: change Cylinder/Radial force, or choose radii "
                    "that differ more");
}

System make_system(const RingSpace& space, const Scene& scene,
                   const std::pair<double, double>& zone, RunStatistics& statistics) {
  const ContactBoundary boundary(space, zone);
  require_dense_memory(boundary.size(), space.communicator());
  auto factor = make_factor(boundary, scene, statistics);
  const RunStatistics::Phase phase(statistics, "factorisation");
  auto condensed = std::make_unique<const CondensedSystem>(factor->schur_factor());
  return {boundary, std::move(factor), std::move(condensed)};
}

std::unique_ptr<const Load> make_load(const System& system, const Scene& scene,
                                      RunStatistics& statistics) {
  if (!scene.force)
    return nullptr;
  const RunStatistics::Phase phase(statistics, "assembly");
  const RingSpace& space = system.boundary.space();
  const RadialShapesOfMesh shapes(space, scene);
  ForceIntegral integral(space, scene, shapes);
  FieldVector vector = assemble_load(space, integral, shapes);
  ++statistics.load_assemblies;
  require_finite(sum_of_squares(vector), "the load");
  Vector<double> condensed = system.factor->condense(vector, statistics);
  return std::make_unique<Load>(Load{std::move(integral), std::move(vector), std::move(condensed)});
}

} // namespace rollwave
