#include "rollwave/solver/stiffness_factor.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/run_statistics.h"
#include "rollwave/solver/assembly.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace rollwave {

using namespace dealii;

namespace {

/// @throws NotSolved on all processes where a value is not finite
void require_finite_field(const FieldVector& u) {
  const bool is_own_finite =
      std::all_of(u.begin(), u.end(), [](double value) { return std::isfinite(value); });
  if (Utilities::MPI::min(int(is_own_finite), u.get_mpi_communicator()) == 0)
    throw NotSolved("the displacement overflows double precision: change Cylinder/Radial force, or "
                    "choose radii that differ more");
}

} // namespace

StiffnessFactor::StiffnessFactor(const ContactBoundary& boundary, const Scene& scene,
                                 RunStatistics& statistics)
    : boundary(boundary) {
  const RingSpace& space = boundary.space();
  std::optional<SystemMatrix> matrix;
  {
    const RunStatistics::Phase phase(statistics, "assembly");
    matrix.emplace(space, space.constraints(), boundary.contact_nodes());
    assemble_stiffness(space, scene, [&](const auto& dofs, const auto& cell_matrix) {
      matrix->add(dofs, cell_matrix);
    });
    ++statistics.stiffness_assemblies;
  }
  const RunStatistics::Phase phase(statistics, "factorisation");
  factor = matrix->factorise(statistics);
}

FieldVector StiffnessFactor::expand(const FieldVector* f,
                                    const Vector<double>& contact_displacement,
                                    RunStatistics& statistics) const {
  FieldVector u = factor->solve(f, contact_displacement, statistics);
  require_finite_field(u);
  boundary.space().constraints().distribute(u);
  u.update_ghost_values();
  return u;
}

} // namespace rollwave
