#pragma once

#include "rollwave/output/output_directory.h"
#include "rollwave/study/study_record.h"

namespace rollwave {

/**
 * Writes, next to the tables of run_study(), study.txt and study.tex (a table for the screen and
 * for LaTeX), study.pvd (the fields of the runs, where they are written) and plots, each with its
 * gnuplot script:
 *
 * - study-curves.svg: loads, stiffness, half-width and peak pressure over the key that varies
 *   fastest, where that is a number of the scene, study-profiles.svg: pressures along the surface,
 *   study-map.svg: the vertical load over two such keys;
 * - study-h.svg, study-unknowns.svg and study-time.svg: the true relative error in the energy norm
 *   over h, unknowns and seconds;
 * - study.svg: contact steps on uniform meshes over the key that varies fastest, where that is a
 *   number and the steps of the runs differ.
 *
 * @throws NotWritten
 */
WrittenFiles write_study(const Parameters& parameters, const Study& study);

} // namespace rollwave
