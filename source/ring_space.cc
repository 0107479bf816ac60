#include "ring_space.h"

#include "errors.h"
#include "nested_dissection.h"
#include "ring_mesh.h"
#include "scene.h"

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/numerics/vector_tools_boundary.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace rollwave {

using namespace dealii;

RingSpace::RingSpace(const Triangulation<2>& triangulation, const Scene& scene, unsigned int degree)
    : radius(scene.outer_radius), element(degree), handler(triangulation) {
  handler.distribute_dofs(element);

  // Hanging nodes first, the period after them: the other order would constrain hanging nodes on
  // the seam twice.
  DoFTools::make_hanging_node_constraints(handler, affine_constraints);
  DoFTools::make_periodicity_constraints(handler, seam_begin_id, seam_end_id, /*direction=*/1,
                                         affine_constraints);
  VectorTools::interpolate_boundary_values(cartesian, handler, hub_id, Functions::ZeroFunction<2>(),
                                           affine_constraints);
  affine_constraints.close();
  find_surface_nodes(scene);
  order = dissect(handler);
}

unsigned int RingSpace::n_unknowns() const {
  return handler.n_dofs() - affine_constraints.n_constraints();
}

void RingSpace::find_surface_nodes(const Scene& scene) {
  const QGaussLobatto<1> lobatto(element.degree + 1);
  FEFaceValues<2> face_values(cartesian, element, lobatto,
                              update_values | update_quadrature_points | update_JxW_values);
  std::vector<types::global_dof_index> dofs(element.n_dofs_per_cell());
  const double middle = (scene.zone_begin + scene.zone_end) / 2;

  std::map<types::global_dof_index, SurfaceNode> nodes;
  for (const auto& cell : handler.active_cell_iterators())
    for (const auto& face : cell->face_iterators())
      if (face->at_boundary() && face->boundary_id() == surface_id) {
        face_values.reinit(cell, face);
        cell->get_dof_indices(dofs);
        faces.push_back({cell, 0, 0, {}});
        const double turn =
            2 * numbers::PI * std::floor((face->center()[1] - middle) / (2 * numbers::PI) + 0.5);
        faces.back().begin = face_values.quadrature_point(0)[1] - turn;
        faces.back().end = face_values.quadrature_point(lobatto.size() - 1)[1] - turn;
        for (const unsigned int q : face_values.quadrature_point_indices())
          for (const unsigned int i : face_values.dof_indices())
            // The quadrature points are the nodes, where one shape function is 1, the others 0.
            if (face_values.shape_value(i, q) > 0.5) {
              // A node on the seam counts as the node that its constraint equates it with.
              types::global_dof_index dof = dofs[i];
              if (const auto* entries = affine_constraints.get_constraint_entries(dof))
                dof = entries->front().first;
              faces.back().dofs.push_back(dof);
              const double z = face_values.quadrature_point(q)[1];
              const double angle =
                  z - 2 * numbers::PI * std::floor((z - middle) / (2 * numbers::PI) + 0.5);
              auto& node = nodes.emplace(dof, SurfaceNode{dof, angle, 0.}).first->second;
              node.weight += scene.outer_radius * face_values.JxW(q);
            }
      }

  std::sort(faces.begin(), faces.end(), [](const auto& left, const auto& right) {
    return left.cell->center()[1] < right.cell->center()[1];
  });
  for (const auto& [dof, node] : nodes)
    surface.push_back(node);
  std::sort(surface.begin(), surface.end(),
            [](const auto& left, const auto& right) { return left.angle < right.angle; });

  // Angles carry round-off of a few units in the last place.
  const double tolerance = 1e-13;
  for (const SurfaceNode& node : surface)
    if (node.angle >= scene.zone_begin - tolerance && node.angle <= scene.zone_end + tolerance)
      contact.push_back(node);
  if (contact.empty())
    throw BadInput("no node of the mesh lies in the contact zone from " +
                   std::to_string(scene.zone_begin) + " to " + std::to_string(scene.zone_end) +
                   "; raise Mesh/Angular cells or widen Road/Contact zone");
}

} // namespace rollwave
