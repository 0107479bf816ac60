#ifndef ROLLWAVE_STIFFNESS_TRIPLETS_H
#define ROLLWAVE_STIFFNESS_TRIPLETS_H

#include "ring_space.h"
#include "sparse_cholesky.h"

#include <vector>

namespace rollwave {

struct Scene;

/// The number of each degree of freedom among the unknowns, in their order but with the contact
/// nodes last; -1 where a constraint holds.
std::vector<int> number_unknowns(const RingSpace& space);

/// The stiffness matrix of the unknowns: constrained degrees of freedom are replaced by the
/// combination of unknowns that their constraint names.
LowerTriplets assemble_triplets(const RingSpace& space, const Scene& scene,
                                const std::vector<int>& unknown_of_dof);

} // namespace rollwave

#endif
