#ifndef ROLLWAVE_MESH_INTERVAL_MAP_H
#define ROLLWAVE_MESH_INTERVAL_MAP_H

#include <deal.II/base/exceptions.h>

#include <boost/functional/hash.hpp>

#include <cstddef>
#include <deque>
#include <unordered_map>
#include <utility>

namespace rollwave {

/// What belongs to the intervals that cells have in one direction, which are few: each is made when
/// first asked for, and stays where it is.
template <typename T>
class IntervalMap {
public:
  using Interval = std::pair<double, double>;

  /// @param make returns it, called without arguments
  template <typename Make>
  T& at(double begin, double end, const Make& make) {
    const Interval interval(begin, end);
    if (recent < values.size() && values[recent].first == interval)
      return values[recent].second;
    // Cells of a uniform mesh come from the inside out, one row after another.
    if (++recent >= values.size())
      recent = 0;
    if (recent >= values.size() || values[recent].first != interval) {
      const auto number = numbers.find(interval);
      recent = number == numbers.end() ? values.size() : number->second;
    }
    if (recent == values.size()) {
      values.emplace_back(interval, make());
      numbers.emplace(interval, recent);
    }
    return values[recent].second;
  }

private:
  std::deque<std::pair<Interval, T>> values;
  std::unordered_map<Interval, std::size_t, boost::hash<Interval>> numbers;
  std::size_t recent = 0;
};

} // namespace rollwave

#endif
