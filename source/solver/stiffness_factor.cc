#include "rollwave/solver/stiffness_factor.h"

#include "rollwave/base/run_statistics.h"
#include "rollwave/solver/assembly.h"

namespace rollwave {

using namespace dealii;

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
  space.constraints().distribute(u);
  u.update_ghost_values();
  return u;
}

} // namespace rollwave
