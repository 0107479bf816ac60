#pragma once

#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

namespace rollwave {

/// How many random scenes to draw: ROLLWAVE_RANDOM_SCENES, or as many as are usual.
inline int n_random_scenes(int usual) {
  const char* const wanted = std::getenv("ROLLWAVE_RANDOM_SCENES");
  return wanted ? std::atoi(wanted) : usual;
}

/// Random choices, the same ones for a seed.
class Draw {
public:
  explicit Draw(unsigned int seed) : engine(seed) {}

  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  double power_of_ten(double low, double high) { return std::pow(10., number(low, high)); }
  int count(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine); }
  template <typename T>
  T one_of(const std::vector<T>& choices) {
    return choices[count(0, choices.size() - 1)];
  }

private:
  std::mt19937 engine;
};

} // namespace rollwave
