#ifndef ROLLWAVE_STUDY_CONVERGENCE_H
#define ROLLWAVE_STUDY_CONVERGENCE_H

#include "rollwave/study/study_record.h"

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace rollwave {

/// Runs that differ in how fine their meshes are only, in the order of the study.
struct Family {
  std::string name; ///< what they have in common
  std::vector<unsigned int> runs;
  bool is_adaptive;  ///< whether any refines adaptively: then its orders are in N^(-1/2), not in h
  bool is_cut_alike; ///< whether all cells are cut alike from mesh to mesh, adaptively or not
};

std::vector<Family> find_families(const Study& study);

/// The order of the error in the energy norm, or else of its certified bound, from the run before
/// in its family: in h where all cells are cut alike, in N^(-1/2) where the meshes are adaptive,
/// otherwise nullopt.
std::optional<double> observed_order(const Study& study, const std::vector<Family>& families,
                                     unsigned int run);

/// For each family with three meshes or more the orders of its errors over the last three
/// refinements, fitted by least squares, with the standard errors of the fits.
void report_orders(std::ostream& out, const Study& study);

} // namespace rollwave

#endif
