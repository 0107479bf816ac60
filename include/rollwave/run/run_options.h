#pragma once

#include "rollwave/adapt/marking.h"
#include "rollwave/contact/contact_problem.h"
#include "rollwave/error_bound/error_bound.h"
#include "rollwave/mesh/ring_mesh.h"
#include "rollwave/scene/scene.h"
#include "rollwave/solver/choose_solver.h"

namespace rollwave {

/// All that one run depends on, by the sections of the parameter file.
struct RunOptions {
  CylinderOptions cylinder;
  RoadOptions road;
  MaterialOptions material;
  struct Mesh : MeshOptions, RefinementOptions {
  } mesh;
  CertificateOptions certificate;
  ContactOptions contact;
  SolverOptions solver;
};

/// The scene of @p options.
/// @throws BadValue as make_scene() and where something is asked for that needs the error bound
Scene make_scene(const RunOptions& options);

/// Options for one solve on about a sixteenth of the cells, without refinement and certificate.
RunOptions coarser(RunOptions options);

} // namespace rollwave
