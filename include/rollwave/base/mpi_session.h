#ifndef ROLLWAVE_BASE_MPI_SESSION_H
#define ROLLWAVE_BASE_MPI_SESSION_H

namespace rollwave {

/// Proves that MPI runs, which Trilinos' matrices and multigrid need on one process as well: a
/// member of this type goes before them. The first one starts MPI, which then lasts until the
/// program ends.
class MpiSession {
public:
  MpiSession();
};

} // namespace rollwave

#endif
