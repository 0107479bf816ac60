// Q_h is Q if a force is a polynomial, and delta is an upper estimate of their difference.
#include "rollwave/error_bound/force_integral.h"

#include "rollwave/base/errors.h"
#include "rollwave/scene/scene.h"
#include "test_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace rollwave;

namespace {

/// Q_h of a force on a uniform mesh of the ring from 0.5 to 1.
struct OnMesh {
  explicit OnMesh(const std::string& force, unsigned int degree = 2,
                  const std::string& radial_cells = "4", const std::string& angular_cells = "30")
      : parameters(parameters_of(
            {"Cylinder/Radial force=" + force, "Mesh/Degree=" + std::to_string(degree),
             "Mesh/Radial cells=" + radial_cells, "Mesh/Angular cells=" + angular_cells})),
        scene(make_scene(parameters)), mesh(scene, parameters), shapes(mesh.space, scene),
        integral(mesh.space, scene, shapes) {}

  /// (int (Q - Q_h)^2 / r dr dz)^(1/2) by rules with more points.
  template <typename Function>
  double distance_to(const Function& exact) {
    double squared = 0;
    const dealii::QGauss<1> fine(40);
    std::vector<double> line;
    for (const auto& cell : mesh.space.dof_handler().active_cell_iterators()) {
      const dealii::Point<2> low = cell->vertex(0), high = cell->vertex(3);
      const RadialShapes& radial = shapes.on(low[0], high[0]);
      for (unsigned int p = 0; p < fine.size(); ++p) {
        const double t = fine.point(p)[0], length = high[1] - low[1],
                     z = std::fmod(low[1] + t * length, 2 * M_PI);
        integral.values_on_line_at(cell->active_cell_index(), t, line);
        for (unsigned int q = 0; q < radial.r.size(); ++q)
          squared += fine.weight(p) * length * radial.weight_over_r[q] *
                     std::pow(line[q] - exact(radial.r[q], z), 2);
      }
    }
    return std::sqrt(squared);
  }

  const Parameters parameters;
  const Scene scene;
  const MeshAndSpace mesh;
  const RadialShapesOfMesh shapes;
  const ForceIntegral integral;
};

TEST(ForceIntegral, IsExactForNumbers) {
  OnMesh force("-3");
  EXPECT_LT(force.distance_to([](double r, double) { return -1.5 * (1 - r * r); }), 1e-14);
  EXPECT_EQ(force.integral.error(), 0);
}

TEST(ForceIntegral, IsExactForPolynomials) {
  OnMesh force("r*(z-3)", 3, "4", "30");
  const auto exact = [](double r, double z) { return (1 - r * r * r) / 3 * (z - 3); };
  // z jumps by 2 pi at three quarters of the mesh: inside a cell of 30, on an edge of 32.
  OnMesh aligned("r*(z-3)", 3, "4", "32");
  EXPECT_LT(aligned.distance_to(exact), 1e-13);
  EXPECT_LT(aligned.integral.error(), 1e-6);
  EXPECT_GT(force.integral.error(), 1e-2);
}

// Smooth, singular, and with jumps along z, along r, and across both.
TEST(ForceIntegral, ErrorIsWithinItsEstimate) {
  const auto along_z = [](double r, double z) { return (z < 2.03 ? 1 : -1) * (1 - r * r) / 2; };
  const auto along_r = [](double r, double) { return r < 0.713 ? (0.713 * 0.713 - r * r) / 2 : 0; };
  const auto curve = [](double r, double z) {
    const double s = 0.7 + 0.1 * std::sin(3 * z);
    return r < s ? (s * s - r * r) / 2 : 0;
  };
  const auto smooth = [](double r, double z) { return std::sin(9 * z) * (1 - r * r) / 2; };
  // int (x + s) |x|^(-0.4) dx with x = r - s
  const auto singular = [](double r, double) {
    const double s = 0.713;
    const auto primitive = [s](double x) {
      return std::pow(std::abs(x), 1.6) / 1.6 +
             s * std::copysign(std::pow(std::abs(x), 0.6), x) / 0.6;
    };
    return primitive(1 - s) - primitive(r - s);
  };
  for (const unsigned int degree : {1, 2, 4})
    for (const auto& cells : {std::pair("4", "30"), {"7", "71"}, {"16", "200"}}) {
      SCOPED_TRACE(testing::Message()
                   << "degree " << degree << " on " << cells.first << " x " << cells.second);
      const auto expect_charged = [&](const char* f, const auto& exact) {
        OnMesh force(f, degree, cells.first, cells.second);
        const double missed = force.distance_to(exact);
        EXPECT_LE(missed, force.integral.error()) << f;
        EXPECT_GE(missed, force.integral.error() / 1000) << f;
      };
      expect_charged("if(z<2.03,1,-1)", along_z);
      expect_charged("if(r<0.713,1,0)", along_r);
      expect_charged("if(r<0.7+0.1*sin(3*z),1,0)", curve);
      expect_charged("sin(9*z)", smooth);
      expect_charged("abs(r-0.713)^(-0.4)", singular);
    }
}

// Between any two points of the rules, and close to one.
TEST(ForceIntegral, SeesAJumpAlongRWhereverItIs) {
  for (const unsigned int degree : {1, 2, 4})
    for (int k = 1; k <= 50; ++k) {
      const double place = 0.75 + 0.125 * k / 51;
      const auto exact = [place](double r, double) {
        return r < place ? (place * place - r * r) / 2 : 0;
      };
      OnMesh force("if(r<" + shortest_text(place) + ",1,0)", degree, "4", "8");
      EXPECT_LE(force.distance_to(exact), force.integral.error()) << place << ", degree " << degree;
    }
}

TEST(ForceIntegral, IsRefusedWhereTheForceIsNotFinite) {
  const Parameters parameters = parameters_of({"Cylinder/Radial force=if(z<3,1/(r-r),1)"});
  try {
    simulate(make_scene(parameters), parameters);
    ADD_FAILURE() << "accepted";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("it is not finite at r = "), std::string::npos)
        << error.what();
  }
}

} // namespace
