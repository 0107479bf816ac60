#include "rollwave/base/version.h"

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <cholmod.h>
#include <deal.II/base/config.h>

namespace rollwave {

std::string version_text() {
  return "Rollwave " ROLLWAVE_VERSION " (deal.II " DEAL_II_PACKAGE_VERSION ")";
}

std::string digest_with_program(const std::string& text) {
  using boost::uuids::name_generator_sha1;
  static const boost::uuids::uuid program = [] {
    int release[3];
    cholmod_version(release);
    std::string name = version_text() + " " + source_digest();
    for (const int number : release)
      name += '.' + std::to_string(number);
    return name_generator_sha1(boost::uuids::ns::oid())(name);
  }();
  return to_string(name_generator_sha1(program)(text));
}

} // namespace rollwave
