// What contact costs: the time of the whole contact solve over that of one plain factorisation and
// solve of the same matrix, both measured in turn in one run. Assembly is left out of both. And
// what the indicator and the certificate cost beside the solve, with its assembly, on the same
// mesh.
#include "rollwave/adapt/residual_indicator.h"
#include "rollwave/contact/active_set.h"
#include "rollwave/error_bound/error_bound.h"
#include "rollwave/run/solve_on_mesh.h"
#include "rollwave/solver/cholmod_assembly.h"
#include "test_scenes.h"

#include <deal.II/base/timer.h>

#include <cholmod.h>

#include <algorithm>
#include <cstdio>
#include <tuple>

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

/// Everything from ordering and triplets to the displacement field; @p steps is set to the contact
/// steps.
double contact_seconds(const Scene& scene, const Parameters& parameters, std::size_t& steps) {
  const Discretisation ring(scene, parameters); // whose order of elimination is yet to be found
  Work work;
  const dealii::Timer timer;
  DirectSolver solver(ring.space);
  solver.turn_to(scene, {}, work);
  const ContactSolution contact = active_set(solver, make_contact_problem(ring.space, scene), 100);
  const FieldVector field = solver.displacement_field(contact.state);
  const double seconds = timer.wall_time();
  steps = contact.history.size();
  for (const auto& [phase, phase_seconds] : work.seconds())
    if (phase == "assembly")
      return seconds - phase_seconds;
  return seconds;
}

/// The numbers of the unknowns in the order of the degrees of freedom.
std::vector<int> number_plainly(const RingSpace& space) {
  std::vector<int> unknown_of_dof(space.dof_handler().n_dofs(), -1);
  int unknown = 0;
  for (unsigned int dof = 0; dof < unknown_of_dof.size(); ++dof)
    if (!space.constraints().is_constrained(dof))
      unknown_of_dof[dof] = unknown++;
  return unknown_of_dof;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void benchmark(const PaperScene& paper, int degree, int radial_cells, int angular_cells) {
  const Parameters parameters =
      with(paper.parameters(), {"Mesh/Degree=" + std::to_string(degree),
                                "Mesh/Radial cells=" + std::to_string(radial_cells),
                                "Mesh/Angular cells=" + std::to_string(angular_cells)});
  const Scene scene = make_scene(parameters);
  const Discretisation ring(scene, parameters);
  const int n = ring.space.n_unknowns();
  // The minimum degree ordering depends on the order it is given.
  const LowerTriplets triplets = assemble_triplets(ring.space, scene, number_plainly(ring.space));

  std::vector<double> plain, contact, ratio;
  std::size_t steps = 0;
  for (int run = 0; run < 5; ++run) {
    plain.push_back(plain_seconds(n, triplets));
    contact.push_back(contact_seconds(scene, parameters, steps));
    ratio.push_back(contact.back() / plain.back());
  }
  std::printf("%6d %6d %9d %13zu %13zu %10.4f %10.4f %8.3f\n", paper.figure, degree, n,
              ring.space.contact_nodes().size(), steps, median(plain), median(contact),
              median(ratio));
  std::fflush(stdout);
}

/// The seconds of indicator and certificate over those of the solve.
void benchmark_errors(const PaperScene& paper, const char* mesh,
                      const std::vector<std::string>& settings) {
  const Parameters parameters = with(paper.parameters(), settings);
  const Scene scene = make_scene(parameters);
  const Solution solved = simulate(scene, parameters);
  std::vector<double> solve, indicator, certificate;
  const int n_runs = solved.result.mesh.dofs < 20000 ? 25 : 5;
  for (int run = 0; run < n_runs; ++run) {
    Work work;
    const dealii::Timer timer;
    const RingSpace space(*solved.triangulation, scene, parameters.mesh.degree);
    MeshCache system;
    const MeshSolution solution = solve_on_mesh(scene, parameters, space, {}, system, work);
    solve.push_back(timer.wall_time());
    residual_indicator(space, scene, solution.problem, solution.contact, solution.displacement);
    indicator.push_back((timer.wall_time() - solve.back()) / solve.back());
    certify(space, scene, solution.problem, solution.contact, solution.displacement, system.load,
            system.dual_of(scene, space, work), work);
    certificate.push_back((timer.wall_time() - solve.back()) / solve.back() - indicator.back());
  }
  std::printf("%6d %6d %9s %9u %10.4f %10.2f %12.2f  %s\n", paper.figure, parameters.mesh.degree,
              mesh, solved.result.mesh.dofs, median(solve), median(indicator), median(certificate),
              parameters.cylinder.radial_force.c_str());
  std::fflush(stdout);
}

} // namespace

int main() {
  std::printf(
      "Medians of 5 runs; seconds without assembly.\n"
      "figure degree  unknowns contact nodes contact steps  plain [s] contact[s]    ratio\n");
  for (const PaperScene& paper : {paper_scenes()[0], paper_scenes()[1]}) {
    benchmark(paper, 1, 28, 352);
    benchmark(paper, 1, 88, 1112);
    benchmark(paper, 1, 282, 3544);
    benchmark(paper, 2, 14, 176);
    benchmark(paper, 2, 44, 556);
    benchmark(paper, 2, 141, 1772);
  }
  std::printf(
      "\nMedians of 5 runs, of 25 below 20000 unknowns; solve from the degrees of freedom to "
      "the displacement, the others over it.\n"
      "figure degree      mesh  unknowns  solve [s]  indicator  certificate  force\n");
  for (const int figure : {0, 1, 2}) {
    const PaperScene& paper = paper_scenes()[figure];
    benchmark_errors(paper, "uniform",
                     {"Mesh/Degree=1", "Mesh/Radial cells=88", "Mesh/Angular cells=1112"});
    benchmark_errors(paper, "uniform",
                     {"Mesh/Degree=2", "Mesh/Radial cells=44", "Mesh/Angular cells=556"});
    for (const char* degree : {"Mesh/Degree=1", "Mesh/Degree=2"})
      benchmark_errors(paper, "adaptive",
                       {degree, "Mesh/Radial cells=4", "Mesh/Angular cells=48",
                        "Mesh/Adaptive cycles=1000", "Mesh/Most unknowns=60000"});
  }
  // Expressions: smooth, with a jump on a circle, around a spot, along a curve.
  for (const char* force : {"1+0.5*r*cos(z)", "if(r<0.7123,1,0)", "if((r-0.7)^2+(z-3)^2<0.01,1,0)",
                            "if(r<0.7+0.1*sin(3*z),1,0)"}) {
    const std::string key = std::string("Cylinder/Radial force=") + force;
    for (const auto& [degree, radial, angular] :
         {std::tuple(1, 9, 112), std::tuple(2, 4, 56), std::tuple(1, 28, 352),
          std::tuple(2, 14, 176), std::tuple(1, 88, 1112), std::tuple(2, 44, 556)})
      benchmark_errors(paper_scenes()[0], "uniform",
                       {key, "Mesh/Degree=" + std::to_string(degree),
                        "Mesh/Radial cells=" + std::to_string(radial),
                        "Mesh/Angular cells=" + std::to_string(angular)});
    for (const char* degree : {"Mesh/Degree=1", "Mesh/Degree=2"})
      benchmark_errors(paper_scenes()[0], "adaptive",
                       {key, degree, "Mesh/Radial cells=4", "Mesh/Angular cells=48",
                        "Mesh/Adaptive cycles=1000", "Mesh/Most unknowns=60000"});
  }
}
