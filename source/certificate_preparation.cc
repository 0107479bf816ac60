#include "certificate_preparation.h"

#include "certificate_parts.h"
#include "errors.h"
#include "memory.h"
#include "parameters.h"
#include "solution.h"

namespace rollwave {

bool gains_by_preparing(const Scene& scene, const Parameters& parameters,
                        const Solution& solution) {
  const double n = solution.space->n_unknowns(), m = solution.space->contact_nodes().size();
  const double bytes = 4 * (1024 * n + sizeof(double) * m * m); // twice what both take
  return parameters.solver.kind != SolverKind::iterative &&
         solution.system.stiffness.kind != SolverKind::iterative &&
         !is_certificate_prepared(scene, solution.system) && gains_by_threads() &&
         bytes < available_memory();
}

CertificatePreparation::CertificatePreparation(const Scene& scene, Solution& solution)
    : solution(solution), task(true, [this, &scene, &solution] {
        prepare_certificate(*solution.space, scene, SolverKind::direct, solution.system, work);
      }) {}

void CertificatePreparation::finish() {
  const Work::Phase phase(solution.result.work, "certificate");
  try {
    task.finish();
  } catch (const NotEnoughMemory&) {
    solution.system.potential.reset();
  }
  solution.result.work.add_counts(work);
}

} // namespace rollwave
