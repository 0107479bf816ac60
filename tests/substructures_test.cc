// Processes that eliminate their own cells solve together as one process does alone.
#include "rollwave/base/errors.h"
#include "rollwave/mesh/ring_mesh.h"
#include "rollwave/run/solve_on_mesh.h"
#include "rollwave/solver/assembly.h"
#include "test_scenes.h"

#include <deal.II/base/function.h>
#include <deal.II/base/mpi.h>
#include <deal.II/numerics/vector_tools.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

using namespace rollwave;
using namespace dealii;

namespace {

/// Figure 4 with a force on cells of degree 3 with hanging nodes inside of the ring and over the
/// seam, on some processes.
struct SolvedRing {
  SolvedRing(const Scene& scene, const Parameters& parameters, MPI_Comm communicator)
      : triangulation(make_ring_mesh(scene, parameters.mesh, communicator)) {
    for (const auto& cell : triangulation->active_cell_iterators())
      if (cell->is_locally_owned() && std::cos(7 * cell->center()[1] + 9 * cell->center()[0]) > 0.4)
        cell->set_refine_flag();
    triangulation->execute_coarsening_and_refinement();
    space = std::make_unique<RingSpace>(*triangulation, scene, parameters.mesh.degree);
    system = std::make_unique<System>(make_system(*space, scene, scene.zone(), statistics));
    load = make_load(*system, scene, statistics);
  }

  unsigned int size() const { return system->boundary.size(); }

  ContactEquations equations() const {
    return contact_equations(*system, load.get(), system->boundary);
  }

  /// (r - a) cos(k r + l z), zero where a constraint holds.
  FieldVector wave(int k, int l) const {
    FieldVector field = space->make_field();
    VectorTools::interpolate(space->mapping(), space->dof_handler(),
                             ScalarFunctionFromFunctionObject<2>([=](const Point<2>& p) {
                               return (p[0] - 0.5) * std::cos(k * p[0] + l * p[1]);
                             }),
                             field);
    space->constraints().set_zero(field);
    return field;
  }

  std::unique_ptr<Triangulation<2>> triangulation;
  std::unique_ptr<RingSpace> space;
  RunStatistics statistics;
  std::unique_ptr<const System> system;
  std::unique_ptr<const Load> load;
};

class Substructures : public testing::Test {
protected:
  static void SetUpTestSuite() {
    static int n_arguments = 0;
    static char** arguments = nullptr;
    mpi = std::make_unique<Utilities::MPI::MPI_InitFinalize>(n_arguments, arguments, 1);
  }
  static void TearDownTestSuite() { mpi.reset(); } // before the static objects of libraries end

  Substructures()
      : parameters(parameters_of({"Mesh/Degree=3", "Mesh/Radial cells=4", "Mesh/Angular cells=60",
                                  "Cylinder/Radial force=1 + r*sin(z)"})),
        scene(make_scene(parameters)) {}

  static inline std::unique_ptr<Utilities::MPI::MPI_InitFinalize> mpi;
  const Parameters parameters;
  const Scene scene;
};

/// Expects two fields to have the same products with waves.
void expect_same_field(const SolvedRing& ring, const FieldVector& field, const SolvedRing& whole,
                       const FieldVector& expected) {
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 4; ++l)
      EXPECT_NEAR(ring.wave(k, l) * field, whole.wave(k, l) * expected,
                  1e-11 * whole.wave(k, l).l2_norm() * expected.l2_norm())
          << k << ' ' << l;
}

void expect_same(const Vector<double>& values, const Vector<double>& expected) {
  ASSERT_EQ(values.size(), expected.size());
  for (unsigned int i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values(i), expected(i), 1e-10 * expected.linfty_norm()) << i;
}

// Pinned nodes lie between processes as well.
TEST_F(Substructures, AnswerAsOneProcessDoes) {
  const SolvedRing ring(scene, parameters, MPI_COMM_WORLD), whole(scene, parameters, MPI_COMM_SELF);
  RunStatistics statistics;
  const unsigned int m = whole.size();
  ASSERT_EQ(ring.size(), m);
  const ContactEquations equations = ring.equations(), of_whole = whole.equations();
  for (const unsigned int step : {m + 1, 1u, 2u, 5u}) { // none, all, every second and fifth
    std::vector<bool> pinned(m);
    ContactState state = {Vector<double>(m), Vector<double>(m)};
    for (unsigned int i = 0; i < m; ++i) {
      pinned[i] = i % step == step / 2;
      (pinned[i] ? state.displacement : state.force)(i) = std::cos(i);
    }
    ContactState expected = state;
    equations.solve(pinned, state, statistics);
    of_whole.solve(pinned, expected, statistics);
    expect_same(state.displacement, expected.displacement);
    expect_same(state.force, expected.force);
    expect_same_field(ring, expand(*ring.system, ring.load.get(), state.kept, statistics), whole,
                      expand(*whole.system, whole.load.get(), expected.kept, statistics));

    const ContactState change = equations.derivative(pinned, state.displacement, statistics),
                       expected_change =
                           of_whole.derivative(pinned, expected.displacement, statistics);
    expect_same(change.displacement, expected_change.displacement);
    expect_same(change.force, expected_change.force);
    expect_same(equations.apply_compliance(state.force), of_whole.apply_compliance(expected.force));
  }
  expect_same_field(ring, ring.system->factor->apply(ring.wave(2, 1)), whole,
                    whole.system->factor->apply(whole.wave(2, 1)));
}

TEST_F(Substructures, HaveIdenticalNumbersOfTheContactNodes) {
  const SolvedRing ring(scene, parameters, MPI_COMM_WORLD);
  RunStatistics statistics;
  std::vector<bool> pinned(ring.size());
  ContactState state = {Vector<double>(ring.size()), Vector<double>(ring.size())};
  for (unsigned int i = 0; i < ring.size(); i += 3)
    pinned[i] = true;
  ring.equations().solve(pinned, state, statistics);
  for (const Vector<double>& values : {state.displacement, state.force})
    for (const double value : values) {
      EXPECT_EQ(Utilities::MPI::min(value, MPI_COMM_WORLD), value);
      EXPECT_EQ(Utilities::MPI::max(value, MPI_COMM_WORLD), value);
    }
}

// Every contact node and every unknown between processes is counted on one process.
TEST_F(Substructures, KeepTheirOwnUnknownsOnly) {
  const SolvedRing ring(scene, parameters, MPI_COMM_WORLD);
  const KeptUnknowns& kept = ring.system->factor->kept();
  std::vector<unsigned int> n_owners(ring.size());
  unsigned int n_own_rows = 0;
  for (unsigned int k = 0; k < kept.size(); ++k) {
    if (kept.contact_nodes[k] >= 0)
      n_owners[kept.contact_nodes[k]] += kept.is_own(k);
    n_own_rows += k >= kept.n_inner && kept.is_own(k);
  }
  Utilities::MPI::sum(n_owners, MPI_COMM_WORLD, n_owners);
  EXPECT_EQ(std::count(n_owners.begin(), n_owners.end(), 1u), ring.size());
  EXPECT_EQ(n_own_rows, kept.own_rows.n_elements());
  EXPECT_EQ(Utilities::MPI::sum(n_own_rows, MPI_COMM_WORLD), kept.own_rows.size());
  if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 2) {
    EXPECT_LT(kept.size(), kept.own_rows.size() + ring.size());
  }
}

double factor_entries(const RingSpace& space, const Scene& scene) {
  const SystemMatrix matrix = assemble_stiffness(space, scene);
  const auto& rows = matrix.entries().rows;
  CholmodFactor factor(*std::max_element(rows.begin(), rows.end()) + 1, 0);
  factor.set_matrix(matrix.entries());
  return factor.n_factor_entries();
}

TEST_F(Substructures, ShareTheEntriesOfTheFactor) {
  const Parameters many_cells = parameters_of({"Mesh/Radial cells=20", "Mesh/Angular cells=480"});
  const auto mesh = make_ring_mesh(scene, many_cells.mesh, MPI_COMM_WORLD),
             whole_mesh = make_ring_mesh(scene, many_cells.mesh, MPI_COMM_SELF);
  const unsigned int n_processes = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  EXPECT_LE(factor_entries(RingSpace(*mesh, scene, 2), scene) * n_processes,
            1.3 * factor_entries(RingSpace(*whole_mesh, scene, 2), scene));
}

// The others would wait for it for ever.
TEST_F(Substructures, FailTogetherWhereTheCellsOfOneAreIndefinite) {
  const auto triangulation = make_ring_mesh(scene, parameters.mesh, MPI_COMM_WORLD);
  const RingSpace space(*triangulation, scene, parameters.mesh.degree);
  const bool is_last = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) + 1 ==
                       Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  SystemMatrix matrix = assemble_stiffness(space, scene);
  FullMatrix<double> cell_matrix(space.dof_handler().get_fe().n_dofs_per_cell());
  for (unsigned int i = 0; i < cell_matrix.m(); ++i)
    cell_matrix(i, i) = -1e6;
  std::vector<types::global_dof_index> dofs(cell_matrix.m());
  for (const auto& cell : space.dof_handler().active_cell_iterators())
    if (is_last && cell->is_locally_owned()) {
      cell->get_dof_indices(dofs);
      matrix.add(dofs, cell_matrix);
    }
  RunStatistics statistics;
  EXPECT_THROW(matrix.factorise(statistics), NotSolved);
}

} // namespace
