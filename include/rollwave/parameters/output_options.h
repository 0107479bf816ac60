#pragma once

#include <set>
#include <string>

namespace rollwave {

template <typename Options>
class Section;

enum class OutputFile { summary, contact, parameters, solution, surface, plot };

/// The cells of solution.vtu for elements of degree 2 and more.
enum class CellKind { high_order, linear };

/// The formats in which gnuplot draws pictures.
enum class PictureFormat { svg, png, pdf };

/// Section `Output`.
struct OutputOptions {
  std::string directory = "output";
  std::set<OutputFile> files = {OutputFile::summary,  OutputFile::contact, OutputFile::parameters,
                                OutputFile::solution, OutputFile::surface, OutputFile::plot};
  CellKind cells = CellKind::high_order;
  PictureFormat picture_format = PictureFormat::svg;
};

/// The kinds in a list, always with `parameters`. @throws std::invalid_argument for an unknown one
std::set<OutputFile> parse_files(const std::string& text);

/// The text of a list, as parse_files() reads it.
std::string text_of(const std::set<OutputFile>& files);

/// The keys of the section.
void declare_output(Section<OutputOptions> keys);

} // namespace rollwave
