#pragma once

#include "rollwave/base/errors.h"
#include "rollwave/scene/units.h"

#include <functional>
#include <string>
#include <vector>

namespace rollwave {

struct Parameters;

/// A value given to a key, as text.
struct Setting {
  std::string section, key, value;
  std::string origin;    ///< the file, or the option of the command line
  unsigned int line = 0; ///< of the file; 0 elsewhere

  std::string path() const { return section + '/' + key; }
  std::string place() const { return origin + (line > 0 ? ", line " + std::to_string(line) : ""); }
};

/// The assignment in "Section/Key=value"; without a slash its section is empty.
/// @throws BadInput when @p text has another form.
Setting parse_setting(const std::string& text, const std::string& origin);

/// A setting whose value has been read: its text has a number in the place of an expression.
struct Assignment : Setting {
  std::function<void(Parameters& parameters)> assign; ///< gives the value to its member
};

/// The last setting of a key; nullptr without one.
const Setting* last_of(const std::vector<Setting>& settings, const std::string& path);

/// The message on a refused value: origin, section, key, value and reason.
std::string refusal(const Setting& setting, const std::string& reason);
std::string refusal(const std::vector<Setting>& settings, const BadValue& value);

/// The value of a setting is refused; the text is that of refusal().
struct RefusedSetting : BadInput {
  RefusedSetting(const Setting& setting, const std::string& reason)
      : BadInput(refusal(setting, reason)) {}
};

/// Reads the value of a setting once and for all.
/// @throws BadInput for an unknown key, RefusedSetting for a value that the key does not accept
Assignment read(const Setting& setting);

/// The parts of a run that depend on a key; a key may have several of these flags.
struct Affects {
  enum : unsigned int {
    scene = 1,      ///< the problem that is solved
    resolution = 2, ///< how fine the mesh is: runs that differ only in this are a convergence study
    titles = 4,     ///< titles of plots, which name the key even at its default
    uzawa = 8       ///< Uzawa's method only
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
  /// Reads the value of a setting, and puts a number in the place of an expression. The result
  /// assigns the value to its member. Throws std::invalid_argument for a value that the text does
  /// not allow, BadInput with the reason for others, RefusedSetting for a setting in the value.
  using Read = std::function<std::function<void(Parameters&)>(Setting& setting)>;

  std::string section, name, default_value, text;
  Read read;

  std::string path() const { return section + '/' + name; }
};

/// Every key, in the order of `rollwave --parameters`.
const std::vector<Key>& all_keys();

/// The key of a setting. @throws BadInput with the nearest keys where there is none
const Key& key_of(const Setting& setting);

/// The value of a key: the last of @p settings, or the default.
std::string value_of(const Key& key, const std::vector<Setting>& settings);

} // namespace rollwave
