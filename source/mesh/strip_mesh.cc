#include "rollwave/mesh/strip_mesh.h"

#include "rollwave/base/mpi_processes.h"
#include "rollwave/mesh/boundary_id.h"

#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/grid/tria_iterator.h>

#include <cstdint>

namespace rollwave {

using namespace dealii;

namespace {

/// What a process knows of a column of cells.
enum class View { none, artificial, relevant };

/// The process that has a column.
struct Shares {
  std::uint64_t n_columns, n_processes;

  std::uint64_t begin(std::uint64_t process) const { return process * n_columns / n_processes; }

  types::subdomain_id owner(std::uint64_t column) const {
    return ((column + 1) * n_processes - 1) / n_columns;
  }
};

/// The own columns and those beside them are relevant, also across the seam. The cells beyond are
/// there as well, so that no face of a relevant cell looks like a boundary.
std::vector<View> views_of(unsigned int process, const Shares& shares) {
  const int n = shares.n_columns, begin = shares.begin(process), end = shares.begin(process + 1);
  std::vector<View> views(n, View::none);
  if (begin == end)
    return views;
  for (const int column : {begin - 2, end + 1})
    views[(column + n) % n] = View::artificial;
  for (int column = begin - 1; column <= end; ++column)
    views[(column + n) % n] = View::relevant;
  return views;
}

/// deal.II's class would be given what a process has of the mesh as a description. It sorts the
/// cells of that twice and looks their numbers up in a map, which takes longer than all else: here
/// they are made in order, and rows and columns tell their numbers.
class StripMesh : public parallel::fullydistributed::Triangulation<2> {
public:
  StripMesh(const std::vector<double>& radii, const std::vector<double>& angles,
            MPI_Comm communicator)
      : parallel::fullydistributed::Triangulation<2>(communicator),
        n_rows(radii.size() - 1), shares{angles.size() - 1, count_processes(communicator)},
        views(views_of(process_number(communicator), shares)) {
    for (unsigned int column = 0; column < views.size(); ++column) {
      first_cell.push_back(n_rows * columns.size());
      if (views[column] != View::none)
        columns.push_back(column);
    }
    create_cells(radii, angles);
    hand_out();
    // That of deal.II's class is private, and adds to this one's the number of coarse cells only.
    parallel::TriangulationBase<2>::update_number_cache();
    number_cache.number_of_global_coarse_cells = types::coarse_cell_id(n_rows) * views.size();
  }

private:
  /// The columns in view, one after another; columns next to each other share their vertices. A
  /// process that has none gets a cell that is nobody's, since deal.II wants one.
  void create_cells(const std::vector<double>& radii, const std::vector<double>& angles) {
    const unsigned int n_radii = radii.size();
    std::vector<Point<2>> vertices;
    const auto append_vertices = [&](double angle) {
      for (const double r : radii)
        vertices.emplace_back(r, angle);
    };
    std::vector<CellData<2>> cells;
    const auto append_cell = [&](unsigned int row) {
      const unsigned int high = vertices.size() - n_radii + row, low = high - n_radii;
      cells.emplace_back();
      cells.back().vertices = {low, low + 1, high, high + 1};
    };
    for (const unsigned int column : columns) {
      if (column == 0 || views[column - 1] == View::none)
        append_vertices(angles[column]);
      append_vertices(angles[column + 1]);
      for (unsigned int row = 0; row < n_rows; ++row)
        append_cell(row);
    }
    if (columns.empty()) {
      append_vertices(angles[0]);
      append_vertices(angles[1]);
      append_cell(0);
    }
    dealii::Triangulation<2>::create_triangulation(vertices, cells, SubCellData());
  }

  /// Who has which cell, and the ids of the boundary.
  void hand_out() {
    const bool has_both_ends = views.front() != View::none && views.back() != View::none;
    for (const auto& cell : active_cell_iterators()) {
      cell->set_subdomain_id(numbers::artificial_subdomain_id);
      if (columns.empty())
        return;
      const unsigned int row = cell->index() % n_rows, column = columns[cell->index() / n_rows];
      if (views[column] == View::relevant)
        cell->set_subdomain_id(shares.owner(column));
      if (row == 0)
        cell->face(0)->set_boundary_id(hub_id);
      if (row == n_rows - 1)
        cell->face(1)->set_boundary_id(surface_id);
      if (column == 0)
        cell->face(2)->set_boundary_id(has_both_ends ? seam_begin_id : unpaired_seam_id);
      if (column == views.size() - 1)
        cell->face(3)->set_boundary_id(has_both_ends ? seam_end_id : unpaired_seam_id);
    }
  }

  unsigned int coarse_cell_id_to_coarse_cell_index(types::coarse_cell_id id) const override {
    const unsigned int column = id / n_rows;
    return views[column] == View::none ? numbers::invalid_unsigned_int
                                       : first_cell[column] + id % n_rows;
  }

  types::coarse_cell_id coarse_cell_index_to_coarse_cell_id(unsigned int index) const override {
    if (columns.empty())
      return numbers::invalid_coarse_cell_id;
    return types::coarse_cell_id(columns[index / n_rows]) * n_rows + index % n_rows;
  }

  const unsigned int n_rows;
  const Shares shares;
  const std::vector<View> views;        ///< of each column
  std::vector<unsigned int> columns;    ///< those in view
  std::vector<unsigned int> first_cell; ///< its index, for each column
};

} // namespace

std::unique_ptr<Triangulation<2>> make_strip_mesh(const std::vector<double>& radii,
                                                  const std::vector<double>& angles,
                                                  MPI_Comm communicator) {
  return std::make_unique<StripMesh>(radii, angles, communicator);
}

} // namespace rollwave
