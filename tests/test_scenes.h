#pragma once

#include "rollwave/base/text.h"
#include "rollwave/mesh/contact_boundary.h"
#include "rollwave/parameters/parameters.h"
#include "rollwave/run/simulation.h"

#include <deal.II/grid/tria.h>

#include <string>
#include <vector>

namespace rollwave {

/// Such as "Road/Distance=0.80000000000000004".
std::string assignment(const std::string& key, double value);

/// Parameters from assignments like "Mesh/Degree=1".
Parameters parameters_of(const std::vector<std::string>& assignments);

/// @p parameters with further assignments.
Parameters with(Parameters parameters, const std::vector<std::string>& assignments);

/// A scene of the paper (M2AN 25 (1991), section 8) with a = 0.5 and b = 1, and its exact answer
/// from a semi-analytic solution.
struct PaperScene {
  int figure;
  double distance;
  double angular_velocity;
  double force_density;
  double half_width;
  double force;
  double energy;
  double peak_pressure;

  Parameters parameters() const;
};

const std::vector<PaperScene>& paper_scenes();

/// Mesh, space and contact nodes of @p parameters for @p scene, without solving anything.
struct MeshAndSpace {
  MeshAndSpace(const Scene& scene, const Parameters& parameters);

  std::unique_ptr<dealii::Triangulation<2>> triangulation;
  RingSpace space;
  ContactBoundary boundary;
};

/// The load of a scene's force.
FieldVector assemble_load(const RingSpace& space, const Scene& scene);

/// A scene that touches a constant obstacle phi around the whole circle.
Scene full_circle(double inner_radius, double outer_radius, double angular_velocity, double phi);

} // namespace rollwave
