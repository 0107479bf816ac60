#pragma once

#include <string>
#include <tuple>

namespace rollwave {

/// The user's names for the units of a consistent system; empty without names.
struct UnitNames {
  std::string length, time, force;

  auto members() const { return std::tie(length, time, force); }
  bool operator==(const UnitNames& other) const { return members() == other.members(); }
};

/// Section `Material` and `Output/Unit names`. With the defaults the shear modulus, the speed of
/// shear waves and the width are the units.
struct MaterialOptions {
  double shear_modulus = 1; ///< mu
  double density = 1;       ///< rho
  double width = 1;         ///< of the cylinder, along its axle
  UnitNames unit_names;

  auto members() const { return std::tie(shear_modulus, density, width, unit_names); }
  bool operator==(const MaterialOptions& other) const { return members() == other.members(); }

  /// True if any of the numbers is not 1.
  bool is_given() const { return shear_modulus != 1 || density != 1 || width != 1; }

  /// (mu / rho)^(1/2), a length over a time
  double wave_speed() const;
};

/// The dimension of a number.
enum class Quantity {
  number,
  count, ///< of things, a whole number
  angle, ///< in radians
  length,
  area,
  curvature, ///< one over a length
  angular_velocity,
  density, ///< that of the material, which the scene has none of
  pressure,
  pressure_norm, ///< pressure times the root of a length, see TrueErrors
  force,
  force_density, ///< force over volume, or pressure over length
  stiffness,     ///< force over length
  energy,
  energy_norm ///< the square root of an energy
};

/**
 * The units of a Scene. Inside, the shear modulus, the speed of shear waves and the width are 1,
 * and lengths are in a unit of the scene's own; a force is a pressure times a length times the
 * width.
 */
struct Units {
  double length = 1; ///< the scene's unit of length in the user's
  MaterialOptions material = {};

  /// The number in the user's units for 1 in the scene, and the name of that unit, as "N/m^2" if
  /// there are names.
  struct Unit {
    double value;
    std::string name;
  };
  Unit unit(Quantity quantity) const;

  double of(Quantity quantity) const { return unit(quantity).value; }

  /// The name after a number, " m", and after the name of a quantity, " [m]".
  std::string after(Quantity quantity) const;
  std::string in_brackets(Quantity quantity) const;

  /// The name in that of a field, "_N_per_mm2": letters, digits and "_", since VisIt refuses
  /// others.
  std::string as_suffix(Quantity quantity) const;
};

} // namespace rollwave
