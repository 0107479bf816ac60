#pragma once

#include "rollwave/base/written_files.h"

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

/// @p text as a string of gnuplot, in which it expands nothing.
std::string in_single_quotes(const std::string& text);

/// The names of the two files of a picture.
std::vector<std::string> picture_files(const std::string& name);

/// Writes for each picture NAME.gp, which draws NAME.svg when gnuplot runs it in @p directory, and
/// runs gnuplot there, a minute at most for all pictures. Where that fails, as without gnuplot,
/// there is no picture but a remark. @throws NotWritten.
void draw(const std::vector<Picture>& pictures, const std::filesystem::path& directory,
          WrittenFiles& written);

} // namespace rollwave
