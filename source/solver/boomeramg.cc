#include "rollwave/solver/boomeramg.h"

#include "rollwave/base/errors.h"

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_parcsr_ls.h>

#include <numeric>
#include <vector>

namespace rollwave {

using namespace dealii;

namespace {

/// The number of the first own row: where the processes before have none, it is not in the map.
HYPRE_BigInt first_row(HYPRE_Int n_rows, MPI_Comm communicator) {
  HYPRE_BigInt rows = n_rows, rows_so_far = 0;
  MPI_Scan(&rows, &rows_so_far, 1, HYPRE_MPI_BIG_INT, MPI_SUM, communicator);
  return rows_so_far - rows;
}

} // namespace

struct BoomerAmg::Hypre {
  /// hypre's objects for a vector.
  struct Vector {
    HYPRE_IJVector handle;
    HYPRE_ParVector vector;

    Vector(MPI_Comm communicator, HYPRE_BigInt first, HYPRE_BigInt last) {
      HYPRE_IJVectorCreate(communicator, first, last, &handle);
      HYPRE_IJVectorSetObjectType(handle, HYPRE_PARCSR);
      HYPRE_IJVectorInitialize(handle);
      HYPRE_IJVectorAssemble(handle);
      HYPRE_IJVectorGetObject(handle, reinterpret_cast<void**>(&vector));
    }
    ~Vector() { HYPRE_IJVectorDestroy(handle); }
    Vector(const Vector&) = delete;
    Vector& operator=(const Vector&) = delete;
  };

  const HYPRE_Int n_rows;
  const HYPRE_BigInt first;
  std::vector<HYPRE_BigInt> rows;
  Vector rhs, solution;
  HYPRE_IJMatrix matrix;
  HYPRE_ParCSRMatrix parallel_matrix;
  HYPRE_Solver cycle;

  Hypre(const Epetra_CrsMatrix& source, const IndexSet& pinned, MPI_Comm communicator)
      : n_rows(source.NumMyRows()), first(first_row(n_rows, communicator)), rows(n_rows),
        rhs(communicator, first, first + n_rows - 1),
        solution(communicator, first, first + n_rows - 1) {
    std::iota(rows.begin(), rows.end(), first);
    HYPRE_IJMatrixCreate(communicator, first, first + n_rows - 1, first, first + n_rows - 1,
                         &matrix);
    HYPRE_IJMatrixSetObjectType(matrix, HYPRE_PARCSR);
    HYPRE_IJMatrixInitialize(matrix);
    const int* const column_numbers = source.ColMap().MyGlobalElements();
    std::vector<bool> is_pinned(source.NumMyCols());
    for (unsigned int k = 0; k < is_pinned.size(); ++k)
      is_pinned[k] = pinned.is_element(column_numbers[k]);
    std::vector<HYPRE_BigInt> columns;
    std::vector<double> values;
    for (HYPRE_Int i = 0; i < n_rows; ++i) {
      HYPRE_Int n_all = 0;
      int* all_columns = nullptr;
      double* all_values = nullptr;
      source.ExtractMyRowView(i, n_all, all_values, all_columns);
      columns.clear();
      values.clear();
      const bool is_row_pinned = pinned.is_element(rows[i]);
      for (int k = 0; k < n_all; ++k)
        if (const int column = column_numbers[all_columns[k]];
            column == rows[i] || !(is_row_pinned || is_pinned[all_columns[k]])) {
          columns.push_back(column);
          values.push_back(all_values[k]);
        }
      HYPRE_Int n = columns.size();
      HYPRE_IJMatrixSetValues(matrix, 1, &n, &rows[i], columns.data(), values.data());
    }
    HYPRE_IJMatrixAssemble(matrix);
    HYPRE_IJMatrixGetObject(matrix, reinterpret_cast<void**>(&parallel_matrix));
    HYPRE_BoomerAMGCreate(&cycle);
  }

  ~Hypre() {
    HYPRE_BoomerAMGDestroy(cycle);
    HYPRE_IJMatrixDestroy(matrix);
  }
};

BoomerAmg::BoomerAmg(const TrilinosWrappers::SparseMatrix& matrix, const IndexSet& pinned,
                     MPI_Comm communicator)
    : hypre([&] {
        static const int is_started = HYPRE_Init(); // once in a process
        (void)is_started;
        return std::make_unique<Hypre>(matrix.trilinos_matrix(), pinned, communicator);
      }()) {
  const auto cycle = hypre->cycle;
  HYPRE_BoomerAMGSetPrintLevel(cycle, 0);
  HYPRE_BoomerAMGSetMaxIter(cycle, 1);
  HYPRE_BoomerAMGSetTol(cycle, 0);
  constexpr int ruge_stueben = 3, classical = 0;
  HYPRE_BoomerAMGSetCoarsenType(cycle, ruge_stueben);
  HYPRE_BoomerAMGSetInterpType(cycle, classical);
  HYPRE_BoomerAMGSetPMaxElmts(cycle, 0); // nothing cut off
  // Along an axis of stretched elements couplings are strong, and multigrid must coarsen along
  // that axis only. Where it is that of z, neighbours across the corner of linear elements couple
  // half as strongly as those in z on the surface, and a quarter inside.
  HYPRE_BoomerAMGSetStrongThreshold(cycle, 0.55);
  HYPRE_BoomerAMGSetMaxRowSum(cycle, 1); // no row is left out as dominated by its diagonal
  HYPRE_BoomerAMGSetRelaxOrder(cycle, 0);
  constexpr int forward = 13, backward = 14, symmetric = 6; // Gauss-Seidel
  constexpr int down = 1, up = 2, coarsest = 3;
  HYPRE_BoomerAMGSetNumSweeps(cycle, 1);
  HYPRE_BoomerAMGSetCycleRelaxType(cycle, forward, down);
  HYPRE_BoomerAMGSetCycleRelaxType(cycle, backward, up);
  // Where coarsening ends early, the coarsest level is too large for elimination.
  HYPRE_BoomerAMGSetCycleRelaxType(cycle, symmetric, coarsest);
  HYPRE_BoomerAMGSetCycleNumSweeps(cycle, 4, coarsest);
  HYPRE_BoomerAMGSetup(cycle, hypre->parallel_matrix, hypre->rhs.vector, hypre->solution.vector);
  if (const int error = Utilities::MPI::max(int(HYPRE_GetError()), communicator)) {
    HYPRE_ClearAllErrors();
    throw NotSolved("the multigrid hierarchy could not be made, hypre's error " +
                    std::to_string(error));
  }
}

BoomerAmg::~BoomerAmg() = default;

void BoomerAmg::vmult(FieldVector& u, const FieldVector& rhs) const {
  u = 0;
  const auto& rows = hypre->rows;
  HYPRE_IJVectorSetValues(hypre->rhs.handle, hypre->n_rows, rows.data(), rhs.begin());
  HYPRE_IJVectorSetValues(hypre->solution.handle, hypre->n_rows, rows.data(), u.begin());
  HYPRE_BoomerAMGSolve(hypre->cycle, hypre->parallel_matrix, hypre->rhs.vector,
                       hypre->solution.vector);
  HYPRE_ClearAllErrors(); // one cycle does not reach the tolerance zero
  HYPRE_IJVectorGetValues(hypre->solution.handle, hypre->n_rows, rows.data(), u.begin());
}

} // namespace rollwave
