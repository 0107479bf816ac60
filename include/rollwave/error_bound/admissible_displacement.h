#pragma once

#include "rollwave/contact/contact_problem.h"
#include "rollwave/mesh/surface_trace.h"

#include <utility>
#include <vector>

namespace rollwave {

struct Scene;

/**
 * The trace on r = b of a displacement v that obeys v <= phi at every angle of the contact zone,
 * not only at nodes. From a discrete displacement u_h that obeys phi at the contact nodes,
 *
 *     v(b, z) = u_h(b, z) + c(z),   c = phi - u_h on edges whose nodes are all in contact,
 *                                   c = -(u_h - phi)^+ on other edges in the zone.
 *
 * c vanishes at the vertices. On an edge that the zone ends on, c continues outside of the zone as
 * a straight line from its value there to zero at the vertex.
 */
class AdmissibleTrace {
public:
  /// A stretch of an edge, in the coordinate t from 0 at its begin to 1 at its end.
  struct Piece {
    enum class Kind {
      outside, ///< of the zone: c is a straight line from value_begin to value_end
      limited, ///< c = -(u_h - phi)^+, of one sign, except for roots that were not found
      touching ///< c = phi - u_h
    } kind;
    double t_begin;
    double t_end;
    double value_begin = 0;
    double value_end = 0;
  };

  /// @p field must not exceed phi at the contact nodes, and equal it at the active ones.
  AdmissibleTrace(const ContactBoundary& boundary, const Scene& scene, const FieldVector& field,
                  const std::vector<bool>& active);

  /// The pieces of an edge, numbered as RingSpace::surface_edges(), in the order of t.
  const std::vector<Piece>& pieces(unsigned int edge) const { return edges[edge]; }

  struct Correction {
    double value; ///< c, a length
    double slope; ///< dc/dz
    double gap;   ///< phi - v inside of the zone, zero outside
  };
  Correction correction(unsigned int edge, const Piece& piece, double t) const;

  /// v(b, z)
  double displacement(unsigned int edge, const Piece& piece, double t) const;

private:
  std::vector<Piece> pieces_of(unsigned int edge, const std::pair<double, double>& zone,
                               bool touches) const;
  std::vector<Piece> limited_pieces(unsigned int edge, double zone_begin, double zone_end) const;
  SurfaceTrace::ValueAndSlope excess(unsigned int edge, double t) const; ///< u_h - phi

  Obstacle phi;
  SurfaceTrace discrete; ///< u_h
  std::vector<std::vector<Piece>> edges;
};

/// @p field with its contact nodes moved to the road where they are active or beyond it; the
/// constraints hold after it.
FieldVector project_contact_nodes(const ContactBoundary& boundary, const ContactProblem& problem,
                                  const std::vector<bool>& active, FieldVector field);

} // namespace rollwave
