#pragma once

#include "rollwave/study/study_record.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace rollwave {

/// Runs that differ in how fine their meshes are only, in the order of the study.
struct Family {
  std::string name; ///< the settings that they have in common
  std::vector<unsigned int> runs;
  bool is_adaptive; ///< true if any of them refines adaptively
};

std::vector<Family> find_families(const Study& study);

/// For each family with two meshes or more the errors over the number N of unknowns with their
/// orders in N^(-1/2), which is h up to a constant where all cells are cut alike. With three meshes
/// or more also the orders over the last three refinements, fitted by least squares, with the
/// standard errors of the fits.
void report_orders(std::ostream& out, const Study& study);

} // namespace rollwave
