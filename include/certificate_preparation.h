#ifndef ROLLWAVE_CERTIFICATE_PREPARATION_H
#define ROLLWAVE_CERTIFICATE_PREPARATION_H

#include "task_beside.h"
#include "work.h"

namespace rollwave {

struct Parameters;
struct Scene;
struct Solution;

/// Whether it gains time, and leaves enough memory to solve @p scene directly, to prepare the
/// certificate at once.
bool gains_by_preparing(const Scene& scene, const Parameters& parameters, const Solution& solution);

/// Prepares a certificate while the scene is solved. Its parts of the MeshSystem and the solver's
/// are different ones; the load, which both read, is there before.
class CertificatePreparation {
public:
  CertificatePreparation(const Scene& scene, Solution& solution);

  /// @throws as prepare_certificate(), but leaves what lacked memory to certify()
  void finish();

private:
  Solution& solution;
  Work work;
  TaskBeside task;
};

} // namespace rollwave

#endif
