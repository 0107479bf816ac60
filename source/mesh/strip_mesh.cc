#include "rollwave/mesh/strip_mesh.h"

#include "rollwave/base/mpi_processes.h"
#include "rollwave/mesh/boundary_id.h"

#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/grid/cell_id.h>
#include <deal.II/grid/tria_description.h>

#include <cstdint>
#include <map>

namespace rollwave {

using namespace dealii;

namespace {

/// The columns that a process sees with their owners: its own and those beside it, over the seam as
/// well. Those beyond are nobody's, and there so that no face of the others looks like a boundary.
std::map<int, types::subdomain_id> columns_in_view(std::int64_t n_columns, MPI_Comm communicator) {
  const std::int64_t n_processes = count_processes(communicator),
                     process = process_number(communicator);
  const int begin = process * n_columns / n_processes,
            end = (process + 1) * n_columns / n_processes;
  std::map<int, types::subdomain_id> owners;
  if (begin == end)
    return owners;
  for (int column = begin - 1; column <= end; ++column) {
    const std::int64_t wrapped = (column + n_columns) % n_columns;
    owners[wrapped] = ((wrapped + 1) * n_processes - 1) / n_columns;
  }
  for (const int column : {begin - 2, end + 1})
    owners.emplace((column + n_columns) % n_columns, numbers::artificial_subdomain_id);
  return owners;
}

} // namespace

std::unique_ptr<Triangulation<2>> make_strip_mesh(const std::vector<double>& radii,
                                                  const std::vector<double>& angles,
                                                  MPI_Comm communicator) {
  const unsigned int n_rows = radii.size() - 1, n_columns = angles.size() - 1;
  const auto owners = columns_in_view(n_columns, communicator);
  const bool has_both_ends = owners.count(0) > 0 && owners.count(n_columns - 1) > 0;

  TriangulationDescription::Description<2, 2> strip;
  strip.comm = communicator;
  strip.settings = TriangulationDescription::default_setting;
  strip.smoothing = Triangulation<2>::none;
  strip.cell_infos.resize(1);
  std::map<unsigned int, unsigned int> first_vertex; // of those at an angle
  const auto vertices_at = [&](unsigned int angle) {
    const auto [place, is_new] = first_vertex.emplace(angle, strip.coarse_cell_vertices.size());
    if (is_new)
      for (const double r : radii)
        strip.coarse_cell_vertices.emplace_back(r, angles[angle]);
    return place->second;
  };
  for (const auto& [column, owner] : owners) {
    const unsigned int low = vertices_at(column), high = vertices_at(column + 1);
    for (unsigned int row = 0; row < n_rows; ++row) {
      const auto number = types::coarse_cell_id(column) * n_rows + row;
      strip.coarse_cell_index_to_coarse_cell_id.push_back(number);
      strip.coarse_cells.emplace_back();
      strip.coarse_cells.back().vertices = {low + row, low + row + 1, high + row, high + row + 1};

      TriangulationDescription::CellData<2> cell = {};
      cell.id = CellId(number, std::vector<std::uint8_t>()).to_binary<2>();
      cell.subdomain_id = cell.level_subdomain_id = owner;
      cell.manifold_id = numbers::flat_manifold_id;
      cell.manifold_line_ids.fill(numbers::flat_manifold_id);
      if (row == 0)
        cell.boundary_ids.emplace_back(0, hub_id);
      if (row == n_rows - 1)
        cell.boundary_ids.emplace_back(1, surface_id);
      if (column == 0)
        cell.boundary_ids.emplace_back(2, has_both_ends ? seam_begin_id : unpaired_seam_id);
      if (column + 1U == n_columns)
        cell.boundary_ids.emplace_back(3, has_both_ends ? seam_end_id : unpaired_seam_id);
      strip.cell_infos[0].push_back(cell);
    }
  }
  auto mesh = std::make_unique<parallel::fullydistributed::Triangulation<2>>(communicator);
  mesh->create_triangulation(strip);
  return mesh;
}

} // namespace rollwave
