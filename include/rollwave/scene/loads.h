#pragma once

#include <optional>

namespace rollwave {

enum class LoadKind {
  vertical, ///< "vertical": the load on the axle
  total     ///< "total": the integral of the pressure
};

/// The three loads b int lambda q dz, with x = z - 3 pi/2.
struct Loads {
  double total;    ///< the contact force F: q = 1
  double vertical; ///< q = cos x

  /// G = -dJ/dc: q = dphi/dc; nullopt where nodes do not resolve it, see reaches_tangent()
  std::optional<double> work_conjugate;

  double of(LoadKind kind) const { return kind == LoadKind::total ? total : vertical; }
};

} // namespace rollwave
