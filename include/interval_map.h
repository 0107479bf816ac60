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

  /// nullptr where it is not made.
  const T* find(double begin, double end) const {
    const auto entry = known.find(std::pair(begin, end));
    return entry == known.end() ? nullptr : &entry->second;
  }

private:
  std::map<std::pair<double, double>, T> known;
  typename std::map<std::pair<double, double>, T>::iterator recent = known.end();
};

} // namespace rollwave

#endif
