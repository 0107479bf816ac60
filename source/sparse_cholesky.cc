#include "sparse_cholesky.h"

#include "errors.h"
#include "memory.h"

#include <cholmod.h>
#include <omp.h>

#include <algorithm>
#include <numeric>
#include <string>

namespace rollwave {

/// CHOLMOD's objects, released together.
struct SparseCholesky::Cholmod {
  cholmod_common common;
  cholmod_sparse* matrix = nullptr;
  cholmod_factor* factor = nullptr;

  Cholmod() {
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
    // The matrix is handed over in its final order, so that CHOLMOD makes no copy of it; its
    // postordering could mix the trailing unknowns with others.
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_NATURAL;
    common.postorder = 0;
    // Supernodes are merged less eagerly than by default: 10 % less memory in about the same time.
    common.nrelax[1] = 10;
    common.nrelax[2] = 24;
    common.zrelax[0] = 0.36;
    common.zrelax[1] = 0.05;
    common.zrelax[2] = 0.02;
  }

  ~Cholmod() {
    cholmod_free_factor(&factor, &common);
    cholmod_free_sparse(&matrix, &common);
    cholmod_finish(&common);
    release_freed_memory();
  }

  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  void check(const std::string& step) const {
    if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE)
      throw NotEnoughMemory("the " + step +
                            " of the stiffness matrix needs more memory than there is");
    if (common.status == CHOLMOD_NOT_POSDEF)
      throw NotSolved("the stiffness matrix is not positive definite in floating-point arithmetic "
                      "(" +
                      step + "); use cells that are less stretched");
    if (common.status < 0)
      throw NotSolved("the " + step + " of the stiffness matrix failed in CHOLMOD, status " +
                      std::to_string(common.status));
  }

  /// The upper triangle of the matrix. @throws NotSolved when memory is short.
  cholmod_sparse* sum_up(const LowerTriplets& triplets, std::size_t n) {
    cholmod_triplet view = {};
    view.nrow = view.ncol = n;
    view.nnz = view.nzmax = triplets.values.size();
    view.i = const_cast<int*>(triplets.columns.data());
    view.j = const_cast<int*>(triplets.rows.data());
    view.x = const_cast<double*>(triplets.values.data());
    view.stype = 1;
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    cholmod_sparse* const sum = cholmod_triplet_to_sparse(&view, 0, &common);
    check("assembly");
    return sum;
  }

  /// Makes the lower triangle of P K P^T the matrix, and frees @p upper. Returns whether the
  /// pattern stays as it was.
  bool set(cholmod_sparse* upper, std::vector<int>& order) {
    cholmod_sparse* next = cholmod_ptranspose(upper, 1, order.data(), nullptr, 0, &common);
    cholmod_free_sparse(&upper, &common);
    check("assembly");
    std::swap(matrix, next);
    const bool is_same = next != nullptr && has_pattern_of(*next);
    cholmod_free_sparse(&next, &common);
    return is_same;
  }

  bool has_pattern_of(const cholmod_sparse& other) const {
    const auto* const columns = static_cast<const int*>(matrix->p);
    const auto* const rows = static_cast<const int*>(matrix->i);
    return std::equal(columns, columns + matrix->ncol + 1, static_cast<const int*>(other.p)) &&
           std::equal(rows, rows + columns[matrix->ncol], static_cast<const int*>(other.i));
  }

  /// Solves with one of the systems L, Lt, P, Pt.
  std::vector<double> solve(int system, const std::vector<double>& rhs) {
    cholmod_dense b = view(const_cast<double*>(rhs.data()), rhs.size());
    cholmod_dense* x = cholmod_solve(system, factor, &b, &common);
    check("solution");
    const double* const values = static_cast<const double*>(x->x);
    std::vector<double> result(values, values + rhs.size());
    cholmod_free_dense(&x, &common);
    return result;
  }

  static cholmod_dense view(double* values, std::size_t size) {
    cholmod_dense dense = {};
    dense.nrow = dense.nzmax = dense.d = size;
    dense.ncol = 1;
    dense.x = values;
    dense.xtype = CHOLMOD_REAL;
    dense.dtype = CHOLMOD_DOUBLE;
    return dense;
  }
};

SparseCholesky::SparseCholesky(std::vector<int> groups, int m)
    : cholmod(std::make_unique<Cholmod>()), n(groups.size()), m(m), groups(std::move(groups)) {
  const auto trailing = this->groups.end() - m;
  const bool has_leading = trailing != this->groups.begin();
  const int last_group = has_leading ? 1 + *std::max_element(this->groups.begin(), trailing) : 0;
  std::fill(trailing, this->groups.end(), last_group);
}

bool SparseCholesky::set_matrix(const LowerTriplets& triplets) {
  cholmod_common& common = cholmod->common;
  cholmod_sparse* const matrix = cholmod->sum_up(triplets, n);
  if (order.empty()) {
    order.resize(n);
    cholmod_camd(matrix, nullptr, 0, groups.data(), order.data(), &common);
    cholmod->check("ordering");
    std::iota(order.end() - m, order.end(), n - m);
    groups = {};
  }
  if (cholmod->set(matrix, order))
    return false;
  cholmod_free_factor(&cholmod->factor, &common);
  cholmod->factor = cholmod_analyze(cholmod->matrix, &common);
  cholmod->check("analysis");
  return true;
}

SparseCholesky::~SparseCholesky() = default;

namespace {

/// Makes parallel regions of OpenMP run on one thread while it lives. CHOLMOD asks for four in each
/// supernode, besides the threads of BLAS, and on few cores waits longer for them than they save.
class OneThread {
public:
  OneThread() { omp_set_max_active_levels(0); }
  ~OneThread() { omp_set_max_active_levels(levels); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

private:
  const int levels = omp_get_max_active_levels();
};

} // namespace

void SparseCholesky::factorise() {
  // Mesh, assembly and ordering leave much free memory behind, in pieces that a large factor does
  // not fit.
  cholmod_free_work(&cholmod->common);
  release_freed_memory();
  const OneThread one_thread;
  cholmod_factorize(cholmod->matrix, cholmod->factor, &cholmod->common);
  cholmod->check("factorisation");
}

std::vector<double> SparseCholesky::multiply(const std::vector<double>& x) const {
  std::vector<double> permuted = to_order(x), product(x.size());
  cholmod_dense source = Cholmod::view(permuted.data(), x.size());
  cholmod_dense target = Cholmod::view(product.data(), x.size());
  double one[2] = {1, 0}, zero[2] = {0, 0};
  cholmod_sdmult(cholmod->matrix, 0, one, zero, &source, &target, &cholmod->common);
  return from_order(product);
}

std::vector<double> SparseCholesky::forward(const std::vector<double>& b) {
  return cholmod->solve(CHOLMOD_L, to_order(b));
}

std::vector<double> SparseCholesky::backward(const std::vector<double>& y) {
  return from_order(cholmod->solve(CHOLMOD_Lt, y));
}

/// P x
std::vector<double> SparseCholesky::to_order(const std::vector<double>& x) const {
  std::vector<double> permuted(x.size());
  for (std::size_t k = 0; k < x.size(); ++k)
    permuted[k] = x[order[k]];
  return permuted;
}

/// P^T x
std::vector<double> SparseCholesky::from_order(const std::vector<double>& x) const {
  std::vector<double> permuted(x.size());
  for (std::size_t k = 0; k < x.size(); ++k)
    permuted[order[k]] = x[k];
  return permuted;
}

dealii::FullMatrix<double> SparseCholesky::trailing_factor() const {
  const cholmod_factor& factor = *cholmod->factor;
  const int* const first_columns = static_cast<const int*>(factor.super);
  const int* const row_starts = static_cast<const int*>(factor.pi);
  const int* const value_starts = static_cast<const int*>(factor.px);
  const int* const rows = static_cast<const int*>(factor.s);
  const double* const values = static_cast<const double*>(factor.x);
  const int first = static_cast<int>(n) - m;

  dealii::FullMatrix<double> trailing(m, m);
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

double SparseCholesky::n_factor_entries() const {
  return cholmod->factor->xsize;
}

} // namespace rollwave
