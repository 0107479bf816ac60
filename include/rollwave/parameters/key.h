#pragma once

#include "rollwave/base/errors.h"
#include "rollwave/scene/units.h"

#include <string>
#include <vector>

namespace rollwave {

/// A value given to a key. The origin is the file with the line, or the option of the command line.
struct Setting {
  std::string section, key, value, origin;

  std::string path() const { return section + '/' + key; }
};

/// The assignment in "Section/Key=value"; without a slash its section is empty.
/// @throws BadInput when @p text has another form.
Setting parse_setting(const std::string& text, const std::string& origin);

/// The last setting of a key; nullptr without one.
const Setting* last_of(const std::vector<Setting>& settings, const std::string& path);

/// The message on a refused value: origin, section, key, value and reason.
std::string refusal(const std::vector<Setting>& settings, const BadValue& value);

/// The parts of a run that depend on a key; a key may have several of these flags.
struct Affects {
  enum : unsigned int {
    scene = 1,      ///< the problem that is solved
    mesh = 2,       ///< mesh and linear solver, which runs with the same values share
    resolution = 4, ///< how fine the mesh is: runs that differ only in this are a convergence study
    titles = 8,     ///< titles of plots, which name the key even at its default
    uzawa = 16      ///< Uzawa's method only
  };
};

/// How studies name a key, and what depends on it.
struct KeyAttributes {
  unsigned int affects = 0; ///< flags of Affects, to which those of the section are added
  std::string symbol = {};  ///< such as "c"
  Quantity quantity = Quantity::number;
};

/// A key of parameter files.
struct Key : KeyAttributes {
  std::string section, name, default_value, text;

  std::string path() const { return section + '/' + name; }
};

} // namespace rollwave
