// The program's answers against exact ones and the identities that every answer obeys.
#include "test_scenes.h"

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace rollwave;
using dealii::numbers::PI;

namespace {

Result solve(const Parameters& parameters) {
  return simulate(make_scene(parameters), parameters).result;
}

class PaperFigure : public testing::TestWithParam<PaperScene> {};

/// A scene of the paper on a mesh of nearly 100 000 unknowns.
void expect_exact_values(const PaperScene& paper, const std::vector<std::string>& mesh,
                         double tolerance) {
  const Result result = solve(with(paper.parameters(), mesh));
  EXPECT_LE(result.mesh.n_unknowns, 100000u);
  EXPECT_NEAR(result.contact.loads.total, paper.force, tolerance * paper.force);
  EXPECT_NEAR(result.energy.value, paper.energy, tolerance * std::abs(paper.energy));
  EXPECT_NEAR(result.contact.half_width(), paper.half_width, 2e-3 * paper.half_width);
  EXPECT_NEAR(result.contact.peak_pressure, paper.peak_pressure, 1e-3 * paper.peak_pressure);
  EXPECT_LE(result.history.size(), 12u);
  EXPECT_LT(result.residuals.largest(), 1e-11);
}

TEST_P(PaperFigure, HasItsExactValuesWithQ1) {
  expect_exact_values(GetParam(),
                      {"Mesh/Degree=1", "Mesh/Radial cells=118", "Mesh/Angular cells=844"}, 5e-5);
}

TEST_P(PaperFigure, HasItsExactValuesWithQ2) {
  expect_exact_values(GetParam(),
                      {"Mesh/Degree=2", "Mesh/Radial cells=22", "Mesh/Angular cells=1112"}, 1e-5);
}

TEST_P(PaperFigure, EnergyErrorFallsByFourWithEachRefinementOfQ1) {
  std::vector<double> errors;
  for (const int refinements : {0, 1, 2, 3}) {
    const Result result = solve(with(
        GetParam().parameters(), {"Mesh/Degree=1", "Mesh/Radial cells=12", "Mesh/Angular cells=84",
                                  "Mesh/Global refinements=" + std::to_string(refinements)}));
    errors.push_back(std::abs(result.energy.value - GetParam().energy));
  }
  for (unsigned int i = 1; i < errors.size(); ++i)
    EXPECT_NEAR(errors[i - 1] / errors[i], 4, 0.8) << "refinement " << i;
}

TEST_P(PaperFigure, EnergyNormIsTheWorkOfForceAndRoad) {
  // a(u, u) = (f, u) - sum N_i phi_i, and J = a(u, u)/2 - (f, u)
  const Parameters parameters = GetParam().parameters();
  const Result result = solve(parameters);
  double work_of_road = 0;
  const auto& rows = result.contact_rows;
  const Scene scene = make_scene(parameters);
  const MeshAndSpace ring(scene, parameters);
  for (unsigned int i = 0; i < rows.size(); ++i)
    work_of_road += ring.boundary.contact_nodes()[i].weight * rows[i].pressure * rows[i].phi;
  const double work_of_force = result.energy.norm_squared / 2 - result.energy.value;
  EXPECT_NEAR(result.energy.norm_squared, work_of_force - work_of_road,
              1e-12 * result.energy.norm_squared);
}

TEST_P(PaperFigure, LoadIsTheSlopeOfTheEnergyOverTheDistance) {
  // E'(c) = -G holds on every mesh; the central difference is exact to second order.
  const double step = 1e-4;
  const auto at = [&](double distance) {
    return solve(with(GetParam().parameters(),
                      {assignment("Road/Distance", distance), "Mesh/Angular cells=120"}));
  };
  const double c = GetParam().distance;
  const double slope = (at(c + step).energy.value - at(c - step).energy.value) / (2 * step);
  const double load = *at(c).contact.loads.work_conjugate;
  EXPECT_NEAR(slope, -load, 1e-5 * load);
}

INSTANTIATE_TEST_SUITE_P(, PaperFigure, testing::ValuesIn(paper_scenes()),
                         [](const auto& info) { return std::to_string(info.param.figure); });

// Numbers of the user may be off by some last digits; alpha must not be negative for that.
TEST(Scene, IsEllipticUpToTheRoundedCriticalSpeed) {
  for (const double b : {1., 3., 0.7, 0.3, 1e-3 / 3})
    for (const char* modulus : {"1", "3"}) {
      const double critical = std::sqrt(std::stod(modulus)) / b;
      for (double omega = std::nextafter(critical, 0); omega <= critical * (1 + 8e-16);
           omega = std::nextafter(omega, 2 * omega)) {
        const Scene scene = make_scene(parameters_of(
            {assignment("Cylinder/Inner radius", b / 2), assignment("Cylinder/Outer radius", b),
             assignment("Cylinder/Angular velocity", omega), assignment("Road/Distance", 0.8 * b),
             std::string("Material/Shear modulus=") + modulus}));
        EXPECT_GE(scene.alpha(scene.outer_radius), 0);
        EXPECT_NEAR(scene.angular_velocity * scene.outer_radius, 1, 1e-15);
      }
    }
}

TEST(ActiveSetOnStretchedCells, FindsTheSolution) {
  // Long in r, the cells make the surface answer like a membrane, where signs move each end by one
  // node in a step; long in z, they leave a handful of nodes.
  for (const PaperScene& paper : paper_scenes())
    for (const auto& mesh : std::vector<std::vector<std::string>>{
             {"Mesh/Degree=1", "Mesh/Radial cells=1", "Mesh/Angular cells=3000"},
             {"Mesh/Degree=1", "Mesh/Radial cells=8", "Mesh/Angular cells=6000"},
             {"Mesh/Degree=2", "Mesh/Radial cells=2", "Mesh/Angular cells=2000"},
             {"Mesh/Degree=3", "Mesh/Radial cells=2", "Mesh/Angular cells=600"},
             {"Mesh/Degree=1", "Mesh/Radial cells=400", "Mesh/Angular cells=40"}}) {
      // One row of long cells certifies nothing, which would be a remark.
      const Result result =
          solve(with(with(paper.parameters(), mesh), {"Certificate/Error bound=false"}));
      // Displacements stretch the linear model.
      EXPECT_LE(texts_of(result.notes, Note::Kind::remark).size(), 1u);
      EXPECT_LT(result.residuals.penetration, 1e-11);
      EXPECT_LT(result.residuals.negative_pressure, 1e-11);
    }
}

class Symmetry : public testing::TestWithParam<int> {
protected:
  Parameters parameters = parameters_of({"Mesh/Degree=" + std::to_string(GetParam()),
                                         "Mesh/Radial cells=8", "Mesh/Angular cells=100"});
};

TEST_P(Symmetry, RotationByWholeCellsTurnsTheSolution) {
  const Scene scene = make_scene(parameters);
  const Result original = simulate(scene, parameters).result;
  // By 25 cells to the side, and by 50 onto the seam.
  for (const int cells : {1, 25, 50}) {
    const double turn = 2 * PI * cells / 100;
    Scene turned = make_scene(parameters);
    turned.zone_begin -= turn;
    turned.zone_end -= turn;
    turned.phi = {[&scene, turn](double z) { return scene.phi(z + turn); },
                  [&scene, turn](double z) { return scene.phi.slope(z + turn); }};
    const Result result = simulate(turned, parameters).result;
    EXPECT_EQ(result.contact.active_nodes, original.contact.active_nodes);
    EXPECT_NEAR(result.contact.loads.total, original.contact.loads.total, 1e-12);
    EXPECT_NEAR(result.energy.value, original.energy.value, 1e-13);
    ASSERT_EQ(result.contact_rows.size(), original.contact_rows.size());
    for (unsigned int i = 0; i < result.contact_rows.size(); ++i)
      EXPECT_NEAR(result.contact_rows[i].pressure, original.contact_rows[i].pressure, 1e-11);
  }
}

TEST_P(Symmetry, RotationOntoTheSeamTurnsAdaptiveMeshesToo) {
  // Slanted, so that no two cells have the same indicator, with a force that hanging nodes see.
  const auto slanted = [](double turn, double unevenness) {
    Scene scene = make_scene(parameters_of({}));
    scene.force.density = [turn, unevenness](double r, double z) {
      return r * (1 + unevenness * std::cos(z + turn + 0.4)) / 10;
    };
    scene.phi = {
        [phi = scene.phi, turn](double z) { return phi(z + turn) + 0.03 * std::sin(z + turn); },
        [phi = scene.phi, turn](double z) {
          return phi.slope(z + turn) + 0.03 * std::cos(z + turn);
        }};
    scene.zone_begin -= turn;
    scene.zone_end -= turn;
    return scene;
  };
  const Parameters adaptive =
      with(parameters, {"Mesh/Radial cells=3", "Mesh/Angular cells=40", "Mesh/Adaptive cycles=6"});
  for (const double unevenness : {0, 1}) {
    const Result original = simulate(slanted(0, unevenness), adaptive).result;
    const CertifiedError& bounds = *original.certified;
    // The part of the bounds for an uneven force depends on the cells, which do not turn.
    const double tolerance = unevenness == 0 ? 1e-12 * std::abs(original.energy.value)
                                             : 1e-3 * (bounds.upper_bound - bounds.lower_bound);
    for (const int cells : {17, 20}) {
      const Result turned = simulate(slanted(2 * PI * cells / 40, unevenness), adaptive).result;
      EXPECT_EQ(turned.mesh.n_unknowns, original.mesh.n_unknowns);
      EXPECT_EQ(turned.contact.active_nodes, original.contact.active_nodes);
      EXPECT_NEAR(turned.energy.value / original.energy.value, 1, 1e-12);
      EXPECT_NEAR(turned.contact.loads.total / original.contact.loads.total, 1, 1e-11);
      EXPECT_NEAR(turned.certified->upper_bound, bounds.upper_bound, tolerance);
      EXPECT_NEAR(turned.certified->lower_bound, bounds.lower_bound, tolerance);
      EXPECT_NEAR(turned.certified->energy_norm / bounds.energy_norm, 1,
                  unevenness == 0 ? 1e-6 : 1e-4);
    }
  }
}

TEST_P(Symmetry, MirroringMirrorsTheSolution) {
  const Result original = solve(
      with(parameters, {"Road/Contact zone=4.1, 5.6", "Cylinder/Radial force=r + sin(z + 1)"}));
  const Result mirror =
      solve(with(parameters, {"Road/Contact zone=3.82477796076938, 5.32477796076938",
                              "Cylinder/Radial force=r + sin(3*pi - z + 1)"}));
  EXPECT_GT(original.contact.active_nodes, 0u);
  EXPECT_EQ(mirror.contact.active_nodes, original.contact.active_nodes);
  EXPECT_NEAR(mirror.contact.loads.total, original.contact.loads.total, 1e-12);
  EXPECT_NEAR(mirror.contact.ends->first, 3 * PI - original.contact.ends->second, 1e-10);
  const unsigned int n = original.contact_rows.size();
  ASSERT_EQ(mirror.contact_rows.size(), n);
  for (unsigned int i = 0; i < n; ++i)
    EXPECT_NEAR(mirror.contact_rows[i].pressure, original.contact_rows[n - 1 - i].pressure, 1e-11);
}

TEST_P(Symmetry, MirroredZonesHaveMirroredMeshes) {
  const double begin = 4.21238898038469, end = 5.91238898038469, axis = 3 * dealii::numbers::PI;
  double force[2];
  for (const int is_mirrored : {0, 1})
    force[is_mirrored] =
        solve(parameters_of({"Mesh/Degree=" + std::to_string(GetParam()), "Mesh/Radial cells=4",
                             "Mesh/Angular cells=24",
                             assignment("Road/Contact zone", is_mirrored ? axis - end : begin) +
                                 ", " + shortest_text(is_mirrored ? axis - begin : end)}))
            .contact.loads.total;
  EXPECT_NEAR(force[1] / force[0], 1, 1e-12);
}

TEST_P(Symmetry, PowersOfTwoScaleTheSolutionToTheLastBit) {
  for (const ContactMethod method : {ContactMethod::active_set, ContactMethod::uzawa})
    for (const int power : {-40, 1, 20}) {
      Parameters own = parameters;
      own.contact.method = method;
      Scene scene = make_scene(own);
      scene.force.density = [](double r, double z) { return r * std::cos(z); };
      const Result original = simulate(scene, own).result;
      scene.phi = {[phi = scene.phi, power](double z) { return std::ldexp(phi(z), power); },
                   [phi = scene.phi, power](double z) { return std::ldexp(phi.slope(z), power); }};
      scene.force.density = [power](double r, double z) {
        return std::ldexp(r * std::cos(z), power);
      };
      const Result scaled = simulate(scene, own).result;
      EXPECT_EQ(scaled.history.size(), original.history.size());
      EXPECT_EQ(scaled.contact.loads.total, std::ldexp(original.contact.loads.total, power));
      EXPECT_EQ(scaled.energy.value, std::ldexp(original.energy.value, 2 * power));
      EXPECT_EQ(scaled.certified->lower_bound,
                std::ldexp(original.certified->lower_bound, 2 * power));
      EXPECT_EQ(scaled.certified->relative, original.certified->relative);
      for (unsigned int i = 0; i < scaled.contact_rows.size(); ++i) {
        EXPECT_EQ(scaled.contact_rows[i].pressure,
                  std::ldexp(original.contact_rows[i].pressure, power));
        EXPECT_EQ(scaled.contact_rows[i].displacement,
                  std::ldexp(original.contact_rows[i].displacement, power));
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Degree, Symmetry, testing::Values(1, 2));

} // namespace
