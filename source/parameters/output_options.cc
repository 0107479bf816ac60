#include "rollwave/parameters/output_options.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/text.h"

#include <map>

namespace rollwave {

namespace {

const std::map<std::string, OutputFile> output_files = {{"summary", OutputFile::summary},
                                                        {"contact", OutputFile::contact},
                                                        {"parameters", OutputFile::parameters},
                                                        {"solution", OutputFile::solution},
                                                        {"plot", OutputFile::plot}};

} // namespace

std::vector<OutputFile> parse_files(const std::string& text) {
  std::vector<OutputFile> files;
  for (const std::string& name : split(text, ',')) {
    if (name == "mesh")
      throw BadInput(
          "the file kind \"mesh\" is gone: see the cells in solution.vtu with ParaView's "
          "\"Surface With Edges\"");
    files.push_back(output_files.at(name));
  }
  return files;
}

} // namespace rollwave
