#ifndef ROLLWAVE_PARAMETERS_PARAMETERS_H
#define ROLLWAVE_PARAMETERS_PARAMETERS_H

#include "rollwave/base/errors.h"
#include "rollwave/parameters/output_options.h"
#include "rollwave/parameters/prm_reader.h"
#include "rollwave/parameters/study_options.h"
#include "rollwave/run/run_options.h"

#include <filesystem>
#include <iosfwd>
#include <set>
#include <string>
#include <vector>

namespace rollwave {

/**
 * All that a parameter file can say, one member for each key, in the file's sections. Lengths share
 * one unit, chosen by the user; angles are in radians; the wave speed and the shear modulus are 1.
 */
struct Parameters : RunOptions {
  StudyOptions study;

  OutputOptions output;

  std::filesystem::path file; ///< that was read; never written over

  /// What was set, in order of increasing precedence; later entries override earlier ones.
  std::vector<Setting> settings;

  bool wants(OutputFile kind) const { return output.files.count(kind) > 0; }
};

/**
 * The parameters that @p settings describe; keys not mentioned keep their defaults.
 *
 * @throws BadInput for an unknown section or key (naming the nearest known ones), or a value that
 *         its key does not admit. What depends on several keys is checked by make_scene().
 */
Parameters read_parameters(const std::vector<Setting>& settings);

/// The message for a value that is not admitted: where it was set, section, key, value and what is
/// wanted instead.
std::string refusal(const std::vector<Setting>& settings, const std::string& section,
                    const std::string& key, const std::string& wanted);

/// The same for a value that a lower floor has refused.
std::string refusal(const std::vector<Setting>& settings, const BadValue& value);

/// A complete commented parameter file: defaults, overridden by @p settings.
/// @throws BadInput as read_parameters().
void print_parameters(std::ostream& out, const std::vector<Setting>& settings);

} // namespace rollwave

#endif
