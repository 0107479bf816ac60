// A program that loads deal.II and does nothing: what starting costs at least.
#include <deal.II/grid/tria.h>

int main() {
  return dealii::Triangulation<2>().n_levels();
}
