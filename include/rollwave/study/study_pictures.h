#pragma once

#include "rollwave/base/written_files.h"
#include "rollwave/study/study.h"

#include <vector>

namespace rollwave {

/// For each run the value of the key that varies fastest. Empty if no key varies or a value is not
/// a number.
std::vector<double> fastest_numbers(const Study& study);

/// The names of all pictures of draw_study().
constexpr const char* study_picture_names[] = {"study-curves", "study-profiles", "study-map",
                                               "study-h",      "study-unknowns", "study-time",
                                               "study"};

/**
 * Draws the pictures that a study has data for, each with its gnuplot script:
 *
 * - study-curves.svg: the main result over the key of the scene that varies fastest: the shear
 *   modulus of calibrations, the deflection for a given load or nip, otherwise the vertical load.
 *   Where distance, load or nip varies fastest without a calibration, it is the vertical load over
 *   the deflection. Then force, stiffness, peak pressure, half-width and contact length over that
 *   key;
 * - study-profiles.svg: pressures along the road;
 * - study-map.svg: the main result over two keys of the scene with more values than curves can
 *   show;
 * - study-h.svg, study-unknowns.svg and study-time.svg: the true relative error in the energy norm
 *   or, if it is not known, its bound, over h, unknowns and seconds;
 * - study.svg: contact steps on uniform meshes over the key that varies fastest, if that is a
 *   number and one of mesh or method, or published steps are given.
 *
 * @throws NotWritten
 */
void draw_study(const Parameters& parameters, const Study& study, WrittenFiles& written);

} // namespace rollwave
