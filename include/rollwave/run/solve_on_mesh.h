#pragma once

#include "rollwave/contact/contact_problem.h"
#include "rollwave/error_bound/dual_system.h"
#include "rollwave/run/result.h"
#include "rollwave/run/run_options.h"
#include "rollwave/run/system.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rollwave {

/// The contact pressure on one mesh as a function of the angle, from which the contact iteration on
/// another mesh starts: linear between nodes, and zero where there is no contact.
class PressureProfile {
public:
  /// Without a mesh before: the iteration starts without contact.
  PressureProfile() = default;

  /// @param ends where contact begins and ends
  PressureProfile(const std::vector<SurfaceNode>& nodes, const dealii::Vector<double>& pressure,
                  const std::optional<std::pair<double, double>>& ends);

  /// The pressures at the nodes of another mesh; without entries where there was no mesh before.
  dealii::Vector<double> at(const std::vector<SurfaceNode>& nodes) const;

private:
  double at(double angle) const;

  std::map<double, double> pressures; ///< of the nodes by their angles
  std::optional<std::pair<double, double>> ends;
};

/// The objects on one mesh, at one speed and under one force, which runs may share.
struct MeshObjects {
  System system;
  std::unique_ptr<const Load> load = {};       ///< nullptr without force
  std::unique_ptr<const DualSystem> dual = {}; ///< made where a certificate is wanted
};

/// The discrete problem and its solution on one mesh.
struct MeshSolution : SolvedContact {
  FieldVector displacement = {};                ///< u_h
  std::optional<std::string> road_refusal = {}; ///< see RoadPosition::refusal
  MeshResult result = {};
};

/// The contact pressure of a solution.
PressureProfile pressure_profile(const MeshSolution& solution);

/// Solves @p scene, beginning with the contact pressures @p start.
/// @param objects of the scene's speed and force, with the nodes of its zone
/// @throws BadInput where no node lies in the zone, NotSolved when a method fails or a number
/// overflows double precision.
MeshSolution solve_on_mesh(const MeshObjects& objects, const Scene& scene,
                           const ContactOptions& options, const PressureProfile& start,
                           RunStatistics& statistics, const ContactObserver& step_ended = {});

/// The equations of the contact nodes in the zone of a solution.
ContactEquations contact_equations(const System& system, const Load* load,
                                   const ContactBoundary& boundary);

} // namespace rollwave
