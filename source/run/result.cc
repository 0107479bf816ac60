#include "rollwave/run/result.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>

namespace rollwave {

double Residuals::largest() const {
  return std::max({equilibrium, penetration, negative_pressure, complementarity});
}

std::string shortfall_text(const Result& result) {
  return boost::algorithm::join(texts_of(result.notes, Note::Kind::shortfall), "; ");
}

} // namespace rollwave
