#ifndef ROLLWAVE_RUN_REMARKS_H
#define ROLLWAVE_RUN_REMARKS_H

#include "rollwave/run/result.h"
#include "rollwave/run/run_options.h"
#include "rollwave/scene/scene.h"

#include <string>
#include <vector>

namespace rollwave {

/// What a reader of the figures should know beside them: that contact ends with the zone, that the
/// surface lies within the road outside of it, that the bound of the error says nothing, that
/// contact is held by very few nodes, or that displacements exceed the thickness of the ring.
std::vector<std::string> remarks_on(const Scene& scene, const RunOptions& options,
                                    const Result& result);

} // namespace rollwave

#endif
