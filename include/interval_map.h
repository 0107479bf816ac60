#ifndef ROLLWAVE_INTERVAL_MAP_H
#define ROLLWAVE_INTERVAL_MAP_H

#include <map>
#include <utility>

namespace rollwave {

/// What belongs to the intervals that cells have in one direction, which are few: each is made when
/// first asked for.
template <typename T>
class IntervalMap {
public:
  /// @param make returns it, called without arguments
  template <typename Make>
  T& at(double begin, double end, const Make& make) {
    const auto key = std::pair(begin, end);
    if (recent != known.end() && recent->first == key)
      return recent->second;
    // Cells of a uniform mesh come from the inside out, one row after another.
    if (recent == known.end() || ++recent == known.end())
      recent = known.begin();
    if (recent == known.end() || recent->first != key)
      recent = known.find(key);
    if (recent == known.end())
      recent = known.emplace(key, make()).first;
    return recent->second;
  }

  /// All that are made, by the ends of their intervals.
  const std::map<std::pair<double, double>, T>& entries() const { return known; }

private:
  std::map<std::pair<double, double>, T> known;
  typename std::map<std::pair<double, double>, T>::iterator recent = known.end();
};

} // namespace rollwave

#endif
