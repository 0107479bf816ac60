#ifndef ROLLWAVE_REMARKS_H
#define ROLLWAVE_REMARKS_H

#include "result.h"
#include "scene.h"

#include <string>
#include <vector>

namespace rollwave {

/// What a reader of the figures should know beside them: that contact ends with the zone, that the
/// surface lies within the road outside of it, that the bound of the error says nothing, that
/// contact is held by very few nodes, or that displacements exceed the thickness of the ring.
std::vector<std::string> remarks_on(const Scene& scene, const Parameters& parameters,
                                    const Result& result);

} // namespace rollwave

#endif
