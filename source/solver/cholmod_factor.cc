#include "rollwave/solver/cholmod_factor.h"

#include "rollwave/base/errors.h"

#include <cholmod.h>

#include <algorithm>
#include <string>

/**
 * CHOLMOD enters a parallel region of OpenMP for each small block that it adds to another. libgomp
 * makes a team of threads each time, even of one thread, which takes half of the time of a
 * factorisation. GCC compiles such a region to a call of GOMP_parallel (manual of libgomp,
 * "Implementing PARALLEL construct"). The linker finds this definition before that of libgomp, and
 * it runs the @p region on the calling thread. Clang compiles a region to another call, which stays
 * as it is.
 *
 * No team of OpenMP may be active around a call. An OpenBLAS that uses OpenMP asks
 * omp_get_max_threads, gets 1 and enters no region. Rollwave and its other libraries have none.
 */
extern "C" {
__attribute__((visibility("default"))) void GOMP_parallel(void (*region)(void*), void* data,
                                                          unsigned int /*n_threads*/,
                                                          unsigned int /*flags*/) {
  region(data);
}

__attribute__((visibility("default"))) int omp_get_max_threads() {
  return 1;
}
}

namespace rollwave {

/// CHOLMOD's objects, released together.
struct CholmodFactor::Cholmod {
  cholmod_common common;
  cholmod_sparse* matrix = nullptr;
  cholmod_factor* factor = nullptr;

  Cholmod() {
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
    // In the order given CHOLMOD makes no copy of the matrix, and does not mix the trailing
    // unknowns with others.
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_NATURAL;
    common.postorder = 0;
#if CHOLMOD_MAIN_VERSION >= 4
    // Each small block that is added to another would wait for a team of threads.
    common.nthreads_max = 1;
#endif
  }

  ~Cholmod() {
    cholmod_free_factor(&factor, &common);
    cholmod_free_sparse(&matrix, &common);
    cholmod_finish(&common);
  }

  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  void check(const std::string& step) const {
    if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE)
      throw NotEnoughMemory("the " + step +
                            " of the system matrix needs more memory than there is");
    if (common.status == CHOLMOD_NOT_POSDEF)
      throw NotSolved("the system matrix is not positive definite in floating-point arithmetic "
                      "(" +
                      step + "); use cells that are less stretched");
    if (common.status < 0)
      throw NotSolved("the " + step + " of the system matrix failed in CHOLMOD, status " +
                      std::to_string(common.status));
  }

  /// Solves with L or L^T in place. cholmod_solve() would make two more copies of a large vector.
  void solve_triangle(decltype(cholmod_super_lsolve)* solve, std::vector<double>& values) {
    if (values.empty()) // which CHOLMOD refuses
      return;
    std::vector<double> workspace(factor->maxesize);
    cholmod_dense x = view(values), e = view(workspace);
    solve(factor, &x, &e, &common);
  }

  static cholmod_dense view(std::vector<double>& values) {
    cholmod_dense dense = {};
    dense.nrow = dense.nzmax = dense.d = values.size();
    dense.ncol = 1;
    dense.x = values.data();
    dense.xtype = CHOLMOD_REAL;
    dense.dtype = CHOLMOD_DOUBLE;
    return dense;
  }
};

CholmodFactor::CholmodFactor(int n, int m) : cholmod(std::make_unique<Cholmod>()), n(n), m(m) {}

void CholmodFactor::set_matrix(const LowerTriplets& triplets) {
  cholmod_triplet view = {};
  view.nrow = view.ncol = n;
  view.nnz = view.nzmax = triplets.values.size();
  view.i = const_cast<int*>(triplets.rows.data());
  view.j = const_cast<int*>(triplets.columns.data());
  view.x = const_cast<double*>(triplets.values.data());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  cholmod->matrix = cholmod_triplet_to_sparse(&view, 0, &cholmod->common);
  cholmod->check("assembly");
  cholmod->factor = cholmod_analyze(cholmod->matrix, &cholmod->common);
  cholmod->check("analysis");
}

CholmodFactor::CholmodFactor(CholmodFactor&& other) noexcept = default;

CholmodFactor::~CholmodFactor() = default;

void CholmodFactor::factorise() {
  cholmod_factorize(cholmod->matrix, cholmod->factor, &cholmod->common);
  cholmod_free_work(&cholmod->common);
  cholmod->check("factorisation");
}

std::vector<double> CholmodFactor::multiply(std::vector<double> x) const {
  std::vector<double> product(x.size());
  cholmod_dense source = Cholmod::view(x), target = Cholmod::view(product);
  double one[2] = {1, 0}, zero[2] = {0, 0};
  cholmod_sdmult(cholmod->matrix, 0, one, zero, &source, &target, &cholmod->common);
  return product;
}

dealii::Vector<double> CholmodFactor::condense(std::vector<double> b) const {
  cholmod->solve_triangle(cholmod_super_lsolve, b); // (L^-1 b)_c = L_cc^-1 (b_c - K_ci K_ii^-1 b_i)
  dealii::Vector<double> condensed(m);
  if (m > 0)
    schur_factor().vmult(condensed, dealii::Vector<double>(b.end() - m, b.end()));
  return condensed;
}

std::vector<double> CholmodFactor::solve(std::vector<double> b,
                                         const dealii::Vector<double>& x_c) const {
  // L^T x = y with y_i = (L^-1 b)_i and y_c = L_cc^T x_c
  if (b.empty())
    b.resize(n);
  else
    cholmod->solve_triangle(cholmod_super_lsolve, b);
  if (m > 0) {
    dealii::Vector<double> y_c(m);
    schur_factor().Tvmult(y_c, x_c);
    std::copy(y_c.begin(), y_c.end(), b.end() - m);
  }
  cholmod->solve_triangle(cholmod_super_ltsolve, b);
  std::copy(x_c.begin(), x_c.end(), b.end() - m); // without round-off
  return b;
}

dealii::LAPACKFullMatrix<double> CholmodFactor::schur_factor() const {
  const cholmod_factor& factor = *cholmod->factor;
  const int* const first_columns = static_cast<const int*>(factor.super);
  const int* const row_starts = static_cast<const int*>(factor.pi);
  const int* const value_starts = static_cast<const int*>(factor.px);
  const int* const rows = static_cast<const int*>(factor.s);
  const double* const values = static_cast<const double*>(factor.x);
  const int first = n - m;

  dealii::LAPACKFullMatrix<double> trailing(m);
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    const int n_rows = row_starts[s + 1] - row_starts[s];
    for (int column = std::max(first, first_columns[s]); column < first_columns[s + 1]; ++column) {
      const int local_column = column - first_columns[s];
      // A supernode is a dense block stored by columns; what lies above its diagonal is undefined.
      const double* const block_column = values + value_starts[s] + local_column * n_rows;
      for (int local_row = local_column; local_row < n_rows; ++local_row)
        trailing(rows[row_starts[s] + local_row] - first, column - first) = block_column[local_row];
    }
  }
  return trailing;
}

double CholmodFactor::n_factor_entries() const {
  return cholmod->factor->xsize;
}

} // namespace rollwave
