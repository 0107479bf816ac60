#ifndef ROLLWAVE_INTERVAL_MAP_H
#define ROLLWAVE_INTERVAL_MAP_H

#include <boost/functional/hash.hpp>

#include <unordered_map>
#include <utility>

namespace rollwave {

/// What belongs to the intervals that cells have in one direction, which are few: each is made when
/// first asked for, and stays where it is.
template <typename T>
class IntervalMap {
public:
  using Interval = std::pair<double, double>;
  using Entries = std::unordered_map<Interval, T, boost::hash<Interval>>;

  IntervalMap() = default;
  IntervalMap(IntervalMap&&) = default;
  IntervalMap(const IntervalMap&) = delete; // `recent` would stay with the other
  IntervalMap& operator=(const IntervalMap&) = delete;

  /// @param make returns it, called without arguments
  template <typename Make>
  T& at(double begin, double end, const Make& make) {
    const Interval interval(begin, end);
    if (!recent || recent->first != interval) {
      auto entry = known.find(interval);
      if (entry == known.end())
        entry = known.emplace(interval, make()).first;
      recent = &*entry;
    }
    return recent->second;
  }

  /// All that are made, in any order.
  const Entries& entries() const { return known; }

private:
  Entries known;
  typename Entries::value_type* recent = nullptr;
};

} // namespace rollwave

#endif
