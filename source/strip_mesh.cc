#include "strip_mesh.h"

#include "boundary_id.h"
#include "processes.h"

#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/grid/cell_id.h>
#include <deal.II/grid/tria_description.h>

#include <cstdint>

namespace rollwave {

using namespace dealii;

namespace {

using Description = TriangulationDescription::Description<2, 2>;

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

/// The columns in view, one after another; columns next to each other share their vertices.
Description describe(const std::vector<double>& radii, const std::vector<double>& angles,
                     const Shares& shares, const std::vector<View>& views, MPI_Comm communicator) {
  const unsigned int n_radii = radii.size(), n_rows = n_radii - 1, n_columns = views.size();
  const bool has_both_ends = views.front() != View::none && views.back() != View::none;
  Description description;
  description.comm = communicator;
  description.settings = TriangulationDescription::default_setting;
  description.smoothing = Triangulation<2>::none;
  description.cell_infos.resize(1);
  auto& vertices = description.coarse_cell_vertices;
  const auto append_vertices = [&](double angle) {
    for (const double r : radii)
      vertices.emplace_back(r, angle);
  };

  TriangulationDescription::CellData<2> info;
  info.manifold_id = numbers::flat_manifold_id;
  info.manifold_line_ids.fill(numbers::flat_manifold_id);
  info.manifold_quad_ids.fill(numbers::flat_manifold_id);
  CellData<2> cell;
  for (unsigned int column = 0; column < n_columns; ++column) {
    if (views[column] == View::none)
      continue;
    if (column == 0 || views[column - 1] == View::none)
      append_vertices(angles[column]);
    append_vertices(angles[column + 1]);
    info.subdomain_id =
        views[column] == View::relevant ? shares.owner(column) : numbers::artificial_subdomain_id;
    info.level_subdomain_id = info.subdomain_id;
    for (unsigned int row = 0; row < n_rows; ++row) {
      const unsigned int high = vertices.size() - n_radii + row, low = high - n_radii;
      cell.vertices = {low, low + 1, high, high + 1};
      description.coarse_cells.push_back(cell);
      const types::coarse_cell_id id = types::coarse_cell_id(column) * n_rows + row;
      description.coarse_cell_index_to_coarse_cell_id.push_back(id);
      info.id = CellId(id, std::vector<std::uint8_t>()).to_binary<2>();
      info.boundary_ids.clear();
      if (row == 0)
        info.boundary_ids.emplace_back(0, hub_id);
      if (row == n_rows - 1)
        info.boundary_ids.emplace_back(1, surface_id);
      if (column == 0)
        info.boundary_ids.emplace_back(2, has_both_ends ? seam_begin_id : unpaired_seam_id);
      if (column == n_columns - 1)
        info.boundary_ids.emplace_back(3, has_both_ends ? seam_end_id : unpaired_seam_id);
      description.cell_infos[0].push_back(info);
    }
  }
  return description;
}

/// Finds a cell by its number at once. deal.II's class searches, twice for each comparison when it
/// sorts the cells, which takes longer than all else.
class StripMesh : public parallel::fullydistributed::Triangulation<2> {
public:
  StripMesh(unsigned int n_rows, const std::vector<View>& views, MPI_Comm communicator)
      : parallel::fullydistributed::Triangulation<2>(communicator), n_rows(n_rows) {
    unsigned int n_cells = 0;
    for (const View view : views) {
      first_cell.push_back(n_cells);
      n_cells += view == View::none ? 0 : n_rows;
    }
  }

private:
  unsigned int coarse_cell_id_to_coarse_cell_index(types::coarse_cell_id id) const override {
    return first_cell[id / n_rows] + id % n_rows;
  }

  const unsigned int n_rows;
  std::vector<unsigned int> first_cell; ///< its index, for each column
};

} // namespace

std::unique_ptr<Triangulation<2>> make_strip_mesh(const std::vector<double>& radii,
                                                  const std::vector<double>& angles,
                                                  MPI_Comm communicator) {
  const Shares shares = {angles.size() - 1, count_processes(communicator)};
  const std::vector<View> views = views_of(process_number(communicator), shares);
  auto mesh = std::make_unique<StripMesh>(radii.size() - 1, views, communicator);
  mesh->create_triangulation(describe(radii, angles, shares, views, communicator));
  return mesh;
}

} // namespace rollwave
