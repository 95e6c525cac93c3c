// SPDX-License-Identifier: MIT
// Forces as a regression of accelerations finds them, in a recording and in simulations alike (libswarm/force_regression.h).
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "libtrack/nan.h"

namespace swarmfit {

// Where curves are read off, set by the recording.
struct ForceGrid {
  std::vector<double> speeds;     // [unit/s]
  std::vector<double> distances;  // from the centre [unit]
  std::vector<double> pairs;      // between two individuals [unit]; empty: there is one individual
};

// NaN where there was too little to see.
struct ForceCurves {
  std::vector<double> drag;         // per speed [1/s]
  std::vector<double> confinement;  // per distance from the centre: stiffness [1/s²]
  std::vector<double> attraction;   // per distance of a pair: acceleration towards the other, negative away from it [unit/s²]
  std::vector<double> alignment;    // per distance of a pair: by which the difference of velocities becomes an acceleration [1/s]
  std::vector<double> noise;        // three numbers: strength of white noise [unit/s^1.5], of noise with a memory [unit/s²], and that [s]
};
inline auto fields(ForceCurves& c) { return std::tie(c.drag, c.confinement, c.attraction, c.alignment, c.noise); }

struct ForceFacts {
  ForceGrid grid;
  ForceCurves recording, se;                       // standard errors
  std::vector<std::string> needed;                 // groups of terms that the recording needs beside drag and confinement, in words
  double attraction_p = kNaN, alignment_p = kNaN;  // could there be none, beside what is needed?
};

// Of a model: median over some of its final replicates, and 1.4826 times the median distance from it.
struct ForceSpread {
  ForceCurves median, sd;
};

}  // namespace swarmfit
