// Iterations of conjugate gradients with multigrid, to 1e-10 from zero for a random right-hand
// side, with the contact nodes within 0.48 of the lowest point pinned: a table in Markdown.
#include "rollwave/scene/scene.h"
#include "rollwave/solver/amg_cg.h"
#include "test_scenes.h"

#include <deal.II/base/numbers.h>
#include <deal.II/base/timer.h>

#include <cmath>
#include <cstdio>
#include <utility>

using namespace rollwave;

namespace {

/// @param cells of degree 1, radial and angular; half as many of degree 2
void benchmark(const char* mesh, double inner_radius, const std::pair<int, int>& cells,
               int degree) {
  std::printf("| %s | %d ", mesh, degree);
  unsigned int unknowns = 0;
  double preparation = 0, solution = 0;
  for (const double speed : {0., 0.5, 0.9, 1.}) {
    const Parameters parameters = parameters_of(
        {"Cylinder/Inner radius=" + std::to_string(inner_radius),
         "Road/Distance=" + std::to_string(0.2 + 0.8 * inner_radius + 0.4 * (1 - inner_radius)),
         "Cylinder/Angular velocity=" + std::to_string(speed),
         "Mesh/Degree=" + std::to_string(degree),
         "Mesh/Radial cells=" + std::to_string(cells.first / degree),
         "Mesh/Angular cells=" + std::to_string(cells.second / degree),
         "Mesh/Most unknowns=10000000"});
    const Scene scene = make_scene(parameters);
    const Discretisation ring(scene, parameters);
    const RingSpace& space = ring.space;
    dealii::AffineConstraints<double> constraints;
    constraints.copy_from(space.constraints());
    for (const SurfaceNode& node : space.surface_nodes())
      if (std::abs(node.angle - 3 * dealii::numbers::PI / 2) < 0.48)
        constraints.add_line(node.dof);
    constraints.close();

    Work work;
    AmgCg solver(space);
    solver.set_matrix(scene, constraints, stiffness_products(space, scene), work);
    const FieldVector rhs = random_load(space, constraints);
    FieldVector u = space.make_field();
    const double size = rhs.l2_norm();
    dealii::Timer timer;
    solver.improve(
        u, rhs, [size](const FieldVector&) { return size; }, 1e-10, work);
    if (unknowns == 0)
      std::printf("| %u ", unknowns = space.n_unknowns());
    std::printf("| %u ", work.linear_iterations);
    std::fflush(stdout);
    preparation = work.total_seconds();
    solution = timer.wall_time() - preparation;
  }
  std::printf("| %.2g | %.2g |\n", preparation, solution);
  std::fflush(stdout);
}

} // namespace

int main() {
  std::printf("| cells | degree | unknowns | omega b = 0 | 0.5 | 0.9 | 1 | hierarchy [s] | "
              "iterations [s] |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const int degree : {1, 2}) {
    for (const auto& [radial, angular] : {std::pair(28, 352), {88, 1112}, {282, 3544}, {564, 7088}})
      benchmark("square", 0.5, {radial, angular}, degree);
    benchmark("10 times longer in z", 0.5, {282, 352}, degree);
    benchmark("10 times longer in r", 0.5, {28, 3520}, degree);
    benchmark("square, a = 0.99 b", 0.99, {12, 7540}, degree);
    benchmark("thick, a = 0.01 b", 0.01, {126, 800}, degree);
  }
}
