#include "rollwave/base/version.h"

#include "rollwave/base/atomic_file.h"

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <deal.II/base/config.h>

#include <functional>

namespace rollwave {

std::string version_text() {
  return "Rollwave " ROLLWAVE_VERSION " (deal.II " DEAL_II_PACKAGE_VERSION ")";
}

std::string digest_with_build(const std::string& text) {
  using boost::uuids::name_generator_sha1;
  // The bytes of the program are many: for them a fast hash is enough.
  static const boost::uuids::uuid build = name_generator_sha1(boost::uuids::ns::oid())(
      version_text() + std::to_string(std::hash<std::string>()(read_file("/proc/self/exe"))));
  return to_string(name_generator_sha1(build)(text));
}

} // namespace rollwave
