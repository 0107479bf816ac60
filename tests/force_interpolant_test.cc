// f_0 in place of the force, and its integral G(r, z) = int_r^b rho f_0 drho.
#include "errors.h"
#include "floating_point.h"
#include "force_columns.h"
#include "force_on_mesh.h"
#include "interpolation.h"

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

using namespace rollwave;

namespace {

constexpr double a = 0.5, b = 1;

using Integrand = std::function<double(double missed, double r, double z)>;

/// The integral of a function of G - G_0, the radius and the angle, by midpoints.
double integrate(const Force& force, const std::function<double(double, double)>& exact,
                 const Integrand& integrand) {
  const unsigned int n = 400;
  const double height = (b - a) / n, length = 2 * dealii::numbers::PI / n;
  std::vector<double> radii, values;
  for (unsigned int q = 0; q < n; ++q)
    radii.push_back(a + (q + 0.5) * height);
  ForceAtRadii at_radii(radii);
  double sum = 0;
  for (unsigned int p = 0; p < n; ++p) {
    const double z = (p + 0.5) * length;
    at_radii.integrals(force.interpolant.column(z), values);
    for (unsigned int q = 0; q < n; ++q)
      sum += height * length * integrand(exact(radii[q], z) - values[q], radii[q], z);
  }
  return sum;
}

/// ||G - G_0|| in the norm of int w^2 / r dr dz.
double distance(const Force& force, const std::function<double(double, double)>& exact) {
  return std::sqrt(
      integrate(force, exact, [](double missed, double r, double) { return missed * missed / r; }));
}

/// The largest |int (G - G_0) w_r dr dz| / |w| for some w = sin(k (r - a)) cos(m z + t).
double largest_work(const Force& force, const std::function<double(double, double)>& exact) {
  double largest = 0;
  for (const int i : {0, 1, 4, 16})
    for (const int m : {0, 1, 5, 30})
      for (const double t : {0., dealii::numbers::PI / 2}) {
        if (m == 0 && t > 0)
          continue;
        const double k = (i + 0.5) * dealii::numbers::PI / (b - a);
        const auto slope = [&](double r, double z) {
          return k * std::cos(k * (r - a)) * std::cos(m * z + t);
        };
        const double work = integrate(
            force, exact, [&](double missed, double r, double z) { return missed * slope(r, z); });
        const double square = integrate(force, exact, [&](double, double r, double z) {
          const double w_z = m * std::sin(k * (r - a)) * std::sin(m * z + t);
          return r * (force.scene.alpha(r) * w_z * w_z + std::pow(slope(r, z), 2));
        });
        largest = std::max(largest, std::abs(work) / std::sqrt(square));
      }
  return largest;
}

/// The root mean square over z in [begin, begin + length] of G at a radius less the polynomial that
/// equals it at Gauss' points, by midpoints.
double missed_along_z(const ForceInterpolant& force, const dealii::QGauss<1>& gauss, double begin,
                      double length, double r) {
  const dealii::QIterated<1> fine(gauss, 16);
  const auto from_gauss = interpolation(gauss, fine);
  const auto integrals = [&](const dealii::Quadrature<1>& rule) {
    std::vector<double> values;
    for (const auto& point : rule.get_points())
      values.push_back(integral(force.column(begin + length * point[0]), r));
    return values;
  };
  const std::vector<double> on_rule = integrals(gauss), on_fine = integrals(fine);
  double square = 0;
  for (unsigned int p = 0; p < on_fine.size(); ++p) {
    double missed = on_fine[p];
    for (unsigned int i = 0; i < on_rule.size(); ++i)
      missed -= from_gauss(p, i) * on_rule[i];
    square += fine.weight(p) * missed * missed;
  }
  return std::sqrt(square);
}

} // namespace

TEST(ForceInterpolant, IsExactForPolynomials) {
  const Force force("r^2*(z-3)^3-r+2", 3, 36);
  EXPECT_LT(force.interpolant.error(), 1e-13);
  for (const double z : {0.01, 1., 2.9, 4.4, 6.28})
    for (const double r : {a, 0.51, 0.77, 0.999, b}) {
      const double exact =
          std::pow(z - 3, 3) * (1 - std::pow(r, 4)) / 4 - (1 - std::pow(r, 3)) / 3 + (1 - r * r);
      EXPECT_NEAR(force.integral(r, z), exact, 1e-13) << r << " " << z;
      EXPECT_NEAR(force.integral(r, z + 2 * dealii::numbers::PI), exact, 1e-12);
    }
}

TEST(ForceInterpolant, IsTheForceWhenThatIsANumber) {
  const Force force("3", 3, 36);
  EXPECT_TRUE(force.interpolant.is_exact());
  EXPECT_EQ(force.interpolant.error(), 0);
  for (const double r : {a, 0.77, b})
    EXPECT_NEAR(force.integral(r, 5), 3 * (b - r) * (b + r) / 2, 1e-14);
}

TEST(ForceInterpolant, ResolvesSmoothForces) {
  EXPECT_LT(Force("1+0.5*r*cos(z)", 3, 36).interpolant.error(), 1e-9);
  // Faster than any energy converges, h^4 for degree 2.
  double last = 0.05;
  for (const unsigned int n : {6, 12, 24, 48}) {
    const double error = Force("sin(9*z)*exp(40*(r-1))", n, 12 * n).interpolant.error();
    EXPECT_LT(error, last / 20) << n;
    last = error;
  }
}

// int (G - G_0) w_r dr dz = int r (f - f_0) w dr dz. Where f is a function of r alone, w_r = (G -
// G_0) / r shows that the least bound is the distance of G_0 from G; else some w are tried.
TEST(ForceInterpolant, TellsItsErrorAtKinksAndJumps) {
  const struct {
    const char* expression;
    bool is_function_of_r;
    std::function<double(double, double)> integral;
  } forces[] = {
      {"abs(r-0.7123)", true,
       [](double r, double) {
         const auto primitive = [](double s) { return s * s * (s / 3 - 0.7123 / 2); };
         return r < 0.7123 ? primitive(1) - 2 * primitive(0.7123) + primitive(r)
                           : primitive(1) - primitive(r);
       }},
      {"if(r<0.7123,1,0)", true,
       [](double r, double) { return std::max(0., 0.7123 * 0.7123 - r * r) / 2; }},
      {"abs(z-3)", false, [](double r, double z) { return std::abs(z - 3) * (b * b - r * r) / 2; }},
      {"if(z<2,1,-1)", false,
       [](double r, double z) { return (z < 2 ? 1 : -1) * (b * b - r * r) / 2; }},
      {"if(r<0.8+0.1*sin(z),1,0)", false, [](double r, double z) {
         const double end = 0.8 + 0.1 * std::sin(z);
         return std::max(0., end * end - r * r) / 2;
       }}};
  for (const auto& [expression, is_function_of_r, integral] : forces) {
    double last = 0.1;
    for (const unsigned int refinement : {1, 8, 32}) {
      const Force force(expression, 3 * refinement, 36 * refinement);
      const double error = force.interpolant.error();
      EXPECT_LT(error, std::max(last / 1.5, 1e-7)) << expression;
      if (is_function_of_r) {
        EXPECT_LE(distance(force, integral), 1.02 * error + 1e-9) << expression;
      }
      EXPECT_LE(largest_work(force, integral), 1.02 * error + 1e-9) << expression;
      last = error;
    }
  }
}

TEST(ForceLines, BoundWhatARuleMissesAlongZ) {
  const dealii::QGauss<1> gauss(3);
  const std::vector<FinerRule> rules = {FinerRule(gauss, dealii::QGauss<1>(8))};
  unsigned int n_bounded = 0;
  for (const char* expression : {"r^2*z^2", "sin(9*z)*exp(r)", "r^3*z^7-z^5", "if(z<3.12,1,-1)",
                                 "if(r<0.8+0.1*sin(z),1,0)"}) {
    const Force force(expression, 6, 72);
    for (const double begin : {0., 0.4, 3.1, 5.7})
      for (const double length : {0.01, 0.08, 0.5}) {
        const ForceLines lines(force.interpolant, begin, begin + length, rules, 1e100, {});
        const double bound = std::sqrt(lines.missed_mean_square);
        EXPECT_EQ(lines.rule.size(), gauss.size());
        for (const double r : {a, 0.6, 0.79, 0.95}) {
          const double missed = missed_along_z(force.interpolant, gauss, begin, length, r);
          // Midpoints of 48 do not find a jump better than that.
          EXPECT_LE(missed, 1.1 * bound + 1e-12)
              << expression << " " << begin << " " << length << " " << r;
          n_bounded += missed > 1e-10;
        }
        if (std::string(expression) == "r^2*z^2") {
          EXPECT_LT(bound, 1e-12); // of a degree that the rule sees
        }
      }
  }
  EXPECT_GT(n_bounded, 50u);
}

TEST(ForceLines, TakeNoMorePointsThanAreNeeded) {
  std::vector<FinerRule> rules;
  for (unsigned int n = 3; n < 8; ++n)
    rules.emplace_back(dealii::QGauss<1>(n), dealii::QGauss<1>(8));
  const Force force("sin(9*z)*exp(r)", 6, 72);
  std::set<unsigned int> sizes;
  for (const double begin : {0.4, 3.1, 5.7})
    for (const double length : {0.01, 0.08}) {
      unsigned int before = 3;
      for (double negligible = 1e-2; negligible > 1e-12; negligible /= 10) {
        const ForceLines lines(force.interpolant, begin, begin + length, rules, negligible, {});
        const unsigned int n = lines.rule.size();
        EXPECT_GE(n, before);
        EXPECT_EQ(lines.has_rule_of_cell(), n == 3);
        EXPECT_LE(std::sqrt(lines.missed_mean_square), negligible);
        if (n < 8)
          for (const double r : {a, 0.79}) {
            EXPECT_LE(missed_along_z(force.interpolant, dealii::QGauss<1>(n), begin, length, r),
                      1.1 * negligible + 1e-12);
          }
        if (n > 3 && n < 8) {
          // With a point less the bound would not do.
          const std::vector<FinerRule> less = {rules[n - 4]};
          EXPECT_GT(ForceLines(force.interpolant, begin, begin + length, less, 1e100, {})
                        .missed_mean_square,
                    negligible * negligible);
        }
        sizes.insert(before = n);
      }
    }
  EXPECT_GE(sizes.size(), 4u);
}

// Where cells with an angular interval are few, the lines there are known at their radii only.
TEST(ForceLines, ServeTheRadiiOfTheirCells) {
  const dealii::QGauss<1> gauss(3);
  const std::vector<FinerRule> rules = {FinerRule(gauss, dealii::QGauss<1>(8))};
  for (const char* expression : {"abs(r-0.7123)", "if(r<0.8+0.1*sin(z),1,0)"}) {
    const Parameters parameters =
        with(paper_scenes()[0].parameters(),
             {std::string("Cylinder/Radial force=") + expression, "Mesh/Radial cells=4",
              "Mesh/Angular cells=48", "Mesh/Adaptive cycles=4"});
    const Scene scene = make_scene(parameters);
    const Solution solution = simulate(scene, parameters);
    const RingSpace space(*solution.triangulation, scene, 1);
    const RadialExtents extents(space);
    const ForceInterpolant force(space, scene, assemble_load(space, scene).moments, extents);
    unsigned int n_short = 0;
    for (const auto& cell : space.dof_handler().active_cell_iterators()) {
      const dealii::Point<2> low = cell->vertex(0), high = cell->vertex(3);
      const double length = high[1] - low[1];
      const RadialExtent radii = extents.of(low[1], high[1]);
      ASSERT_TRUE(radii.begin <= low[0] && high[0] <= radii.end);
      const ForceLines any(force, low[1], high[1], rules, 1e100, radii),
          exact(force, low[1], high[1], rules, 0, radii);
      for (const double r : {low[0], (low[0] + high[0]) / 2, high[0]}) {
        for (const ForceLines* lines : {&any, &exact})
          for (unsigned int p = 0; p < lines->columns.size(); p += 3) {
            const ForceColumn all = force.column(low[1] + length * lines->rule.point(p)[0]);
            ASSERT_NEAR(integral(lines->columns[p], r), integral(all, r), 1e-14);
            n_short += lines->columns[p].size() < all.size();
          }
        ASSERT_LE(missed_along_z(force, gauss, low[1], length, r),
                  1.1 * std::sqrt(any.missed_mean_square) + 1e-12)
            << expression << ' ' << r << ' ' << low[1];
      }
    }
    EXPECT_GT(n_short, 1000u);
  }
}

TEST(ForceLines, IntegrateWhatJumpsAlongZ) {
  const std::vector<FinerRule> rules = {FinerRule(dealii::QGauss<1>(3), dealii::QGauss<1>(8))};
  const Force force("if(z<3.12,1,-1)+r*z", 8, 720);
  const ForceLines lines(force.interpolant, 3.1, 3.2, rules, 1e-9, {});
  ASSERT_FALSE(lines.has_rule_of_cell());
  EXPECT_EQ(lines.missed_mean_square, 0);
  // int G dz and int G^2 dz at the hub, G = c + d z beside the jump
  double integral = 0, square = 0;
  ForceAtRadii at_hub({a});
  std::vector<double> moment;
  for (unsigned int p = 0; p < lines.columns.size(); ++p) {
    at_hub.integrals(lines.columns[p], moment);
    integral += 0.1 * lines.rule.weight(p) * moment[0];
    square += 0.1 * lines.rule.weight(p) * moment[0] * moment[0];
  }
  const double c = (b * b - a * a) / 2, d = (b * b * b - a * a * a) / 3;
  const auto primitive = [&](double sign, double z) { return sign * c * z + d * z * z / 2; };
  const auto primitive_of_square = [&](double sign, double z) {
    return std::pow(sign * c + d * z, 3) / (3 * d);
  };
  const auto exact = [](const auto& of) {
    return of(1, 3.12) - of(1, 3.1) + of(-1, 3.2) - of(-1, 3.12);
  };
  EXPECT_NEAR(integral, exact(primitive), 1e-7);
  EXPECT_NEAR(square, exact(primitive_of_square), 1e-7);
}

TEST(ForceInterpolant, TellsWherePanelsEnd) {
  const Force force("if(z<2,1,if(z<2.05,0,-1))", 8, 4000);
  const std::vector<double> ends = force.interpolant.panel_ends(1.9, 2.1, a);
  EXPECT_EQ(ends, std::vector<double>({2, 2.05}));
  // A turn further on they are the same; the period ends a panel.
  const std::vector<double> turned =
      force.interpolant.panel_ends(1.9 + 2 * dealii::numbers::PI, 2.1 + 2 * dealii::numbers::PI, a);
  ASSERT_EQ(turned.size(), ends.size());
  for (unsigned int i = 0; i < ends.size(); ++i)
    EXPECT_NEAR(turned[i], ends[i] + 2 * dealii::numbers::PI, 1e-14);
  const std::vector<double> at_period = force.interpolant.panel_ends(
      2 * dealii::numbers::PI - 1e-9, 2 * dealii::numbers::PI + 1e-9, a);
  ASSERT_FALSE(at_period.empty());
  EXPECT_EQ(std::count(at_period.begin(), at_period.end(), 2 * dealii::numbers::PI), 1);
}

TEST(ForceInterpolant, StopsAtANegligibleJumpOrBetweenNeighbouringNumbers) {
  // Room for more panels than a jump on a straight line can use; with degree 8 nothing is
  // negligible.
  for (const unsigned int degree : {1, 8}) {
    const Force force("if(z<2,1,-1)", 8 / degree, 4000 / degree, degree);
    EXPECT_LT(force.interpolant.error(), degree == 1 ? 1e-5 : 1e-8);
    for (const double z : {1.5, std::nextafter(2., 1.), 2., std::nextafter(2., 3.), 2.5})
      for (const double r : {a, 0.6, 0.9999})
        EXPECT_LE(std::abs(force.integral(r, z)), 3 * (b * b - r * r) / 2) << z;
    EXPECT_NEAR(force.integral(0.6, 1.999999), 0.32, 1e-12);
    EXPECT_NEAR(force.integral(0.6, 2.000001), -0.32, 1e-12);
  }
}

TEST(ForceInterpolant, SeesWhatTheMeshSees) {
  // A load on a few cells, where larger panels have no point.
  const Force force("exp(-((z-4.7)/0.003)^2)", 2, 5000);
  for (const double z : {4.69, 4.697, 4.7, 4.702})
    EXPECT_NEAR(force.integral(a, z),
                std::exp(-std::pow((z - 4.7) / 0.003, 2)) * (b * b - a * a) / 2, 1e-6);
}

TEST(ForceInterpolant, SeesWhatTheLoadSeesBetweenThePointsOfAPanel) {
  // Half a dozen cells along z, or a spot on some, in forces that panels resolve otherwise.
  for (const double middle : {4.31, 4.43, 4.52, 4.6}) {
    const std::string at = std::to_string(middle);
    const Force strip("1+if(abs(z-" + at + ")<0.04,5,0)", 20, 480, 2);
    for (const double z : {middle - 0.03, middle, middle + 0.03})
      EXPECT_NEAR(strip.integral(a, z), 3 * (b * b - a * a), 1e-6) << z;
    EXPECT_NEAR(strip.integral(a, middle + 0.05), (b * b - a * a) / 2, 1e-6);
    const Force spot("if((r-0.9)^2+(z-" + at + ")^2<0.0016,1,0)+floor(8*r)", 20, 480, 2);
    const auto steps = [](double r) {
      double sum = 0;
      for (const double step : {0.625, 0.75, 0.875, 1.})
        sum += std::floor(8 * (step - 0.01)) *
               std::max(0., std::pow(step, 2) - std::pow(std::max(r, step - 0.125), 2)) / 2;
      return sum;
    };
    EXPECT_NEAR(spot.integral(a, middle + 0.05), steps(a), 1e-6);
    EXPECT_NEAR(spot.integral(a, middle), steps(a) + 0.9 * 0.08, 4e-3);
  }
}

TEST(ForceInterpolant, SeesWhatBeginsBesideAnEndOfAPanel) {
  // Where panels end: at half a turn, at half the ring's height. With degree 8 nothing is
  // negligible.
  const Force in_z("if(z<3.1416,1,0)", 8, 96, 8);
  EXPECT_NEAR(in_z.integral(a, 3.141593), (b * b - a * a) / 2, 1e-12);
  EXPECT_NEAR(in_z.integral(a, 3.141607), 0, 1e-12);
  const Force in_r("if(r<0.75001,1,0)", 8, 96, 8);
  EXPECT_NEAR(in_r.integral(0.75, 2), (0.75001 * 0.75001 - 0.75 * 0.75) / 2, 5e-7);
  // Exactly there nothing has to be halved.
  EXPECT_LT(Force("if(z<pi,1,0)", 8, 96, 8).interpolant.error(), 1e-13);
  EXPECT_LT(Force("if(r<0.75,1,0)", 8, 96, 8).interpolant.error(), 1e-13);
  EXPECT_EQ(Force("if(z<pi,1,0)", 8, 96, 8).interpolant.panel_ends(3.1, 3.2, a).size(), 1u);
}

TEST(ForceInterpolant, RefusesForcesThatAreNotFinite) {
  const UntrappedFloatingPoint root_of_a_negative_number;
  // Not on the ring's middle circle, where the expression is tried when it is read.
  EXPECT_THROW(Force("sqrt(r-0.6)", 3, 36), BadInput);
}
