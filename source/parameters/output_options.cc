#include "rollwave/parameters/output_options.h"

#include "rollwave/base/errors.h"
#include "rollwave/base/text.h"
#include "rollwave/parameters/keys.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace rollwave {

namespace {

/// Names without letters that a shell, gnuplot, XML or JSON give a meaning to.
UnitNames parse_unit_names(const std::string& text) {
  const auto names = split(text, ',');
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) || std::string(" ^*/.-()%").find(c) != std::string::npos;
  };
  if (names.empty())
    return {};
  if (names.size() != 3 || std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return name.empty() || !std::all_of(name.begin(), name.end(), is_plain);
      }))
    throw BadInput("");
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
    const auto kind = kinds.find(name);
    if (kind == kinds.end())
      throw BadInput("");
    files.insert(kind->second.begin(), kind->second.end());
  }
  return files;
}

void declare_output(Keys& keys, OutputOptions& output, UnitNames& names) {
  keys.enter("Output", Affects::files);
  keys.add_parsed(
      "Directory", output.directory,
      [&output](const std::string& text) {
        if (text.empty())
          throw BadInput("");
        output.directory = text;
      },
      "Directory of the files, relative to the current one, made when missing. Where this key is "
      "left out: output/NAME for a parameter file NAME.prm.");
  keys.add_parsed(
      "Files", "summary, contact, solution, surface, plot",
      [&output](const std::string& text) { output.files = parse_files(text); },
      "Files to write in addition to parameters.prm: any of summary (summary.json), contact "
      "(contact.csv), solution (solution.vtu), surface (surface.vtu, road.vtu), plot (scene.svg; "
      "study.svg of a study), or all.");
  keys.add_choice<CellKind>(
      "Cells", output.cells, {{"high-order", CellKind::high_order}, {"linear", CellKind::linear}},
      "Cells of solution.vtu for degree 2 and more. \"high-order\": VTK's Lagrange cells, with "
      "curved edges. \"linear\": each cell cut into four-node cells, for every reader.");
  keys.add_parsed(
      "Unit names", "", [&names](const std::string& text) { names = parse_unit_names(text); },
      "Empty, or names of the units of length, time and force, as in \"m, s, N\" or \"mm, s, N\", "
      "of letters, digits, blanks and ^*/.-()%: screen, files and pictures then name the unit of "
      "each number.");
}

} // namespace rollwave
