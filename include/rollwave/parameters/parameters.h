#pragma once

#include "rollwave/base/errors.h"
#include "rollwave/parameters/key.h"
#include "rollwave/parameters/output_options.h"
#include "rollwave/parameters/study_options.h"
#include "rollwave/run/run_options.h"

#include <mpi.h>

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace rollwave {

/**
 * The values of a parameter file, one member for each key, in the file's sections. They
 * are in the user's units; angles are in radians.
 */
struct Parameters : RunOptions {
  StudyOptions study;

  OutputOptions output;

  std::filesystem::path file; ///< that was read; never written over

  /// The values given to keys, with numbers in the place of expressions; later ones override
  /// earlier ones.
  std::vector<Setting> settings;

  bool wants(OutputFile kind) const { return output.files.count(kind) > 0; }
};

/// The settings in the text of a parameter file, whose form is that of deal.II's ParameterHandler
/// without "include". @p name is that of the file in messages.
/// @throws BadInput for a line of another form, an unknown section, a key that is set twice, or a
///         section without its end
std::vector<Setting> parse_settings(const std::string& text, const std::string& name);

/// The same of the file at a path, which rank 0 reads for all: a pipe gives its text once.
/// @throws BadInput also for a file that cannot be read, then on rank 0 only
std::vector<Setting> read_settings(const std::filesystem::path& file,
                                   MPI_Comm communicator = MPI_COMM_SELF);

/**
 * The parameters with further values, which override theirs. The later one of `Road/Distance` and
 * of `Road/Load` or `Road/Nip` replaces the other.
 *
 * @throws BadInput for a distance and a load of the same origin, such as the command line
 */
Parameters with_values(Parameters parameters, const std::vector<Assignment>& assignments);

/// The parameters of the defaults with_values() these settings.
/// @throws BadInput as read() and with_values(), and for a key that a scene of a study sets twice
/// or that varies as well. Other conditions between keys are checked by make_scene().
Parameters read_parameters(const std::vector<Setting>& settings);

/// A complete commented parameter file: defaults, overridden by the settings of @p parameters.
void print_parameters(std::ostream& out, const Parameters& parameters);

} // namespace rollwave
