// SPDX-License-Identifier: MIT
// Observables that no score sees: whether a model that was fitted to a few frames of motion also gets the seconds and the group right. And
// two means that a score sees only as distributions: whether it gets wrong what anybody sees.
#pragma once

#include <string>
#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

// One number of the panel.
struct PanelItem {
  std::string key;   // in tables and JSON
  std::string name;  // in words
  int length, time;  // unit as powers of length and time
};

// What is measured, and at which lags: set by the recording, so that simulations are measured alike.
//   sd_x, sd_y, sd_z      extent: standard deviation of positions about the frame's centroid (frames with two or more)
//   speed                 mean length of a step over its time, the motion of the group included
//   vacf_zero             first zero of the velocity autocorrelation <v(t)·v(t+τ)>/<v²>, interpolated; NaN if it has none
//   msd_τs                mean squared displacement after τ: 1/8, 1/4, 1/2 and 1 s (1, 2, 4, 8 frames if the frames are sparse)
//   group_msd_τs          the same of the group as a whole (group_path), after the longest of these: does it stay where it is?
//   k_x, k_y, k_z         effective force: minus the slope of acceleration (second difference) against the place relative to the centroid,
//                         least squares; localisation error σ adds 2σ²/(dt² Var x)
//   polarisation          mean over frames of |mean heading|
//   nearest               mean distance to the nearest other
//   nearest_ratio         the same over that of a Poisson process of the same density: 0.554 ρ^(-1/3) in 3-D,
//                         ρ^(-1/2)/2 in 2-D; ρ is the number in the frame over the volume of the uniform ellipsoid (ellipse) with the
//                         covariance of all positions about their centroids. A uniform cloud of a few dozen lies a few per cent above 1,
//                         since those on its surface have neighbours on one side only.
//   kurtosis              of the components of acceleration, mean over axes; 3 if normal
// All other velocities and displacements are relative to the motion of the group (group_path).
struct PanelPlan {
  int dims = 3;
  double dt = 0;                 // [s]
  std::vector<Index> vacf_lags;  // [frames], ascending from 0, every lag 12 % beyond the one before, up to a quarter of the recording
  std::vector<Index> msd_lags;   // [frames]
  std::vector<PanelItem> items() const;
};
PanelPlan panel_plan(const Tracks& recording);

struct Panel {
  std::vector<double> values;  // one per item; NaN: undefined
  std::vector<double> vacf;    // one per lag; 1 at lag 0
};
Panel panel(const Tracks& tracks, const PanelPlan& plan);

// The panel of one recording with standard errors: jackknife over eight blocks of time (Quenouille 1956, Tukey 1958). NaN where a block
// cannot be left out.
struct PanelEstimate {
  Panel value, se;
};
PanelEstimate panel_with_error(const Tracks& tracks, const PanelPlan& plan);

}  // namespace swarmfit
