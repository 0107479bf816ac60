#ifndef ROLLWAVE_PARAMETERS_PRM_READER_H
#define ROLLWAVE_PARAMETERS_PRM_READER_H

#include "rollwave/base/text.h"

#include <mpi.h>

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace rollwave {

/// One assignment of a value to a key, as the user wrote it, and where: "FILE, line N" or "--set".
struct Setting {
  std::string section;
  std::string key;
  std::string value;
  std::string origin;

  std::string path() const { return section + "/" + key; }
};

/**
 * The assignments of a parameter file, in its order; @p name is that of the file in messages. The
 * grammar is that of deal.II's ParameterHandler (`subsection`, `set KEY = VALUE`, `end`, `#` for
 * comments, `\` at the end of a line to continue it), read here to keep the line of every entry. A
 * value in double quotes may hold a `#` and blanks at its ends.
 *
 * @throws BadInput when the file cannot be read, is longer than 1 MiB or no text, has a line of
 *         another form, unbalanced subsections, or sets a key twice.
 */
std::vector<Setting> read_settings(std::istream& in, const std::string& name);

/// The same of the file at a path, which the first process reads for all: a pipe gives its text
/// once.
std::vector<Setting> read_settings(const std::filesystem::path& file,
                                   MPI_Comm communicator = MPI_COMM_SELF);

/// The assignment in "Section/Key=value"; without a slash its section is empty.
/// @throws BadInput when @p text has another form.
Setting parse_setting(const std::string& text, const std::string& origin);

/// @p value as a parameter file has it, in quotes where it needs them.
/// @throws std::invalid_argument where none can hold it.
std::string in_file(const std::string& value);

} // namespace rollwave

#endif
