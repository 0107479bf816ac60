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
 * comments, `\` at the end of a line to continue it); reading it here keeps the line of every entry
 * for later messages.
 *
 * @throws BadInput when the file cannot be read or is longer than 1 MiB, has a line of another
 *         form, unbalanced subsections, or sets a key twice.
 */
std::vector<Setting> read_settings(std::istream& in, const std::string& name);

/// The same of the file at a path, which the first process reads for all: a pipe gives its text
/// once.
std::vector<Setting> read_settings(const std::filesystem::path& file,
                                   MPI_Comm communicator = MPI_COMM_SELF);

/// The assignment in "Section/Key=value". @throws BadInput when @p text has another form.
Setting parse_setting(const std::string& text, const std::string& origin);

/// Whether a parameter file can hold @p value and gives it back unchanged: without comment, line
/// end or repeated white space in it, nor a continuation at its end.
bool is_writable(const std::string& value);

} // namespace rollwave

#endif
