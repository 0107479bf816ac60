// The cost of a run: the whole contact solve compared with one factorisation and solve of the same
// matrix, in turn; the seconds of each phase and the peak memory on meshes from 1e3 to 1e6
// unknowns. Tables in Markdown.
#include "rollwave/base/memory.h"
#include "rollwave/run/solve_on_mesh.h"
#include "rollwave/solver/assembly.h"
#include "test_scenes.h"

#include <deal.II/base/timer.h>

#include <cholmod.h>

#include <algorithm>
#include <cstdio>

using namespace rollwave;

namespace {

/// CHOLMOD as it is by default, with its own approximate minimum degree ordering: summing up the
/// triplets, ordering, analysis, factorisation and one solve.
double plain_seconds(int n, const LowerTriplets& triplets) {
  const dealii::Timer timer;
  cholmod_common common;
  cholmod_start(&common);
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_AMD;
  cholmod_triplet view = {};
  view.nrow = view.ncol = n;
  view.nnz = view.nzmax = triplets.values.size();
  view.i = const_cast<int*>(triplets.rows.data());
  view.j = const_cast<int*>(triplets.columns.data());
  view.x = const_cast<double*>(triplets.values.data());
  view.stype = -1;
  view.xtype = CHOLMOD_REAL;
  cholmod_sparse* matrix = cholmod_triplet_to_sparse(&view, 0, &common);
  cholmod_factor* factor = cholmod_analyze(matrix, &common);
  cholmod_factorize(matrix, factor, &common);
  cholmod_dense* rhs = cholmod_ones(n, 1, CHOLMOD_REAL, &common);
  cholmod_dense* solution = cholmod_solve(CHOLMOD_A, factor, rhs, &common);
  const double seconds = timer.wall_time();
  cholmod_free_dense(&rhs, &common);
  cholmod_free_dense(&solution, &common);
  cholmod_free_factor(&factor, &common);
  cholmod_free_sparse(&matrix, &common);
  cholmod_finish(&common);
  return seconds;
}

/// Everything from ordering and triplets to the displacement field, without assembly.
double contact_seconds(const Scene& scene, const Parameters& parameters) {
  // Made anew, so that the time includes the order of elimination.
  const MeshAndSpace ring(scene, parameters);
  RunStatistics statistics;
  const MeshObjects objects = {make_system(ring.space, scene, scene.zone(), statistics)};
  solve_on_mesh(objects, scene, parameters.contact, {}, statistics);
  return statistics.total_seconds() - statistics.seconds("assembly").value_or(0);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void benchmark_contact(const PaperScene& paper, const std::vector<std::string>& mesh) {
  const Parameters parameters = with(paper.parameters(), mesh);
  const Scene scene = make_scene(parameters);
  const MeshAndSpace ring(scene, parameters);
  const SystemMatrix matrix = assemble_stiffness(ring.space, scene);
  const LowerTriplets& triplets = matrix.entries();
  std::vector<double> plain, contact, ratio;
  for (int run = 0; run < 5; ++run) {
    plain.push_back(plain_seconds(ring.space.n_unknowns(), triplets));
    contact.push_back(contact_seconds(scene, parameters));
    ratio.push_back(contact.back() / plain.back());
  }
  std::printf("| %d | %u | %u | %.4f | %.4f | %.2f |\n", paper.figure, parameters.mesh.degree,
              ring.space.n_unknowns(), median(plain), median(contact), median(ratio));
  std::fflush(stdout);
}

void benchmark_phases(const PaperScene& paper, const std::vector<std::string>& mesh) {
  const Parameters parameters = with(paper.parameters(), mesh);
  const Result result = simulate(make_scene(parameters), parameters).result;
  std::printf("| %d | %u | %u |", paper.figure, parameters.mesh.degree, result.mesh.n_unknowns);
  for (const std::string& phase : RunStatistics::phase_names())
    if (const auto seconds = result.statistics.seconds(phase))
      std::printf(" %s %.3g,", phase.c_str(), *seconds);
  std::printf(" | %.3g | %.0f |\n", result.statistics.total_seconds(), peak_memory_mib());
  std::fflush(stdout);
}

/// @p cells of degree 1, radial and angular; half as many of degree 2
std::vector<std::string> uniform(int degree, std::pair<int, int> cells) {
  return {"Mesh/Degree=" + std::to_string(degree),
          "Mesh/Radial cells=" + std::to_string(cells.first / degree),
          "Mesh/Angular cells=" + std::to_string(cells.second / degree)};
}

} // namespace

int main() {
  const std::vector<std::pair<int, int>> meshes = {{10, 110}, {28, 352}, {88, 1112}, {282, 3544}};
  std::printf("Medians of 5 runs, seconds without assembly\n\n| figure | degree | unknowns | plain "
              "[s] | contact [s] | ratio |\n|---|---|---|---|---|---|\n");
  for (const int figure : {0, 1})
    for (const int degree : {1, 2})
      for (const auto& cells : meshes)
        benchmark_contact(paper_scenes()[figure], uniform(degree, cells));
  std::printf(
      "\nUniform and adaptive meshes\n\n| figure | degree | unknowns | seconds of each phase "
      "| all [s] | peak so far [MiB] |\n|---|---|---|---|---|---|\n");
  for (const auto& cells : meshes)
    for (const int figure : {0, 1})
      for (const int degree : {2, 1})
        benchmark_phases(paper_scenes()[figure], uniform(degree, cells));
  for (const int figure : {0, 1})
    for (const char* degree : {"Mesh/Degree=1", "Mesh/Degree=2"})
      benchmark_phases(paper_scenes()[figure],
                       {degree, "Mesh/Radial cells=4", "Mesh/Angular cells=48",
                        "Mesh/Adaptive cycles=1000", "Mesh/Most unknowns=100000"});
}
