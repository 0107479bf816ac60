#include "rollwave/parameters/output_options.h"

#include "rollwave/base/text.h"
#include "rollwave/parameters/keys.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <stdexcept>

namespace rollwave {

namespace {

const std::map<OutputFile, std::string> kind_names = {
    {OutputFile::summary, "summary"},       {OutputFile::contact, "contact"},
    {OutputFile::parameters, "parameters"}, {OutputFile::solution, "solution"},
    {OutputFile::surface, "surface"},       {OutputFile::plot, "plot"}};

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
    throw std::invalid_argument("");
  return {names[0], names[1], names[2]};
}

} // namespace

std::set<OutputFile> parse_files(const std::string& text) {
  std::set<OutputFile> files = {OutputFile::parameters};
  for (const std::string& name : split(text, ',')) {
    const auto kind = std::find_if(kind_names.begin(), kind_names.end(),
                                   [&](const auto& known) { return known.second == name; });
    if (kind == kind_names.end())
      throw std::invalid_argument("");
    files.insert(kind->first);
  }
  return files;
}

std::string text_of(const std::set<OutputFile>& files) {
  std::string text;
  for (const OutputFile kind : files)
    text += (text.empty() ? "" : ", ") + kind_names.at(kind);
  return text;
}

void declare_output(Section<OutputOptions> keys) {
  keys.declare(
      "Directory", OutputOptions().directory,
      [](Setting& setting) {
        if (setting.value.empty())
          throw std::invalid_argument("");
        if (setting.value.front() == '~')
          throw BadInput("only a shell knows the directory ~; write its name, or ./~ for a "
                         "directory whose name begins so");
        return [directory = setting.value](Parameters& p) { p.output.directory = directory; };
      },
      "Directory of the files, relative to the current one, made when missing. Where this key is "
      "left out: output/NAME for a parameter file NAME.prm.");
  keys.declare(
      "Files", "summary, contact, solution, surface, plot",
      [](Setting& setting) {
        return [files = parse_files(setting.value)](Parameters& p) { p.output.files = files; };
      },
      "Files to write in addition to parameters.prm: any of summary (summary.json), contact "
      "(contact.csv), solution (solution.vtu), surface (surface.vtu, road.vtu), plot (scene.svg; "
      "study-curves.svg and others of a study).");
  keys.add_choice(
      "Cells", &OutputOptions::cells,
      {{"high-order", CellKind::high_order}, {"linear", CellKind::linear}},
      "Cells of solution.vtu for degree 2 and more. \"high-order\": VTK's Lagrange cells, with "
      "curved edges. \"linear\": each cell cut into four-node cells, for every reader.");
  keys.add_choice(
      "Picture format", &OutputOptions::picture_format,
      {{"svg", PictureFormat::svg}, {"png", PictureFormat::png}, {"pdf", PictureFormat::pdf}},
      "Format of the pictures, which is the ending of their names: svg for web pages and drawing "
      "programs, png for word processors, pdf for LaTeX.");
  keys.declare(
      "Unit names", "",
      [](Setting& setting) {
        return [names = parse_unit_names(setting.value)](Parameters& p) {
          p.material.unit_names = names;
        };
      },
      "Empty, or names of the units of length, time and force, as in \"m, s, N\" or \"mm, s, N\", "
      "of letters, digits, blanks and ^*/.-()%: screen, files and pictures then name the unit of "
      "each number.");
}

} // namespace rollwave
