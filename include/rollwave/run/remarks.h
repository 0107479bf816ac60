#ifndef ROLLWAVE_RUN_REMARKS_H
#define ROLLWAVE_RUN_REMARKS_H

#include "rollwave/mesh/ring_space.h"
#include "rollwave/run/result.h"
#include "rollwave/run/run_options.h"
#include "rollwave/scene/scene.h"

#include <string>
#include <vector>

namespace rollwave {

/// What a reader of the figures should know beside them: that contact ends with the zone, that the
/// surface lies within the road outside of it, that the bound of the error says nothing, that the
/// mesh does not resolve the contact, or that displacements exceed the thickness of the ring.
std::vector<std::string> remarks_on(const Scene& scene, const RunOptions& options,
                                    const RingSpace& space, const Result& result);

/// How many unknowns the wanted error needs by the rate of the meshes so far, such as "1e-07 needs
/// about 4e+06 unknowns at degree 2"; empty where these are too few to tell.
std::string cost_text(const RunOptions& options, const Result& result);

} // namespace rollwave

#endif
