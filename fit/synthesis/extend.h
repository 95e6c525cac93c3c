// SPDX-License-Identifier: MIT
// Longer tracks from tracklets, and larger groups from small recordings: Xiang et al. 2020 (doi:10.1002/cav.1957), section 5.2.3.
#pragma once

#include <map>
#include <string>

#include "fit/results/model_fit.h"
#include "libswarm/model.h"

namespace swarmfit {

// The model that flies where nothing was recorded, and what it is told.
struct Pilot {
  ModelChoice model;
  std::map<std::string, double> set;  // parameters in physical units; the others are the defaults of fits in the recording's scales
  std::string arena = "open";         // as fits take it
  std::uint64_t seed = 1;
};

// A number of frames for everybody, and others for individuals by name.
struct PerIndividual {
  std::int64_t all = 0;
  std::map<std::string, std::int64_t> own = {};
  std::int64_t of(const std::string& name) const;
};

struct ExtendOptions {
  Pilot pilot;
  PerIndividual onward;                 // frames for which a track goes on past its last one
  PerIndividual bridge{INT64_MAX, {}};  // longest gap that is bridged [frames]; longer ones stay gaps
};

// All recorded points as they were, and simulated ones behind the last of every track and in gaps between fragments of one individual.
// While a track goes on, the recorded individuals of those frames are its neighbours. Who flies on starts from its last recorded place with
// its last recorded velocity. In a gap the model heads for the place where the track goes on, if it can be told to (w_user of fastswarm is
// then 1, if not set otherwise), and what it misses it by is spread evenly over the gap, so that the ends meet. Never across an episode.
//
// Points say whether they were recorded: see origin_kinds(). Throws InputError: nothing to do, an individual that is not there, a
// recording that the model cannot learn from.
Tracks extend(const Tracks& recording, const ExtendOptions& options);

struct AugmentOptions {
  Pilot pilot;
  int add = 100;  // simulated agents
};

// The recording as it was, and simulated agents among the recorded ones, who never move differently for it. They start at places where
// somebody was recorded at some time, as fast as somebody was, and are there for all frames. Named synthetic1, synthetic2, ...
Tracks augment(const Tracks& recording, const AugmentOptions& options);

// Kinds of tracks of both origins: kind k of n is as recorded, kind n + k the same simulated. Named "recorded" and "synthetic" where there
// is one kind only, else "sheep", "dog", "synthetic sheep", "synthetic dog".
std::vector<std::string> origin_kinds(const Tracks& recording);

// The parameters that a pilot flies with: of every row of the model's table, in physical units. Throws InputError naming the parameters
// there are.
std::vector<double> pilot_parameters(const Pilot& pilot, const Scales& scales);

}  // namespace swarmfit
