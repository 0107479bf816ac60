#include "rollwave/run/system.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/mpi_processes.h"
#include "rollwave/base/run_statistics.h"
#include "rollwave/error_bound/radial_shapes.h"
#include "rollwave/scene/scene.h"
#include "rollwave/solver/assembly.h"

#include <deal.II/base/mpi.h>

#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

namespace rollwave {

using namespace dealii;

namespace {

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
  System system = {ContactBoundary(space, zone), RadialShapesOfMesh(space, scene), {}, {}};
  const auto make = [&] {
    std::optional<SystemMatrix> matrix;
    {
      const RunStatistics::Phase phase(statistics, "assembly");
      matrix.emplace(assemble_stiffness(space, scene, system.boundary.contact_nodes()));
      ++statistics.stiffness_assemblies;
    }
    const RunStatistics::Phase phase(statistics, "factorisation");
    system.factor = matrix->factorise(statistics);
    system.condensed = std::make_unique<CondensedSystem>(*system.factor, space.communicator());
  };
  // Of several processes one may be short of memory alone, which ends the program.
  if (is_serial(space.communicator()))
    do_on_all(space.communicator(), make);
  else
    make();
  return system;
}

std::unique_ptr<const Load> make_load(const System& system, const Scene& scene,
                                      RunStatistics& statistics) {
  if (!scene.force)
    return nullptr;
  const RunStatistics::Phase phase(statistics, "assembly");
  const RingSpace& space = system.boundary.space();
  ForceIntegral integral(space, scene, system.shapes);
  FieldVector vector = assemble_load(space, integral, system.shapes);
  ++statistics.load_assemblies;
  require_finite(sum_of_squares(vector), "the load");
  Vector<double> condensed = system.factor->condense(vector, statistics);
  return std::make_unique<Load>(Load{std::move(integral), std::move(vector), std::move(condensed)});
}

FieldVector expand(const System& system, const Load* load, const Vector<double>& kept,
                   RunStatistics& statistics) {
  FieldVector u = system.factor->expand(load ? &load->vector : nullptr, kept, statistics);
  require_finite(sum_of_squares(u), "the displacement");
  system.boundary.space().constraints().distribute(u);
  u.update_ghost_values();
  return u;
}

} // namespace rollwave
