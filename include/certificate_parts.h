#ifndef ROLLWAVE_CERTIFICATE_PARTS_H
#define ROLLWAVE_CERTIFICATE_PARTS_H

#include "parameters.h"
#include "ring_space.h"

namespace rollwave {

struct MeshSystem;
struct Scene;
class Work;

/// Makes the dual parts of @p system that the certificates of all solutions of a scene have in
/// common, unless it has them: the matrix of the potential and what belongs to the force, of which
/// neither knows the other. Of the parts that are there already it looks at the load only, so that
/// it may run while the scene is solved. A force that is no number takes long to look at: the
/// matrix is then made in a thread of its own, where that gains time.
/// @param kind that of the potential's solver
/// @throws BadInput where the force is not finite, NotSolved when memory is short
void prepare_certificate(const RingSpace& space, const Scene& scene, SolverKind kind,
                         MeshSystem& system, Work& work);

/// Whether it has nothing to do.
bool is_certificate_prepared(const Scene& scene, const MeshSystem& system);

} // namespace rollwave

#endif
