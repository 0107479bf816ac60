#pragma once

#include <iosfwd>

namespace rollwave {

/// Prints all quantities of a result as a table in Markdown.
void print_quantities(std::ostream& out);

} // namespace rollwave
