#pragma once

#include "rollwave/parameters/key.h"
#include "rollwave/parameters/study_options.h"

#include <mpi.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rollwave {

/// The arguments of a call.
struct CommandLine {
  enum class Action { run, help, version, parameters, quantities };
  Action action = Action::run;
  std::filesystem::path file;    ///< the parameter file to run
  bool verify = false;           ///< compare with the exact solution
  std::vector<Setting> settings; ///< of --set and --output, in their order
  std::optional<StudyPart> part; ///< of a study
};

/// @throws BadInput for arguments that are not understood.
CommandLine read_command_line(const std::vector<std::string>& arguments);

/// The settings of the file, if there is one; then output/NAME as Output/Directory if neither the
/// file NAME.prm nor the command line sets one; then those of the command line.
/// @throws BadInput as read_settings() does.
std::vector<Setting> settings_of(const CommandLine& line, MPI_Comm communicator);

/// How to call the program.
std::string usage();

} // namespace rollwave
