#pragma once

#include <deal.II/dofs/dof_handler.h>

#include <vector>

namespace rollwave {

/**
 * The degrees of freedom of the cells of this process in the order of elimination by nested
 * dissection (A. George, SIAM J. Numer. Anal. 10 (1973) 345-363). The ring is halved again and
 * again along lines of the mesh. In each part, the nodes of the two halves come first and the nodes
 * on the dividing line last. The first line across the ring includes the seam. A part is halved in
 * the direction of lower cost: the squared number of nodes on the line, divided by the number of
 * pairs of nodes that the line separates.
 */
std::vector<dealii::types::global_dof_index> dissect(const dealii::DoFHandler<2>& handler);

} // namespace rollwave
