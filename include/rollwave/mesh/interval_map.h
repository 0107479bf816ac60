#ifndef ROLLWAVE_MESH_INTERVAL_MAP_H
#define ROLLWAVE_MESH_INTERVAL_MAP_H

#include <map>
#include <utility>

namespace rollwave {

/// What belongs to the intervals that cells have in one direction, which are few: each is made when
/// first asked for, and stays where it is.
template <typename T>
class IntervalMap {
public:
  /// @param make returns it, called without arguments
  template <typename Make>
  T& at(double begin, double end, const Make& make) {
    const std::pair<double, double> interval(begin, end);
    const auto known = values.find(interval);
    return known != values.end() ? known->second : values.emplace(interval, make()).first->second;
  }

private:
  std::map<std::pair<double, double>, T> values;
};

} // namespace rollwave

#endif
