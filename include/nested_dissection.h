#ifndef ROLLWAVE_NESTED_DISSECTION_H
#define ROLLWAVE_NESTED_DISSECTION_H

#include "ring_space.h"

#include <vector>

namespace rollwave {

/**
 * For each degree of freedom the group in which nested dissection eliminates it (A. George, SIAM J.
 * Numer. Anal. 10 (1973) 345-363). The ring is halved again and again along lines of the mesh,
 * across its longer side in cells; the nodes on these lines belong to the group of their
 * halving, the earlier the higher. Group 0 is what lies inside the last boxes, which are a few
 * cells of the node's own size.
 */
std::vector<int> dissect(const RingSpace& space);

} // namespace rollwave

#endif
