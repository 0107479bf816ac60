#ifndef ROLLWAVE_FORCE_PANELS_H
#define ROLLWAVE_FORCE_PANELS_H

#include "force_panel.h"

#include <vector>

namespace rollwave {

/// The panels of a ring: itself, and the two into which each was cut that was, which follow their
/// whole. The parts, which are those that were not cut, cover the ring.
class ForcePanels {
public:
  explicit ForcePanels(const Scene& scene);

  ForcePanel& operator[](unsigned int number) { return nodes[number].panel; }
  const ForcePanel& operator[](unsigned int number) const { return nodes[number].panel; }
  unsigned int size() const { return nodes.size(); }
  bool is_part(unsigned int number) const { return nodes[number].inner == 0; }

  /// Cuts a part in two: adds the inner and the outer one, in this order, and @returns the former's
  /// number.
  unsigned int cut(const Scene& scene, unsigned int number, unsigned int direction, double place);

  /// Cuts it in the middle.
  unsigned int halve(const Scene& scene, unsigned int number, unsigned int direction);

  /// The numbers of the parts on the line z in [0, 2 pi), beyond a radius, from the hub outwards.
  std::vector<unsigned int> on(double z, double begin) const;

  /// f_0 on the line z in [0, 2 pi), of which these are the parts from some radius to the surface;
  /// those beyond the radius @p end only count for what is outside.
  ForceColumn column(const std::vector<unsigned int>& line, double z, double end) const;

  /// The angles in ]begin, end[ where parts end, in order, beyond the radius @p radius.
  std::vector<double> ends(double begin, double end, double radius) const;

  /// The angles in [0, 2 pi) where f jumps on a line z = const, in order, as far as parts end
  /// there.
  std::vector<double> jumps(const Scene& scene) const;

  /// C ||f||, a bound of (f, w) / |w|, if all parts are judged.
  double friedrichs_norm(const Scene& scene) const;

private:
  struct Node {
    ForcePanel panel;
    unsigned int inner = 0;     ///< the number of the inner one, the outer follows; 0: none
    unsigned int direction = 0; ///< in which the panel was cut
  };

  void collect(unsigned int number, double z, double begin, std::vector<unsigned int>& line) const;

  std::vector<Node> nodes;
};

} // namespace rollwave

#endif
