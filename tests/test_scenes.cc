#include "test_scenes.h"

#include "rollwave/error_bound/force_integral.h"
#include "rollwave/mesh/ring_mesh.h"

#include <deal.II/base/numbers.h>

namespace rollwave {

std::string assignment(const std::string& key, double value) {
  return key + "=" + shortest_text(value);
}

Parameters parameters_of(const std::vector<std::string>& assignments) {
  return with({}, assignments);
}

Parameters with(Parameters parameters, const std::vector<std::string>& assignments) {
  std::vector<Setting> settings = parameters.settings;
  for (const std::string& assignment : assignments)
    settings.push_back(parse_setting(assignment, "test"));
  return read_parameters(settings);
}

Parameters PaperScene::parameters() const {
  return parameters_of({"Cylinder/Angular velocity=" + std::to_string(angular_velocity),
                        "Cylinder/Radial force=" + std::to_string(force_density),
                        "Road/Distance=" + std::to_string(distance)});
}

const std::vector<PaperScene>& paper_scenes() {
  static const std::vector<PaperScene> scenes = {
      {4, 0.80, 0.5, 0, 0.479844, 0.33249897643, 0.02906970811, 0.424857},
      {5, 0.80, 1.0, 0, 0.551330, 0.28652864914, 0.02417129942, 0.337470},
      {6, 0.80, 0.5, 1, 0.640501, 0.71789375251, -0.02778533021, 0.669696},
      {7, 0.85, 0.5, 0, 0.397980, 0.22457992211, 0.01483616679, 0.349886},
      {8, 0.75, 0.5, 0, 0.555599, 0.45466589415, 0.04942773930, 0.495971}};
  return scenes;
}

MeshAndSpace::MeshAndSpace(const Scene& scene, const Parameters& parameters)
    : triangulation(make_ring_mesh(scene, parameters.mesh, MPI_COMM_SELF)),
      space(*triangulation, scene, parameters.mesh.degree), boundary(space, scene.zone()) {}

FieldVector assemble_load(const RingSpace& space, const Scene& scene) {
  const RadialShapesOfMesh shapes(space, scene);
  return assemble_load(space, ForceIntegral(space, scene, shapes), shapes);
}

Scene full_circle(double inner_radius, double outer_radius, double angular_velocity, double phi) {
  // The inside of a drum around the axle.
  const double distance = outer_radius + phi;
  const Road road = {outer_radius, distance, -1 / distance};
  Scene scene = {inner_radius,
                 outer_radius,
                 angular_velocity,
                 {},
                 make_obstacle(road),
                 dealii::numbers::PI / 2,
                 5 * dealii::numbers::PI / 2};
  scene.road = road;
  return scene;
}

} // namespace rollwave
