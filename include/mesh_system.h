#ifndef ROLLWAVE_MESH_SYSTEM_H
#define ROLLWAVE_MESH_SYSTEM_H

#include "bubble_columns.h"
#include "dual_potential.h"
#include "force_contribution.h"
#include "solver_choice.h"

#include <deal.II/base/quadrature_lib.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rollwave {

/// What the certificates of scenes on one mesh with one speed and one force share.
struct DualParts {
  /// @param force the text of the scene's force, empty without force
  /// @param moments those of its Load
  /// @param breaks likewise
  /// @param constraints those of the DualPotential, but for inhomogeneities
  /// @throws BadInput where the force is not finite
  DualParts(const RingSpace& space, const Scene& scene, const std::string& force,
            const std::vector<double>& moments, const LoadBreaks& breaks,
            const dealii::AffineConstraints<double>& constraints);

  /// Whether they are those of a scene with this force.
  bool belong_to(const Scene& scene, const std::string& force) const;

  /// Whether G has values that Gauss' rule of the element in z does not integrate exactly.
  bool has_uneven_force() const { return interpolant && !interpolant->is_exact(); }

  const double angular_velocity;
  const std::string force;
  RadialShapesOfMesh shapes;
  const RadialExtents extents;                 ///< of no cells without an uneven force
  std::optional<ForceInterpolant> interpolant; ///< nullopt without force
  ForceJumps jumps;                            ///< none without an uneven force
  const dealii::QGauss<1> gauss;               ///< for the bound's integrals along z
  std::optional<ForceColumns> columns;         ///< with lines at its points
  std::optional<ForceContribution> of_force;   ///< of an uneven one
};

/// What scenes on one mesh share. Each part is made when it is first needed and turned to another
/// scene at the cost of what differs; a part that is dropped is made again.
struct MeshSystem {
  SolverChoice stiffness; ///< its kind outlives the solver
  std::unique_ptr<DualPotential> potential;
  std::optional<BubbleColumns> bubbles; ///< of the same speed
  std::unique_ptr<DualParts> dual;
  std::optional<FieldVector> load; ///< of assemble_load(), nullopt without force
  std::vector<double> moments;     ///< of the same Load
  LoadBreaks breaks;               ///< likewise
  std::string force;               ///< the text of the force that the load belongs to
  bool is_kept = true; ///< whether another scene may come; else solvers go when they have solved
};

} // namespace rollwave

#endif
