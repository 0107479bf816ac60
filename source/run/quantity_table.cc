#include "rollwave/run/quantity_table.h"

#include "rollwave/run/quantities.h"
#include "rollwave/scene/units.h"

#include <ostream>
#include <utility>

namespace rollwave {

void print_quantities(std::ostream& out) {
  Units units; // whose names are the dimensions
  units.material.unit_names = {"length", "time", "force"};
  out << "Every number is in summary.json and study.csv. The heading of its column in tables is "
         "the\n"
         "symbol or, without one, the meaning. Shown: screen (a line under Result; contact ends,\n"
         "bounds, residuals, mesh and seconds are on the screen too), study.txt, the table of "
         "orders,\n"
         "or study-curves.svg (curves).\n\n"
         "| name | meaning | symbol | unit | shown |\n|---|---|---|---|---|\n";
  for (const ResultQuantity& quantity : result_quantities()) {
    out << "| `" << quantity.name << "` | " << quantity.words << " | " << quantity.symbol << " | "
        << units.unit(quantity.quantity).name << " |";
    const char* separator = " ";
    for (const auto& [flag, place] : {std::pair(Shown::screen, "screen"),
                                      {Shown::table, "study.txt of meshes or methods"},
                                      {Shown::scene_table, "study.txt of scenes"},
                                      {Shown::orders, "orders"},
                                      {Shown::curve, "curves"}})
      if (quantity.shown & flag) {
        out << separator << place;
        separator = ", ";
      }
    out << " |\n";
  }
}

} // namespace rollwave
