// MUMPS gives what CHOLMOD does, and fails with a reason.
#include "rollwave/solver/mumps_factor.h"

#include "random_matrix.h"
#include "rollwave/base/errors.h"
#include "rollwave/solver/assembly.h"
#include "rollwave/solver/distributed_factor.h"
#include "rollwave/solver/serial_factor.h"
#include "test_scenes.h"

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

using namespace rollwave;
using dealii::FullMatrix;
using dealii::Vector;

namespace {

/// MPI with one process, from the first test on until the program ends.
class Mumps : public testing::Test {
protected:
  static void SetUpTestSuite() {
    if (dealii::Utilities::MPI::job_supports_mpi())
      return;
    MPI_Init(nullptr, nullptr);
    std::atexit([] { MPI_Finalize(); });
  }
};

TEST_F(Mumps, FindsTheSchurComplementAndSolvesWithTheOtherRows) {
  const int n = 60;
  const RandomMatrix matrix(n);
  const std::vector<int> last = {7, 3, 41};
  MumpsFactor factor(MPI_COMM_WORLD, n, matrix.triplets, last);
  factor.factorise();

  // The inverse of the Schur complement is the block of the inverse.
  FullMatrix<double> inverse(n, n);
  inverse.invert(matrix.full);
  const FullMatrix<double>& lower = factor.schur();
  const auto schur = [&](int i, int j) { return i >= j ? lower(i, j) : lower(j, i); };
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double product = 0;
      for (int k = 0; k < 3; ++k)
        product += schur(i, k) * inverse(last[k], last[j]);
      EXPECT_NEAR(product, i == j, 1e-12);
    }

  std::vector<double> x(n), rhs(n);
  for (int i = 0; i < n; ++i)
    x[i] = std::sin(i);
  for (const int row : last)
    x[row] = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      rhs[i] += matrix.full(i, j) * x[j];
  const std::vector<double> solved = factor.solve_interior(rhs);
  for (int i = 0; i < n; ++i)
    EXPECT_NEAR(solved[i], x[i], 1e-12);
}

TEST_F(Mumps, RefusesIndefiniteAndSingularMatrices) {
  for (const double diagonal : {-1., 0.}) {
    LowerTriplets triplets;
    for (int i = 0; i < 20; ++i) {
      triplets.add(i, i, i == 11 ? diagonal : 2.);
      if (i > 0 && diagonal != 0)
        triplets.add(i, i - 1, 0.5);
    }
    MumpsFactor factor(MPI_COMM_WORLD, 20, triplets, {});
    EXPECT_THROW(factor.factorise(), NotSolved) << diagonal;
  }
}

/// Scene, space and contact nodes of figure 4 on 1500 cells of degree 3, with hanging nodes.
class Factors : public Mumps {
protected:
  Factors()
      : parameters(parameters_of({"Mesh/Degree=3", "Mesh/Radial cells=4", "Mesh/Angular cells=60",
                                  "Mesh/Adaptive cycles=2", "Certificate/Error bound=false"})),
        scene(make_scene(parameters)), solution(simulate(scene, parameters)),
        space(solution.space()), boundary(space, scene.zone()) {}

  template <typename Matrix>
  std::unique_ptr<const SparseFactor> factorised() {
    Matrix matrix(space, space.constraints(), boundary.contact_nodes());
    assemble_stiffness(space, scene, matrix);
    return matrix.factorise(statistics);
  }

  const Parameters parameters;
  const Scene scene;
  const Solution solution;
  const RingSpace& space;
  const ContactBoundary boundary;
  RunStatistics statistics;
};

TEST_F(Factors, OfBothKindsAgree) {
  const auto serial = factorised<SerialMatrix>(), distributed = factorised<DistributedMatrix>();
  const FullMatrix<double> one = serial->schur_factor(), other = distributed->schur_factor();
  for (unsigned int i = 0; i < boundary.size(); ++i)
    for (unsigned int j = 0; j < boundary.size(); ++j)
      EXPECT_NEAR(one(i, j), other(i, j), 1e-10 * one(i, i));

  FieldVector field = space.make_field();
  for (unsigned int i = 0; i < field.size(); ++i)
    field(i) = std::sin(i);
  space.constraints().set_zero(field);
  FieldVector product = serial->apply(field);
  const double size = product.linfty_norm();
  product -= distributed->apply(field);
  EXPECT_LE(product.linfty_norm(), 1e-12 * size);
  Vector<double> contact_values(boundary.size());
  for (unsigned int i = 0; i < boundary.size(); ++i)
    contact_values(i) = std::cos(i);
  FieldVector solved = serial->solve(&field, contact_values, statistics);
  const double largest = solved.linfty_norm();
  solved -= distributed->solve(&field, contact_values, statistics);
  EXPECT_LE(solved.linfty_norm(), 1e-10 * largest);
}

TEST_F(Factors, GetMoreWorkspaceWhereTheirEstimateIsTooSmall) {
  SerialMatrix matrix(space, space.constraints(), {});
  assemble_stiffness(space, scene, matrix);
  MumpsFactor factor(MPI_COMM_WORLD, space.n_unknowns(), matrix.entries(), {});
  EXPECT_NO_THROW(factor.factorise(/*workspace=*/-90));
  const std::vector<double> ones(space.n_unknowns(), 1.);
  for (const double value : factor.solve_interior(ones))
    EXPECT_TRUE(std::isfinite(value));
}

} // namespace
