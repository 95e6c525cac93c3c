// SPDX-License-Identifier: MIT
// How a shepherd brings a flock home: measured from trajectories, simulated or recorded.
#pragma once

#include <cstdint>
#include <optional>

#include "libtrack/nan.h"
#include "libtrack/tracks.h"

namespace swarmfit {

struct HerdingOptions {
  std::uint8_t sheep = 0, shepherd = 1;       // kinds
  std::optional<Eigen::Array3d> target = {};  // where they are to go; where the flock's centre ends if not given
  double home = 10;                           // the flock is home when its centre is nearer to the target than this, > 0 [unit]
  double repulsion = 2;                       // r_a of Strömbom et al. 2014 (doi:10.1098/rsif.2014.0719), > 0 [unit]
};

// Means are over the frames up to homecoming, or all of them. NaN where there is nothing to measure.
struct Herding {
  static constexpr double kNone = kNaN;
  double time = kNone;          // from the first frame to homecoming [s]; NaN: they never come home
  double collecting = kNone;    // share of frames in which some sheep is farther than r_a N^(2/3) from the centre of all N
  double spread = kNone;        // mean distance to that centre [unit]
  double speed = kNone;         // of the centre [unit/s]
  double polarisation = kNone;  // of the sheep that move, in [0, 1]
  // Side-to-side motion while driving, that is while not collecting: of the shepherd's distance from the line through centre and target.
  double side = kNone;         // root-mean-square distance [unit]
  double side_period = kNone;  // twice the mean time between changes of side [s]
  double side_least = kNone;   // least autocorrelation of the distance up to half of the longest unbroken drive; -1: as regular as a sine
};

// The shepherd is the first individual of its kind. Throws std::invalid_argument if an option is outside its range.
Herding herding(const Tracks& tracks, const HerdingOptions& options = {});

}  // namespace swarmfit
