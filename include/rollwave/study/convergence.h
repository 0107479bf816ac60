#pragma once

#include "rollwave/plot/plots.h"
#include "rollwave/study/study.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace rollwave {

/// Runs that differ only in the fineness of their meshes, in the order of the study.
struct Family {
  std::string name; ///< the settings that they have in common
  std::vector<unsigned int> runs;
  bool is_adaptive; ///< true if any of them cuts a part of its cells
};

std::vector<Family> find_families(const Study& study);

/// Prints a table for each family with two or more meshes: the errors and their orders in h, the
/// largest diameter of a cell; for adaptive meshes in N^(-1/2), N the number of unknowns. For three
/// or more meshes it also prints the orders over the last three refinements, fitted by least
/// squares, with standard errors, and next to them the expected order, if each refinement is one in
/// both directions.
void report_orders(std::ostream& out, const Study& study);

/// The error over the quantity @p x for each family of runs that differ in the fineness of their
/// meshes: the true error or, where that is not known for a family, its bound.
/// @param order_factor slopes over expected orders; 0 for none
Panel error_panel(const Study& study, const std::string& x, const std::string& x_label,
                  double order_factor);

} // namespace rollwave
