// SPDX-License-Identifier: MIT
// What is seen of a group only over many moments: functions of distance or of the time between two moments, and where neighbours are.
#pragma once

#include <string>
#include <vector>

#include "libeval/group/moment.h"

namespace swarmfit {

// A curve with standard errors: by the jackknife over eight blocks of time (NaN where a block cannot be left out) unless its maker says
// otherwise.
struct GroupCurve {
  std::string key, name;         // in files, in words
  std::string x_name;            // "distance", "time"
  int x_length = 0, x_time = 0;  // units as powers of length and time
  int y_length = 0, y_time = 0;
  std::vector<double> x, y, se;
};

// Nearest neighbours as their focal individual sees them: counts per square of a map, over the mean count.
struct NeighbourMap {
  int side = 0;                 // squares per side
  double reach = 0;             // half the side of the map [unit]
  std::vector<double> density;  // side × side, row by row from behind to ahead, within a row from left to right; 1: as if even
  double counted = 0;           // neighbours on the map
  double ahead = 0, left = 0;   // share ahead of the focal individual, and to its left (plane only; in space NaN)
};

struct GroupCurves {
  // g_r                 pairs at a distance, over those of as many points spread evenly over the ellipse (ellipsoid) with the covariance of
  //                     all places about their centroids; uniform cloud: 1
  // fluctuation_corr    C(r): mean u_i·u_j of pairs at that distance over mean u², u: velocity less the frame's mean; Cavagna et al. 2010,
  //                     doi:10.1073/pnas.1005766107
  // radial_force        mean acceleration away from the centroid, against the distance from it; harmonic trap: −k r
  // vacf, msd           of the panel (libeval/panel.h), here with the panel's errors
  std::vector<GroupCurve> curves;
  NeighbourMap map;
  double correlation_length = 0, correlation_length_se = 0;  // first zero of C(r) [unit]; NaN if there is none
};

// `kind` as in MomentOptions. Curves that cannot be had are left out: a group of one has no distances.
GroupCurves group_curves(const Tracks& tracks, const MomentOptions& options);

}  // namespace swarmfit
