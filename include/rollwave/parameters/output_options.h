#ifndef ROLLWAVE_PARAMETERS_OUTPUT_OPTIONS_H
#define ROLLWAVE_PARAMETERS_OUTPUT_OPTIONS_H

#include <string>
#include <vector>

namespace rollwave {

enum class OutputFile { summary, contact, parameters, solution, plot };

/// Section `Output`.
struct OutputOptions {
  std::string directory = "output";
  std::vector<OutputFile> files;
};

/// A list of kinds of files. @throws std::out_of_range for an unknown one, BadInput for one of
/// earlier versions
std::vector<OutputFile> parse_files(const std::string& text);

} // namespace rollwave

#endif
