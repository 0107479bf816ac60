#pragma once

namespace rollwave {

enum class LoadKind {
  vertical,      ///< "vertical": the load on the axle
  total,         ///< "total": the integral of the pressure
  work_conjugate ///< "work-conjugate": minus the derivative of the energy by the distance
};

/// The three loads b int lambda q dz, with x = z - 3 pi/2.
struct Loads {
  double total;          ///< the contact force F: q = 1
  double vertical;       ///< q = cos x
  double work_conjugate; ///< G = -dJ/dc: q = dphi/dc

  double of(LoadKind kind) const {
    return kind == LoadKind::total ? total : kind == LoadKind::vertical ? vertical : work_conjugate;
  }
};

} // namespace rollwave
