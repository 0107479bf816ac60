#pragma once

#include "rollwave/contact/contact_problem.h"
#include "rollwave/error_bound/admissible_road.h"
#include "rollwave/mesh/surface_trace.h"

#include <deal.II/base/point.h>

#include <utility>
#include <vector>

namespace rollwave {

struct Scene;

/**
 * The trace on r = b of a displacement v that obeys v <= phi at every angle of the contact zone,
 * not only at nodes. From a discrete displacement u_h that obeys the limit phi_v <= phi of
 * AdmissibleRoad at the contact nodes,
 *
 *     v(b, z) = u_h(b, z) + c(z),   c = phi_v - u_h on edges whose nodes are all in contact,
 *                                   c = -(u_h - phi_v)^+ on other edges in the zone.
 *
 * c vanishes at the vertices. On an edge that the zone ends on, c continues outside of the zone as
 * a straight line from its value there to zero at the vertex.
 */
class AdmissibleTrace {
public:
  /// A stretch of an edge, in the coordinate t from 0 at its begin to 1 at its end. On it c is
  /// analytic, and Gauss' rule with n_points() is exact to round-off: the stretch ends at the roots
  /// of u_h - phi_v, and lies far enough from the singularities of phi.
  struct Piece {
    enum class Kind {
      outside, ///< of the zone: c is a straight line from value_begin to value_end
      limited, ///< c = -(u_h - phi_v)^+, of one sign
      touching ///< c = phi_v - u_h
    } kind;
    double t_begin;
    double t_end;
    double value_begin = 0;
    double value_end = 0;
  };

  /// @p field must not exceed phi_v at the contact nodes, and equal it at the active ones.
  AdmissibleTrace(const ContactBoundary& boundary, const Scene& scene, const AdmissibleRoad& road,
                  const FieldVector& field, const std::vector<bool>& active);

  /// The pieces of an edge, numbered as RingSpace::surface_edges(), in the order of t.
  const std::vector<Piece>& pieces(unsigned int edge) const { return edges[edge]; }

  /// The number of Gauss' points on a piece, for products of two derivatives of c and u_h.
  unsigned int n_points() const { return discrete.edges().front().nodes.size() + 9; }

  struct Correction {
    double value; ///< c, a length
    double slope; ///< dc/dz
    double gap;   ///< inside of the zone phi - v, or a bound of it; zero outside
  };
  Correction correction(unsigned int edge, const Piece& piece, double t) const;

  /// v(b, z)
  double displacement(unsigned int edge, const Piece& piece, double t) const;

private:
  std::vector<Piece> pieces_of(unsigned int edge, const std::pair<double, double>& zone,
                               bool touches) const;
  std::vector<double> smooth_stretches(unsigned int edge, double t_begin, double t_end) const;
  void add_pieces(unsigned int edge, const Piece& piece, std::vector<Piece>& pieces) const;
  SurfaceTrace::ValueAndSlope excess(unsigned int edge, double t) const; ///< u_h - phi_v

  AdmissibleRoad road;
  SurfaceTrace discrete;                   ///< u_h
  std::vector<dealii::Point<1>> chebyshev; ///< points at which the excess is looked at
  std::vector<std::vector<Piece>> edges;
};

/// The limit for displacements on a mesh, with the longest edge at a tangent as its reach.
AdmissibleRoad admissible_road(const ContactBoundary& boundary, const Scene& scene);

/// @p field with its contact nodes moved to phi_v where they are @p active or beyond it; the
/// constraints hold after it.
FieldVector project_contact_nodes(const ContactBoundary& boundary, const AdmissibleRoad& road,
                                  const std::vector<bool>& active, FieldVector field);

} // namespace rollwave
