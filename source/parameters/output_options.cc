#include "rollwave/parameters/output_options.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/text.h"
#include "rollwave/parameters/declarations.h"

#include <map>

namespace rollwave {

std::set<OutputFile> parse_files(const std::string& text) {
  using File = OutputFile;
  const std::map<std::string, std::set<File>> kinds = {
      {"summary", {File::summary}},
      {"contact", {File::contact}},
      {"solution", {File::solution}},
      {"surface", {File::surface}},
      {"plot", {File::plot}},
      {"parameters", {File::parameters}},
      {"all", {File::summary, File::contact, File::solution, File::surface, File::plot}}};
  std::set<File> files = {File::parameters};
  for (const std::string& name : split(text, ',')) {
    if (name == "mesh")
      throw BadInput(
          "the file kind \"mesh\" is gone: see the cells in solution.vtu with ParaView's "
          "\"Surface With Edges\"");
    files.merge(choice_of(name, kinds));
  }
  return files;
}

} // namespace rollwave
