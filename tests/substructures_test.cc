// Processes that eliminate their own cells solve together as one process does alone.
#include "rollwave/base/errors.h"
#include "rollwave/mesh/ring_mesh.h"
#include "rollwave/solver/assembly.h"
#include "rollwave/solver/sparse_factor.h"
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

/// Figure 4 on cells of degree 3 with hanging nodes inside of the ring and over the seam, on some
/// processes.
struct FactorisedRing {
  FactorisedRing(const Scene& scene, const Parameters& parameters, MPI_Comm communicator)
      : triangulation(make_ring_mesh(scene, parameters.mesh, communicator)) {
    for (const auto& cell : triangulation->active_cell_iterators())
      if (cell->is_locally_owned() && std::cos(7 * cell->center()[1] + 9 * cell->center()[0]) > 0.4)
        cell->set_refine_flag();
    triangulation->execute_coarsening_and_refinement();
    space = std::make_unique<RingSpace>(*triangulation, scene, parameters.mesh.degree);
    boundary = std::make_unique<ContactBoundary>(*space, scene.zone());
    factor = stiffness_matrix(*space, scene, boundary->contact_nodes()).factorise(statistics);
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
  std::unique_ptr<ContactBoundary> boundary;
  RunStatistics statistics;
  std::unique_ptr<const SparseFactor> factor;
};

class Substructures : public testing::Test {
protected:
  static void SetUpTestSuite() {
    static int n_arguments = 0;
    static char** arguments = nullptr;
    static const Utilities::MPI::MPI_InitFinalize mpi(n_arguments, arguments, 1);
  }

  Substructures()
      : parameters(
            parameters_of({"Mesh/Degree=3", "Mesh/Radial cells=4", "Mesh/Angular cells=60"})),
        scene(make_scene(parameters)) {}

  const Parameters parameters;
  const Scene scene;
};

/// Expects two fields to have the same products with waves.
void expect_same_field(const FactorisedRing& ring, const FieldVector& field,
                       const FactorisedRing& whole, const FieldVector& expected) {
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 4; ++l)
      EXPECT_NEAR(ring.wave(k, l) * field, whole.wave(k, l) * expected,
                  1e-11 * whole.wave(k, l).l2_norm() * expected.l2_norm())
          << k << ' ' << l;
}

TEST_F(Substructures, AnswerAsOneProcessDoes) {
  const FactorisedRing ring(scene, parameters, MPI_COMM_WORLD),
      whole(scene, parameters, MPI_COMM_SELF);
  RunStatistics statistics;
  const unsigned int m = whole.boundary->size();
  ASSERT_EQ(ring.boundary->size(), m);

  const LAPACKFullMatrix<double> lower = ring.factor->schur_factor(),
                                 expected = whole.factor->schur_factor();
  for (unsigned int i = 0; i < m; ++i)
    for (unsigned int j = 0; j < m; ++j)
      EXPECT_NEAR(lower(i, j), expected(i, j), 1e-11 * expected(i, i));

  const FieldVector load = ring.wave(2, 1), load_of_whole = whole.wave(2, 1);
  const Vector<double> condensed = ring.factor->condense(load, statistics),
                       condensed_whole = whole.factor->condense(load_of_whole, statistics);
  for (unsigned int i = 0; i < m; ++i)
    EXPECT_NEAR(condensed(i), condensed_whole(i), 1e-11 * condensed_whole.linfty_norm());

  Vector<double> contact_values(m);
  for (unsigned int i = 0; i < m; ++i)
    contact_values(i) = std::cos(i);
  expect_same_field(ring, ring.factor->solve(&load, contact_values, statistics), whole,
                    whole.factor->solve(&load_of_whole, contact_values, statistics));
  expect_same_field(ring, ring.factor->solve(nullptr, contact_values, statistics), whole,
                    whole.factor->solve(nullptr, contact_values, statistics));
  expect_same_field(ring, ring.factor->apply(load), whole, whole.factor->apply(load_of_whole));
}

double factor_entries(const RingSpace& space, const Scene& scene) {
  const SystemMatrix matrix = stiffness_matrix(space, scene);
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
  SystemMatrix matrix(space, space.constraints());
  assemble_stiffness(space, scene, [&](const auto& dofs, FullMatrix<double> cell_matrix) {
    if (is_last)
      cell_matrix *= -1;
    matrix.add(dofs, cell_matrix);
  });
  RunStatistics statistics;
  EXPECT_THROW(matrix.factorise(statistics), NotSolved);
}

} // namespace
