#include "rollwave/scene/units.h"

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/replace.hpp>

#include <cctype>
#include <cmath>

namespace rollwave {

double MaterialOptions::wave_speed() const {
  return std::sqrt(shear_modulus / density);
}

Units::Unit Units::unit(Quantity quantity) const {
  const double stiffness = material.shear_modulus * material.width;
  const auto& [m, s, newton] = material.unit_names;
  switch (quantity) {
  case Quantity::angle:
    return {1, "rad"};
  case Quantity::length:
    return {length, m};
  case Quantity::area:
    return {length * length, m + "^2"};
  case Quantity::curvature:
    return {1 / length, "1/" + m};
  case Quantity::angular_velocity:
    return {material.wave_speed() / length, "rad/" + s};
  case Quantity::density:
    return {1, newton + ' ' + s + "^2/" + m + "^4"};
  case Quantity::pressure:
    return {material.shear_modulus, newton + '/' + m + "^2"};
  case Quantity::pressure_norm:
    return {material.shear_modulus * std::sqrt(length), newton + '/' + m + "^(3/2)"};
  case Quantity::force_density:
    return {material.shear_modulus / length, newton + '/' + m + "^3"};
  case Quantity::stiffness:
    return {stiffness, newton + '/' + m};
  case Quantity::force:
    return {stiffness * length, newton};
  case Quantity::energy:
    return {stiffness * length * length, newton + ' ' + m};
  case Quantity::energy_norm:
    return {std::sqrt(stiffness) * length, '(' + newton + ' ' + m + ")^(1/2)"};
  case Quantity::number:
  case Quantity::count:
    break;
  }
  return {1, ""};
}

std::string Units::after(Quantity quantity) const {
  const std::string name = unit(quantity).name;
  return material.unit_names.length.empty() || name.empty() ? "" : ' ' + name;
}

std::string Units::in_brackets(Quantity quantity) const {
  const std::string name = after(quantity);
  return name.empty() ? "" : " [" + name.substr(1) + ']';
}

std::string Units::as_suffix(Quantity quantity) const {
  std::string name = after(quantity);
  if (boost::algorithm::ends_with(name, ")^(1/2)"))
    name = " root" + name.substr(0, name.size() - std::string("^(1/2)").size());
  std::string suffix;
  for (const char c : boost::algorithm::replace_all_copy(name, "/", " per "))
    if (std::isalnum(static_cast<unsigned char>(c)))
      suffix += c;
    else if ((c == ' ' || c == '(') && (suffix.empty() || suffix.back() != '_'))
      suffix += '_';
  return suffix;
}

} // namespace rollwave
