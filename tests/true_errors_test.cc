// True errors and their orders: 1 for Q1 and 3/2 for Q2 where contact ends freely, 1/2 where the
// zone cuts it short, at and below the critical speed.
#include "rollwave/verify/true_errors.h"

#include "rollwave/exact/exact_field.h"

#include "rollwave/verify/reference_solution.h"
#include "test_scenes.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

using namespace rollwave;

namespace {

TrueErrors errors_of(const Parameters& parameters, const ExactSolution& exact) {
  const Solution solution = simulate(make_scene(parameters), parameters);
  return measure_true_errors(solution, exact);
}

struct OrderCase {
  const char* name;
  std::vector<std::string> scene;
  int radial_cells;
  int angular_cells;
  double expected[2]; ///< for Q1 and Q2
  double tolerance[2];
};

class Order : public testing::TestWithParam<OrderCase> {};

TEST_P(Order, IsTheExpectedOne) {
  const OrderCase& scene = GetParam();
  const Parameters parameters = with(parameters_of(scene.scene),
                                     {"Mesh/Radial cells=" + std::to_string(scene.radial_cells),
                                      "Mesh/Angular cells=" + std::to_string(scene.angular_cells)});
  const auto exact = find_exact_solution(make_scene(parameters));
  ASSERT_TRUE(exact);
  for (const int degree : {1, 2}) {
    const auto error = [&](int refinements) {
      return errors_of(with(parameters, {"Mesh/Degree=" + std::to_string(degree),
                                         "Mesh/Global refinements=" + std::to_string(refinements)}),
                       *exact);
    };
    const TrueErrors coarse = error(1), fine = error(4);
    EXPECT_NEAR(std::log2(coarse.energy_norm / fine.energy_norm) / 3, scene.expected[degree - 1],
                scene.tolerance[degree - 1])
        << "degree " << degree;
    EXPECT_EQ(fine.expected_order, scene.expected[degree - 1]);
    // In L2 free ends allow a higher order than in the energy norm.
    if (scene.expected[degree - 1] >= 1) {
      EXPECT_GT(std::log2(coarse.l2_norm / fine.l2_norm) / 3, scene.expected[degree - 1] + 0.5);
    }
    const bool is_critical = make_scene(parameters).angular_velocity == 1;
    EXPECT_NE(fine.h1_norm.has_value(), is_critical);
    if (!is_critical) {
      EXPECT_NEAR(std::log2(*coarse.h1_norm / *fine.h1_norm) / 3, scene.expected[degree - 1],
                  scene.tolerance[degree - 1]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    , Order,
    testing::Values(OrderCase{"regular", {}, 4, 48, {1, 1.5}, {0.05, 0.1}},
                    OrderCase{
                        "critical", {"Cylinder/Angular velocity=1"}, 6, 76, {1, 1.5}, {0.05, 0.1}},
                    OrderCase{"cut",
                              {"Road/Contact zone=4.450589592585541, 4.974188368183839"},
                              4,
                              48,
                              {0.5, 0.5},
                              {0.1, 0.1}},
                    OrderCase{"cut_critical",
                              {"Road/Contact zone=4.450589592585541, 4.974188368183839",
                               "Cylinder/Angular velocity=1"},
                              4,
                              48,
                              {0.5, 0.5},
                              {0.1, 0.1}}),
    [](const auto& info) { return info.param.name; });

TEST(AdaptiveOrder, IsTheDegreeWhateverTheEnds) {
  for (const char* scene_key : {"Cylinder/Angular velocity=0", "Cylinder/Angular velocity=1",
                                "Road/Contact zone=4.450589592585541, 4.974188368183839"}) {
    const auto exact = find_exact_solution(make_scene(parameters_of({scene_key})));
    ASSERT_TRUE(exact);
    for (const int degree : {1, 2}) {
      const Parameters parameters =
          parameters_of({scene_key, "Mesh/Degree=" + std::to_string(degree), "Mesh/Radial cells=2",
                         "Mesh/Angular cells=24", "Mesh/Adaptive cycles=1000"});
      double errors[2], unknowns[2];
      for (const int i : {0, 1}) {
        const Parameters own =
            with(parameters, {i == 0 ? "Mesh/Most unknowns=3000" : "Mesh/Most unknowns=40000"});
        const Solution solution = simulate(make_scene(own), own);
        errors[i] = measure_true_errors(solution, *exact).energy_norm;
        unknowns[i] = solution.result.mesh.n_unknowns;
      }
      const double order =
          2 * std::log(errors[0] / errors[1]) / std::log(unknowns[1] / unknowns[0]);
      // Above the degree where the ends still hold most of the error of the coarser mesh.
      EXPECT_GT(order, 0.93 * degree) << scene_key;
      EXPECT_LT(order, 1.35 * degree) << scene_key;
    }
  }
}

// Cells that are cut in four are too short along z near the surface: l^(-1/3) of them next to an
// end of cells of the size l, which leaves the error l^(1/2).
TEST(AdaptiveOrder, IsThreeAtMostAtCutEndsAtTheCriticalSpeed) {
  const Parameters parameters =
      parameters_of({"Cylinder/Angular velocity=1",
                     "Road/Contact zone=4.450589592585541, 4.974188368183839", "Mesh/Degree=4",
                     "Mesh/Radial cells=2", "Mesh/Angular cells=24", "Mesh/Adaptive cycles=1000"});
  const auto exact = find_exact_solution(make_scene(parameters));
  ASSERT_TRUE(exact);
  double errors[2], unknowns[2];
  for (const int i : {0, 1}) {
    const Parameters own =
        with(parameters, {i == 0 ? "Mesh/Most unknowns=6000" : "Mesh/Most unknowns=50000"});
    const Solution solution = simulate(make_scene(own), own);
    const TrueErrors found = measure_true_errors(solution, *exact);
    EXPECT_EQ(found.expected_order, 3);
    errors[i] = found.energy_norm;
    unknowns[i] = solution.result.mesh.n_unknowns;
  }
  EXPECT_NEAR(2 * std::log(errors[0] / errors[1]) / std::log(unknowns[1] / unknowns[0]), 3, 0.4);
}

TEST(TrueErrors, OfTheEnergyNormAreThoseOfTheGradient) {
  // The identity against quadrature of the gradient of u - u_h, u from its modes, on a mesh so
  // coarse that the modes left out do not matter.
  const Parameters parameters =
      parameters_of({"Mesh/Degree=1", "Mesh/Radial cells=4", "Mesh/Angular cells=24"});
  const Scene scene = make_scene(parameters);
  const auto exact = find_exact_solution(scene);
  ASSERT_TRUE(exact);
  const Solution solution = simulate(scene, parameters);
  const TrueErrors errors = measure_true_errors(solution, *exact);

  // u by coefficients for the radii r - h, r and r + h of each r
  constexpr double h = 1e-5;
  std::map<double, std::vector<std::vector<double>>> series;
  const auto u_at = [&](double r, unsigned int side, double z) {
    auto& of_radius = series[r];
    if (of_radius.empty())
      of_radius = cosine_coefficients(*exact, 400, {r - h, r, r + h});
    return cosine_sum(of_radius[side], z).value;
  };
  const auto& space = solution.space();
  const dealii::QGauss<2> gauss(6);
  dealii::FEValues<2> values(space.mapping(), space.dof_handler().get_fe(), gauss,
                             dealii::update_values | dealii::update_gradients |
                                 dealii::update_quadrature_points | dealii::update_JxW_values);
  std::vector<dealii::Tensor<1, 2>> gradients(gauss.size());
  double squared = 0, l2_squared = 0, h1_squared = 0;
  std::vector<double> displacement(gauss.size());
  for (const auto& cell : space.dof_handler().active_cell_iterators()) {
    values.reinit(cell);
    values.get_function_gradients(solution.displacement, gradients);
    values.get_function_values(solution.displacement, displacement);
    for (const unsigned int q : values.quadrature_point_indices()) {
      const auto point = values.quadrature_point(q);
      const double r = point[0], z = point[1];
      const double u_r = (u_at(r, 2, z) - u_at(r, 0, z)) / (2 * h),
                   u_z = (u_at(r, 1, z + h) - u_at(r, 1, z - h)) / (2 * h);
      squared += r * values.JxW(q) *
                 (scene.alpha(r) * std::pow(u_z - gradients[q][1], 2) +
                  std::pow(u_r - gradients[q][0], 2));
      l2_squared += r * values.JxW(q) * std::pow(u_at(r, 1, z) - displacement[q], 2);
      h1_squared += r * values.JxW(q) *
                    (std::pow((u_z - gradients[q][1]) / r, 2) + std::pow(u_r - gradients[q][0], 2));
    }
  }
  EXPECT_NEAR(errors.energy_norm / std::sqrt(squared), 1, 2e-3);
  // The errors' own rule has fewer points.
  EXPECT_NEAR(errors.l2_norm / std::sqrt(l2_squared), 1, 5e-2);
  const double b = scene.outer_radius;
  ASSERT_TRUE(errors.h1_norm);
  EXPECT_NEAR(*errors.h1_norm / std::sqrt(h1_squared + l2_squared / (b * b)), 1, 5e-3);
}

// Where cancellation, or an exact pressure that is not resolved, is more than the error.
TEST(TrueErrors, AreOmittedBelowTheAccuracyOfTheReference) {
  const auto resolves = [](const std::vector<std::string>& settings) {
    const Parameters parameters = parameters_of(settings);
    const auto exact = find_exact_solution(make_scene(parameters));
    return exact && errors_of(parameters, *exact).is_resolved;
  };
  EXPECT_TRUE(resolves({"Mesh/Degree=2", "Mesh/Radial cells=4", "Mesh/Angular cells=60"}));
  EXPECT_FALSE(resolves({"Road/Distance=1.2", "Cylinder/Radial force=-1", "Mesh/Degree=6",
                         "Mesh/Radial cells=8", "Mesh/Angular cells=20"}));
  EXPECT_FALSE(resolves({"Cylinder/Inner radius=0.001", "Cylinder/Angular velocity=0.95",
                         "Cylinder/Radial force=1", "Road/Distance=0.0010999", "Mesh/Degree=2",
                         "Mesh/Radial cells=4", "Mesh/Angular cells=120",
                         "Mesh/Wanted relative error=0.005"}));
}

TEST(FindExactSolution, KnowsItsLimits) {
  const auto find = [](const std::vector<std::string>& assignments) {
    const Parameters parameters = parameters_of(assignments);
    return find_exact_solution(make_scene(parameters));
  };
  EXPECT_TRUE(find({"Cylinder/Radial force=0.5"}));
  EXPECT_FALSE(find({"Cylinder/Radial force=0.5*r"}));
  EXPECT_FALSE(find({"Road/Contact zone=4.6, 5.5"}));
  // A zone wider than the contact makes no difference, even an uneven one.
  const auto wide = find({}), uneven = find({"Road/Contact zone=4.1, 5.5"});
  ASSERT_TRUE(wide && uneven);
  EXPECT_EQ(wide->loads.total, uneven->loads.total);
  // Less contact, less force.
  const auto cut = find({"Road/Contact zone=4.3, 5.1247779607693793"});
  ASSERT_TRUE(cut);
  EXPECT_LT(cut->loads.total, wide->loads.total);
  EXPECT_LT(cut->energy, wide->energy);
}

// The guarantees hold; each of them that is shifted away is found out.
TEST(TrueErrors, FindOutAWrongGuarantee) {
  const Parameters parameters = parameters_of({"Mesh/Radial cells=3", "Mesh/Angular cells=60"});
  const Scene scene = make_scene(parameters);
  Result result = simulate(scene, parameters).result;
  const auto exact = find_exact_solution(scene);
  ASSERT_TRUE(exact);
  result.errors = errors_of(parameters, *exact);
  EXPECT_TRUE(contradicted_guarantees(result, *exact, scene.units).empty());
  CertifiedError& certified = result.certified.value();
  certified.energy_norm = 0.9 * result.errors->energy_norm;
  certified.upper_bound = exact->energy - 1e-6;
  certified.loads.total.lower = exact->loads.total + 1e-6;
  certified.loads.vertical.upper = exact->loads.vertical - 1e-6;
  const auto notes = contradicted_guarantees(result, *exact, scene.units);
  EXPECT_EQ(notes.size(), 4u);
  for (const Note& note : notes)
    EXPECT_EQ(note.kind, Note::Kind::shortfall);
}

} // namespace
