#include "rollwave/base/version.h"

#include <deal.II/base/config.h>

namespace rollwave {

std::string version_text() {
  return "Rollwave " ROLLWAVE_VERSION " (deal.II " DEAL_II_PACKAGE_VERSION ")";
}

} // namespace rollwave
