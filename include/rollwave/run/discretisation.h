#pragma once

#include "rollwave/error_bound/force_integral.h"
#include "rollwave/error_bound/stress_function.h"
#include "rollwave/mesh/contact_boundary.h"
#include "rollwave/run/run_options.h"
#include "rollwave/solver/choose_solver.h"

#include <deal.II/grid/tria.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rollwave {

/// The data that scenes on one mesh share. Each part is made when it is first needed, and updated
/// for another scene at the cost of what differs.
struct MeshCache {
  SolverChoice stiffness; ///< its kind stays set when the solver is freed
  std::unique_ptr<StressFunction> stress_function;
  std::unique_ptr<ForceIntegral> force; ///< nullptr without force
  std::optional<FieldVector> load;      ///< the vector of (f, v); nullopt without force
  std::string force_text;               ///< of the scene that force and load belong to

  /// The stress function for the speed of a scene. @throws as StressFunction
  StressFunction& stress_function_for(const Scene& scene, const RingSpace& space,
                                      RunStatistics& statistics);
};

/// A mesh with its space and its matrices; the members are listed in the order of their dependence.
struct Discretisation {
  /// The first mesh of @p options.
  /// @param shared_zone given if several scenes use the mesh, whose matrices are then kept; it
  /// contains the zones of all of them
  /// @throws BadInput for a mesh without a node in the zone of possible contact
  Discretisation(const Scene& scene, const RunOptions& options, MPI_Comm communicator,
                 RunStatistics& statistics,
                 const std::optional<std::pair<double, double>>& shared_zone = {});

  std::unique_ptr<dealii::Triangulation<2>> triangulation;
  std::unique_ptr<RingSpace> space;
  bool is_shared;
  std::pair<double, double> widest_zone; ///< of all scenes that are solved on it
  ContactBoundary candidates;            ///< of the widest zone
  MeshCache cache;

  MPI_Comm communicator() const { return space->communicator(); }

  /// Refines where @p indicators of the cells are large, as refine_mesh(), and drops what belongs
  /// to the old mesh. Returns false, and changes nothing, where the mesh would get too large or no
  /// cell is marked.
  bool refine(const std::vector<double>& indicators, const Scene& scene, const RunOptions& options,
              RunStatistics& statistics);
};

/// The most cells that MeshOptions::most_unknowns allows.
double most_cells(const RunOptions& options);

} // namespace rollwave
