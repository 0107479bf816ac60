#pragma once

#include "rollwave/output/output_directory.h"

#include <filesystem>
#include <string>

namespace rollwave {

/// A gnuplot script, which sets neither terminal nor output, and the size of its picture in points.
struct Picture {
  std::string script;
  unsigned int width, height;
};

/// @p text as a string of gnuplot, in which it expands nothing.
std::string in_single_quotes(const std::string& text);

/// Writes NAME.gp, which draws NAME.svg when gnuplot runs it in @p directory, and runs it there. If
/// that fails, as without gnuplot, there is no picture but a remark. @throws NotWritten.
void draw(const Picture& picture, const std::filesystem::path& directory, const std::string& name,
          WrittenFiles& written);

} // namespace rollwave
