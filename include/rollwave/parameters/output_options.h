#pragma once

#include "rollwave/scene/units.h"

#include <set>
#include <string>

namespace rollwave {

class Keys;

enum class OutputFile { summary, contact, parameters, solution, surface, plot };

/// The cells of solution.vtu for elements of degree 2 and more.
enum class CellKind { high_order, linear };

/// Section `Output`.
struct OutputOptions {
  std::string directory = "output";
  std::set<OutputFile> files;
  CellKind cells = CellKind::high_order;
};

/// The kinds in a list, always with `parameters`. @throws BadInput for an unknown one
std::set<OutputFile> parse_files(const std::string& text);

/// The keys of the section.
void declare_output(Keys& keys, OutputOptions& output, UnitNames& names);

} // namespace rollwave
