#ifndef ROLLWAVE_RUN_DISCRETISATION_H
#define ROLLWAVE_RUN_DISCRETISATION_H

#include "rollwave/error_bound/force_integral.h"
#include "rollwave/error_bound/stress_function.h"
#include "rollwave/mesh/ring_space.h"
#include "rollwave/run/run_options.h"
#include "rollwave/solver/choose_solver.h"

#include <deal.II/grid/tria.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rollwave {

/// What scenes on one mesh share. Each part is made when it is first needed, and updated for
/// another scene at the cost of what differs.
struct MeshCache {
  SolverChoice stiffness; ///< its kind outlives the solver
  std::unique_ptr<StressFunction> dual;
  std::unique_ptr<ForceIntegral> force; ///< nullptr without force
  std::optional<FieldVector> load;      ///< of the same
  std::string force_text;               ///< of the scene that force and load belong to

  /// Makes the dual problem that of a scene. @throws as StressFunction
  StressFunction& dual_of(const Scene& scene, const RingSpace& space, Work& work);
};

/// A mesh with its space and its matrices; the members are listed in the order of their dependence.
struct Discretisation {
  /// The first mesh of @p options.
  /// @param is_shared true if several scenes are solved on it, so that its matrices are kept
  /// @throws BadInput for a mesh without a node in the zone of possible contact
  Discretisation(const Scene& scene, const RunOptions& options, MPI_Comm communicator,
                 bool is_shared, Work& work);

  std::unique_ptr<dealii::Triangulation<2>> triangulation;
  std::unique_ptr<RingSpace> space;
  MeshCache cache;
  bool is_shared;

  MPI_Comm communicator() const { return space->communicator(); }

  /// Refines where @p indicators of the cells are large, as refine_mesh(), and drops what belongs
  /// to the old mesh. Returns false, and changes nothing, where the mesh would get too large or no
  /// cell is marked.
  bool refine(const std::vector<double>& indicators, const Scene& scene, const RunOptions& options,
              Work& work);
};

/// The most cells that RefinementOptions::most_unknowns allow.
double most_cells(const RunOptions& options);

} // namespace rollwave

#endif
