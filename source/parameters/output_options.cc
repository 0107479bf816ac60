#include "rollwave/parameters/output_options.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/text.h"
#include "rollwave/parameters/declarations.h"
#include "rollwave/scene/units.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace rollwave {

namespace {

/// Names that fit into every kind of file.
UnitNames parse_unit_names(const std::string& text) {
  const auto names = split(text, ',');
  if (names.empty())
    return {};
  const bool is_named = std::all_of(names.begin(), names.end(), [](const std::string& name) {
    return !name.empty() && name.find_first_of(" \"'<>&[]") == std::string::npos;
  });
  if (names.size() != 3 || !is_named)
    throw std::invalid_argument("three names with commas between them, as in m, s, N");
  return {names[0], names[1], names[2]};
}

} // namespace

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

void declare_output(Declarations& keys, OutputOptions& output, UnitNames& names) {
  keys.enter("Output");
  keys.add_text("Directory", output.directory,
                "The directory of the files, made when missing, seen from where the program is "
                "called: output and the name of the parameter file where this key is left out.");
  keys.add(
      "Files", "summary, contact, solution, surface, plot",
      [&output](const std::string& text) { output.files = parse_files(text); },
      "The files to write beside parameters.prm: any of summary (summary.json), contact "
      "(contact.csv), solution (solution.vtu), surface (surface.vtu, road.vtu), plot (scene.svg; "
      "study.svg of a study), or all.");
  keys.add_choice<CellKind>(
      "Cells", output.cells, {{"high-order", CellKind::high_order}, {"linear", CellKind::linear}},
      "The cells of solution.vtu for degree 2 and more. \"high-order\": VTK's Lagrange cells, with "
      "curved edges. \"linear\": each cell cut into four-node cells, for every reader.");
  keys.add(
      "Unit names", "", [&names](const std::string& text) { names = parse_unit_names(text); },
      "Empty, or how the units of length, time and force are called, as in \"m, s, N\" or \"mm, s, "
      "N\": screen, files and pictures then name the unit of each number.");
}

} // namespace rollwave
