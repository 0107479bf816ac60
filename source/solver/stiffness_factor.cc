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
  std::unique_ptr<SystemMatrix> matrix;
  {
    const RunStatistics::Phase phase(statistics, "assembly");
    matrix = make_system_matrix(space, space.constraints(), boundary.contact_nodes());
    assemble_stiffness(space, scene, *matrix);
    ++statistics.stiffness_assemblies;
  }
  const RunStatistics::Phase phase(statistics, "factorisation");
  factor = matrix->factorise(statistics);
}

Vector<double> StiffnessFactor::condense(const FieldVector& f, RunStatistics& statistics) const {
  FieldVector rest = factor->apply(factor->solve_interior(f, statistics));
  rest.sadd(-1, f);
  return boundary.contact_values(rest);
}

FieldVector StiffnessFactor::expand(const FieldVector* f,
                                    const Vector<double>& contact_displacement,
                                    RunStatistics& statistics) const {
  const RingSpace& space = boundary.space();
  const auto set_contact_nodes = [&](FieldVector& field) {
    for (unsigned int i = 0; i < boundary.size(); ++i)
      if (const auto dof = boundary.contact_nodes()[i].dof; field.in_local_range(dof))
        field(dof) = contact_displacement(i);
  };
  FieldVector u = space.make_field();
  set_contact_nodes(u);
  FieldVector rhs = factor->apply(u);
  rhs *= -1;
  if (f)
    rhs += *f;
  u = factor->solve_interior(rhs, statistics);
  set_contact_nodes(u);
  require_finite_field(u);
  space.constraints().distribute(u);
  u.update_ghost_values();
  return u;
}

} // namespace rollwave
