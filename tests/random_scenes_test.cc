// Scenes drawn from everything that is admitted: solved and verified, or refused with a reason.
#include "draw.h"
#include "quantities.h"
#include "rollwave/base/errors.h"
#include "rollwave/output/summary_json.h"
#include "rollwave/run/simulation.h"
#include "rollwave/scene/scene.h"
#include "rollwave/verify/reference_solution.h"
#include "test_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

using namespace rollwave;

namespace {

/// A scene and a mesh of at most some thousand unknowns.
std::vector<std::string> draw_scene(Draw& draw) {
  const double b = draw.count(0, 1) ? draw.power_of_ten(-150, 150) : 1;
  const double thickness = draw.count(0, 2) ? draw.number(0.1, 0.9) : draw.power_of_ten(-6, -1);
  const double a = draw.count(0, 3) ? b * (1 - thickness) : b * draw.power_of_ten(-6, -1);
  double speed = draw.number(0, 1);
  switch (draw.count(0, 3)) {
  case 0:
    speed = 1;
    break;
  case 1:
    speed = 1 - draw.power_of_ten(-16, -1);
    break;
  case 2:
    speed = 0;
  }
  double c = b - (b - a) * draw.number(0, 1);
  switch (draw.count(0, 4)) {
  case 0:
    c = b - (b - a) * draw.power_of_ten(-14, 0);
    break;
  case 1:
    c = a + (b - a) * draw.power_of_ten(-14, 0);
    break;
  case 2:
    c = draw.number(0.9, 2) * b;
  }
  std::vector<std::string> scene = {
      assignment("Cylinder/Outer radius", b), assignment("Cylinder/Inner radius", a),
      assignment("Cylinder/Angular velocity", speed / b), assignment("Road/Distance", c)};
  switch (draw.count(0, 3)) {
  case 0:
    scene.push_back(assignment("Cylinder/Radial force",
                               (draw.count(0, 1) ? 1 : -1) * draw.power_of_ten(-3, 8) / b));
    break;
  case 1:
    scene.push_back("Cylinder/Radial force=" + shortest_text(draw.number(-1, 1) / b) +
                    "*cos(2*z+1)*r/" + shortest_text(b));
  }
  if (draw.count(0, 3) == 0) {
    const double begin = draw.number(3.15, 6.2), end = draw.number(begin, 6.28);
    scene.push_back(assignment("Road/Contact zone", begin) + ", " + shortest_text(end));
  }
  const unsigned int degree = 1 + draw.count(0, 2);
  scene.push_back("Mesh/Degree=" + std::to_string(degree));
  scene.push_back("Mesh/Radial cells=" + std::to_string(draw.count(1, 12 / degree)));
  scene.push_back("Mesh/Angular cells=" + std::to_string(draw.count(3, 2 + 120 / degree)));
  return scene;
}

std::string text_of(const std::vector<std::string>& scene) {
  std::string text;
  for (const std::string& setting : scene)
    text += " --set '" + setting + "'";
  return text;
}

struct Counts {
  unsigned int solved = 0, short_of_accuracy = 0, bad_input = 0, not_solved = 0, compared = 0;
};

/// J, F and the vertical load of the exact solution lie within the certificate, where there is one.
bool compare_with_exact(const Scene& scene, const Parameters& parameters, const Result& result) {
  const auto exact = find_exact_solution(scene);
  if (!exact)
    return false;
  const CertifiedError& certified = *result.certified;
  // Radii are known to round-off of b, the thickness of the ring to so much less.
  const double thickness = (scene.outer_radius - scene.inner_radius) / scene.outer_radius;
  const double slack =
      10 * exact->energy_accuracy * (std::abs(exact->energy) + exact->norm_squared) +
      (1e-12 + 1e-15 / thickness) * (std::abs(exact->energy) + certified.norm_squared);
  EXPECT_LE(certified.lower_bound, exact->energy + slack);
  EXPECT_GE(certified.upper_bound, exact->energy - slack);
  // |w|^2 of the contact force is 2 pi / ln(b/a).
  const double load_slack =
      10 * exact->force_accuracy * std::abs(exact->loads.total) +
      (1e-12 + 1e-15 / thickness) *
          std::sqrt(2 * M_PI / std::log1p(thickness / (1 - thickness)) * certified.norm_squared);
  EXPECT_LE(certified.loads.total.lower, exact->loads.total + load_slack);
  EXPECT_GE(certified.loads.total.upper, exact->loads.total - load_slack);
  EXPECT_LE(certified.loads.vertical.lower, exact->loads.vertical + load_slack);
  EXPECT_GE(certified.loads.vertical.upper, exact->loads.vertical - load_slack);
  // F - F_h = -a(u - u_h, w) for every w of the mesh that is 1 on the surface: that which depends
  // on r alone has a(w, w) of about 2 pi / ln(b/a), less than twice that if the cells are coarse.
  const double depth = std::log1p((scene.outer_radius - scene.inner_radius) / scene.inner_radius);
  const double radial_cells = parameters.mesh.radial_cells;
  const double norm = std::sqrt(2 * M_PI * std::max(2 / depth, radial_cells));
  // The certificate bounds |u - v|. |v - u_h| is at most as large, hence the factor 2.
  EXPECT_LE(std::abs(result.contact.loads.total - exact->loads.total),
            2 * norm * certified.energy_norm +
                10 * exact->force_accuracy * std::abs(exact->loads.total) +
                1e-12 * norm * std::sqrt(certified.norm_squared));
  return true;
}

/// Roads farther away leave less contact on the same mesh: with d between them, J is convex in the
/// distance, its slope -G grows.
void compare_with_farther_roads(Draw& draw, const Scene& scene, const Parameters& parameters,
                                const Result& nearest) {
  const double c = parameters.road.distance / scene.units.length;
  // Not less than what distances resolve.
  const double step = std::max(draw.power_of_ten(-3, -1) * std::abs(scene.outer_radius - c), 1e-12);
  std::vector<Result> results = {nearest};
  for (const int i : {1, 2})
    results.push_back(simulate(with_distance(scene, c + i * step), parameters).result);
  const double energy = results[0].energy.norm_squared + std::abs(results[0].energy.value);
  EXPECT_GE(results[0].energy.value - 2 * results[1].energy.value + results[2].energy.value,
            -1e-10 * energy);
  for (const int i : {0, 1}) {
    const ContactResultants &near = results[i].contact, &far = results[i + 1].contact;
    const double near_load = *near.loads.work_conjugate, far_load = *far.loads.work_conjugate;
    EXPECT_LE(far_load, near_load + 1e-9 * std::abs(*results[0].contact.loads.work_conjugate));
    // E(c) - E(c + d) lies between d G at both ends.
    const double fall = results[i].energy.value - results[i + 1].energy.value;
    EXPECT_LE(fall, step * near_load + 1e-10 * energy);
    EXPECT_GE(fall, step * far_load - 1e-10 * energy);
  }
}

TEST(RandomScenes, AreSolvedAndVerifiedOrRefusedAndExplained) {
  const unsigned int n_scenes = n_random_scenes(150);
  Draw draw(20);
  Counts counts;
  for (unsigned int i = 0; i < n_scenes; ++i) {
    const std::vector<std::string> settings = draw_scene(draw);
    SCOPED_TRACE("scene " + std::to_string(i) + text_of(settings));
    try {
      const Parameters parameters = parameters_of(settings);
      const Scene scene = make_scene(parameters);
      const Result result = simulate(scene, parameters).result;
      if (!shortfall_text(result.notes).empty()) {
        ++counts.short_of_accuracy;
        EXPECT_GT(result.residuals.largest(), result.residuals.allowed);
        EXPECT_LT(result.residuals.largest(), 1e-6);
      } else {
        ++counts.solved;
        EXPECT_LE(result.residuals.largest(), result.residuals.allowed);
      }
      EXPECT_LE(result.certified->lower_bound, result.certified->upper_bound);
      if (i % 12 == 0)
        counts.compared += compare_with_exact(scene, parameters, result);
      compare_with_farther_roads(draw, scene, parameters, result);
    } catch (const BadInput& refusal) {
      ++counts.bad_input;
      EXPECT_GT(std::string(refusal.what()).size(), 20u);
    } catch (const NotSolved& failure) {
      ++counts.not_solved;
      EXPECT_GT(std::string(failure.what()).size(), 20u);
    }
    if (HasFatalFailure())
      return;
  }
  std::printf("%u scenes: %u solved (%u compared with the exact answer), %u solved to less than "
              "the wanted residual, %u refused as bad input, %u not solved\n",
              n_scenes, counts.solved, counts.compared, counts.short_of_accuracy, counts.bad_input,
              counts.not_solved);
  EXPECT_EQ(counts.not_solved, 0u);
  EXPECT_GE(counts.solved, 0.95 * n_scenes);
  EXPECT_GE(counts.compared, n_scenes / 50);
}

nlohmann::json quantities_by_solving(const Parameters& parameters, const Scene& scene) {
  const Result result = simulate(scene, parameters).result;
  return quantities_of(nlohmann::json::parse(summary_json(scene, parameters, result)));
}

TEST(RandomScenes, HaveTheSameNumbersByUzawasMethod) {
  const unsigned int n_scenes = n_random_scenes(20);
  Draw draw(11);
  unsigned int n_compared = 0, n_refused = 0, n_not_solved = 0;
  for (unsigned int i = 0; i < n_scenes; ++i) {
    const std::vector<std::string> settings = draw_scene(draw);
    SCOPED_TRACE("scene " + std::to_string(i) + text_of(settings));
    try {
      const Parameters parameters = parameters_of(settings);
      const Scene scene = make_scene(parameters);
      const nlohmann::json expected = quantities_by_solving(parameters, scene);
      const nlohmann::json found =
          quantities_by_solving(with(parameters, {"Contact/Method=uzawa"}), scene);
      // Bounds are as accurate as the larger of them, and complementarity is relative to a road
      // that hairline contact hardly displaces.
      const auto tolerance = [&](const std::string& path, double wanted) {
        if (path == "/residuals/complementarity")
          return 1.;
        const double larger = path == "/energy/lower_bound"
                                  ? std::abs(expected["/energy/upper_bound"].get<double>())
                                  : 0;
        return tolerance_of_uzawa(path, std::max(std::abs(wanted), larger));
      };
      expect_same_quantities(found, expected, tolerance);
      ++n_compared;
    } catch (const BadInput&) {
      ++n_refused;
    } catch (const NotSolved& failure) {
      ++n_not_solved;
      std::printf("%u %s\n", i, failure.what());
    }
  }
  std::printf("%u scenes: %u compared, %u refused as bad input, %u not solved\n", n_scenes,
              n_compared, n_refused, n_not_solved);
  EXPECT_GT(n_compared, 0u);
}

TEST(RandomScenes, AreFoundAgainByTheirLoads) {
  const unsigned int n_scenes = n_random_scenes(40);
  Draw draw(7);
  unsigned int n_found = 0;
  for (unsigned int i = 0; i < n_scenes; ++i) {
    std::vector<std::string> settings = draw_scene(draw);
    settings.push_back("Certificate/Error bound=false");
    const auto kind = draw.one_of<LoadKind>({LoadKind::vertical, LoadKind::total});
    SCOPED_TRACE("scene " + std::to_string(i) + text_of(settings));
    const Parameters parameters = parameters_of(settings);
    std::optional<Scene> scene;
    try {
      scene = make_scene(parameters);
    } catch (const BadInput&) {
      continue;
    }
    const double c = scene->road.distance, b = scene->outer_radius, nearest = scene->least_distance;
    const double load = simulate(*scene, parameters).result.contact.loads.of(kind);
    if (!(load > 0) || c < nearest)
      continue;
    *scene = with_distance(std::move(*scene), nearest + (b - nearest) / 2);
    scene->load = Scene::Load{load, kind};
    const Result result = simulate(*scene, parameters).result;
    // Between neighbouring distances the load of a hairline contact changes by many digits.
    if (std::abs(result.road_distance - c) > 4e-16 * c) {
      EXPECT_NEAR(result.contact.loads.of(kind) / load, 1, 1e-8);
    }
    ++n_found;
  }
  EXPECT_GE(n_found, n_scenes / 4);
}

} // namespace
