#pragma once

#include "rollwave/base/written_files.h"
#include "rollwave/parameters/output_options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rollwave {

/// A gnuplot script, which sets neither terminal nor output, and the size of its picture in points.
struct Picture {
  std::string name; ///< of its files, without ending
  std::string script;
  unsigned int width, height;
};

/// The command for a grid of pale lines. gnuplot's own grid looks different in each format.
constexpr const char* set_grid = "set grid linetype 1 linewidth 0.5 linecolor rgb '#d8d8d8'\n";

/// @p text as a string of gnuplot, in which it expands nothing.
std::string in_single_quotes(const std::string& text);

/// The names of the two files of a picture.
std::vector<std::string> picture_files(const std::string& name, PictureFormat format);

/// The size of letters with which a line of @p n_letters has room in @p width, at most @p largest.
/// A legend that is too wide is not drawn at all.
unsigned int size_of_letters(double n_letters, double width, unsigned int largest);

/// A title and its font as gnuplot reads them.
struct Title {
  std::string text;
  unsigned int n_lines;
};

/// A title in lines that have room in @p width: those of @p text, broken after commas.
Title title_in_room(const std::string& text, unsigned int width);

/// Writes for each picture NAME.gp, which draws NAME.svg, or NAME.png or NAME.pdf, when gnuplot
/// runs it in @p directory, and runs gnuplot there, a minute at most for all pictures. Where that
/// fails, as without gnuplot, there is no picture but a remark. @throws NotWritten.
void draw(const std::vector<Picture>& pictures, const std::filesystem::path& directory,
          PictureFormat format, WrittenFiles& written);

} // namespace rollwave
