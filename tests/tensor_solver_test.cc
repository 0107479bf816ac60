// Fast diagonalisation solves what the assembled matrix multiplies.
#include "tensor_solver.h"

#include "dual_potential.h"
#include "test_scenes.h"

#include <gtest/gtest.h>

using namespace rollwave;
using dealii::FullMatrix;
using dealii::Vector;

namespace {

/// The product of the matrix with a field that is zero where @p constraints hold.
FieldVector multiply(const RingSpace& space, const dealii::AffineConstraints<double>& constraints,
                     const RadialProducts& radial, FieldVector field) {
  constraints.distribute(field);
  FieldVector product = space.make_field();
  add_cell_matrices(space, radial, [&](const auto& dofs, const FullMatrix<double>& cell_matrix) {
    Vector<double> of_cell(dofs.size()), of_product(dofs.size());
    for (unsigned int i = 0; i < dofs.size(); ++i)
      of_cell(i) = field(dofs[i]);
    cell_matrix.vmult(of_product, of_cell);
    constraints.distribute_local_to_global(of_product, dofs, product);
  });
  return product;
}

void expect_inverse(const RingSpace& space, const Scene& scene,
                    const dealii::AffineConstraints<double>& constraints,
                    const RadialProducts& radial) {
  Work work;
  TensorSolver solver(space);
  solver.set_matrix(scene, constraints, radial, work);
  EXPECT_EQ(work.diagonalisations, 1u);

  const FieldVector load = random_load(space, constraints);
  const FieldVector solution = solver.solve(load, nullptr, work);
  FieldVector residual = multiply(space, constraints, radial, solution);
  residual -= load;
  EXPECT_LE(residual.l2_norm(), 1e-10 * load.l2_norm());

  FieldVector threefold = load;
  threefold *= 3;
  FieldVector fourfold = solver.solve(threefold, &load, work);
  fourfold.add(-4, solution);
  EXPECT_LE(fourfold.l2_norm(), 1e-13 * solution.l2_norm());
}

class OnTensorMesh : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(OnTensorMesh, SolvesWhatTheMatrixMultiplies) {
  const Parameters parameters = parameters_of(GetParam());
  const Scene scene = make_scene(parameters);
  const Discretisation ring(scene, parameters);
  const RingSpace& space = ring.space;
  ASSERT_TRUE(TensorSolver::suits(space));
  {
    SCOPED_TRACE("displacement, fixed at the hub");
    expect_inverse(space, scene, space.constraints(), stiffness_products(space, scene));
  }
  SCOPED_TRACE("potential, fixed at the surface");
  RadialShapesOfMesh shapes(scene, parameters.mesh.degree, {});
  const std::vector<EdgePressure> no_pressures(space.surface_faces().size());
  expect_inverse(space, scene, potential_constraints(space, scene, no_pressures, ForceJumps()),
                 [&](double begin, double end) -> const ShapeProducts& {
                   return shapes.on(begin, end).products;
                 });
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, OnTensorMesh,
    testing::Values(
        std::vector<std::string>{"Mesh/Degree=1", "Mesh/Radial cells=1", "Mesh/Angular cells=3"},
        std::vector<std::string>{"Mesh/Degree=1", "Mesh/Radial cells=5", "Mesh/Angular cells=40"},
        std::vector<std::string>{"Mesh/Degree=2", "Mesh/Radial cells=5", "Mesh/Angular cells=41"},
        std::vector<std::string>{"Mesh/Degree=2", "Mesh/Radial cells=12", "Mesh/Angular cells=12"},
        std::vector<std::string>{"Mesh/Degree=3", "Mesh/Radial cells=4", "Mesh/Angular cells=33"},
        std::vector<std::string>{"Mesh/Degree=4", "Mesh/Radial cells=3", "Mesh/Angular cells=20"},
        // Halved everywhere; angles at unequal distances; growing heights; the critical speed
        std::vector<std::string>{"Mesh/Degree=2", "Mesh/Radial cells=3", "Mesh/Angular cells=20",
                                 "Mesh/Global refinements=2"},
        std::vector<std::string>{"Mesh/Radial cells=6", "Mesh/Angular cells=50",
                                 "Road/Contact zone=4, 5.1"},
        std::vector<std::string>{"Mesh/Radial cells=20", "Mesh/Angular cells=60",
                                 "Cylinder/Inner radius=1e-4"},
        std::vector<std::string>{"Mesh/Radial cells=20", "Mesh/Angular cells=250",
                                 "Cylinder/Angular velocity=1"}));

TEST(TensorSolver, SuitsCompleteRowsAndColumnsThatAreShort) {
  const auto suits = [](const std::vector<std::string>& assignments) {
    const Parameters parameters = parameters_of(assignments);
    const Scene scene = make_scene(parameters);
    return TensorSolver::suits(*simulate(scene, parameters).space);
  };
  const std::string rows = "Mesh/Radial cells=4", columns = "Mesh/Angular cells=24";
  EXPECT_TRUE(suits({rows, columns}));
  EXPECT_FALSE(suits({rows, columns, "Mesh/Adaptive cycles=1"}));
  EXPECT_FALSE(suits({"Mesh/Radial cells=25", columns}));
}

} // namespace
