#ifndef ROLLWAVE_FORCE_ON_MESH_H
#define ROLLWAVE_FORCE_ON_MESH_H

#include "assembly.h"
#include "force_integrals.h"
#include "force_interpolant.h"
#include "scene.h"
#include "test_scenes.h"

#include <string>
#include <vector>

namespace rollwave {

/// G on a line.
inline double integral(const ForceColumn& column, double r) {
  std::vector<double> values;
  ForceAtRadii({r}).integrals(column, values);
  return values[0];
}

/// A force of the scene of figure 4 on a uniform mesh.
struct Force {
  Force(const std::string& expression, unsigned int radial_cells, unsigned int angular_cells,
        unsigned int degree = 1)
      : parameters(
            with(paper_scenes()[0].parameters(),
                 {"Cylinder/Radial force=" + expression, "Mesh/Degree=" + std::to_string(degree),
                  "Mesh/Radial cells=" + std::to_string(radial_cells),
                  "Mesh/Angular cells=" + std::to_string(angular_cells)})),
        scene(make_scene(parameters)), mesh(scene, parameters), extents(mesh.space),
        interpolant(mesh.space, scene, assemble_load(mesh.space, scene).moments, extents) {}

  double integral(double r, double z) const { return rollwave::integral(interpolant.column(z), r); }

  const Parameters parameters;
  const Scene scene;
  const Discretisation mesh;
  const RadialExtents extents;
  const ForceInterpolant interpolant;
};

} // namespace rollwave

#endif
