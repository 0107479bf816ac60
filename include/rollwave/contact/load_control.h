#pragma once

#include "rollwave/contact/contact_problem.h"

#include <optional>
#include <string>
#include <vector>

namespace rollwave {

/// True if contact on a drum ends next to its tangent, with no free node before it. dphi/dc grows
/// there like d^(-1/2) with the distance d from the tangent, so that the nodes resolve neither the
/// work-conjugate load nor the stiffness.
bool reaches_tangent(const ContactBoundary& boundary, const Road& road,
                     const std::vector<bool>& active);

/**
 * The stiffness -d/dc of the three loads, forces over lengths; 0 without contact, nullopt where
 * contact reaches_tangent(). At a fixed set of nodes in contact it would jump from node to node, by
 * several per cent on meshes that are not fine. It is the difference quotient over the distances
 * between which contact grows by about two cells at each end, which averages over the nodes of the
 * cells:
 *
 *     (load(c - d) - load(c + d)) / (2 d).
 *
 * These distances may be less than the inner radius, which the linear problem does not notice.
 * Where no end can move, d is 0 and the stiffness is that of the fixed set of nodes.
 *
 * @throws NotSolved as active_set()
 */
std::optional<Loads> contact_stiffness(const ContactEquations& equations,
                                       const SolvedContact& solved, RunStatistics& statistics);

/// One step of the search for the distance.
struct DistanceStep {
  double distance;            ///< a length
  double load;                ///< of the kind of Scene::load, or vertical
  double nip;                 ///< the length of contact
  unsigned int contact_steps; ///< of the active set method
};

/// A distance with the nodal pressures there, and the steps that led to it.
struct RoadPosition {
  double distance;
  dealii::Vector<double> pressure;
  std::vector<DistanceStep> history = {};

  /// Why no distance gives the load or the nip on this mesh; the distance is then the one with the
  /// nearest. Finer meshes may reach it.
  std::optional<std::string> refusal = {};

  /// A shortfall where the load is farther from Scene::load than 1e-9 of it, or the nip from
  /// Scene::nip than a hundredth.
  std::vector<Note> notes = {};
};

/**
 * The road's distance at which the length of contact is Scene::nip, or, where none is given, the
 * load is that of Scene::load: by falling_zero(), to 1e-10 of it or as near as neighbouring
 * distances in double precision allow. On one mesh the length jumps by a little where a node enters
 * contact.
 * The active set method finds the contact for each distance, beginning with that of the distance
 * before. The first is that of @p scene, with the pressures @p start.
 *
 * Load or nip are out of reach on this mesh where a road at Scene::least_distance has less, or a
 * drum around the cylinder has more at every distance.
 *
 * @throws NotSolved as active_set() and falling_zero()
 */
RoadPosition find_distance(const ContactEquations& equations, const ContactBoundary& boundary,
                           const Scene& scene, unsigned int most_steps,
                           const dealii::Vector<double>& start, RunStatistics& statistics);

} // namespace rollwave
