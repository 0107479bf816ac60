#pragma once

#include <deal.II/dofs/dof_handler.h>

#include <vector>

namespace rollwave {

/**
 * The degrees of freedom in the order of elimination by nested dissection (A. George, SIAM J.
 * Numer. Anal. 10 (1973) 345-363). The ring is halved again and again along lines of the mesh; of
 * each part both halves come first and the nodes on the line between them last. The first line
 * across the ring takes the seam with it. Which way a part is halved is decided by the number of
 * nodes on the line, squared, over the number of pairs that it parts.
 */
std::vector<dealii::types::global_dof_index> dissect(const dealii::DoFHandler<2>& handler);

} // namespace rollwave
