#pragma once

#include "rollwave/adapt/marking.h"
#include "rollwave/contact/contact_problem.h"
#include "rollwave/error_bound/error_bound.h"
#include "rollwave/mesh/ring_mesh.h"
#include "rollwave/scene/scene.h"

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
};

/// The scene of @p options.
/// @throws BadValue as scaled_scene() and where something is asked for that needs the error bound
Scene make_scene(const RunOptions& options);

} // namespace rollwave
