#include "rollwave/solver/sparse_factor.h"

#include "rollwave/base/mpi_processes.h"
#include "rollwave/solver/distributed_factor.h"
#include "rollwave/solver/serial_factor.h"

namespace rollwave {

std::unique_ptr<SystemMatrix>
make_system_matrix(const RingSpace& space, const dealii::AffineConstraints<double>& constraints,
                   const std::vector<SurfaceNode>& contact_nodes) {
  if (is_serial(space.communicator()))
    return std::make_unique<SerialMatrix>(space, constraints, contact_nodes);
  return std::make_unique<DistributedMatrix>(space, constraints, contact_nodes);
}

} // namespace rollwave
