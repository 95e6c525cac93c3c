// SPDX-License-Identifier: MIT
// Forces of a recording beside those of models, by the same regression: what was put into a model and what is seen of it are two things.
#pragma once

#include <span>

#include "fit/results/force_curves.h"
#include "libeval/group/curves.h"
#include "libswarm/force_regression.h"

namespace swarmfit {

class ForceView {
 public:
  explicit ForceView(const Tracks& recording);

  const ForceFacts& facts() const { return facts_; }
  // Of a simulation, with the groups of terms that the recording needs.
  ForceCurves of(const Tracks& simulated) const;

 private:
  ForceBasis basis_;
  ForceGroups needed_{};
  ForceFacts facts_;
};

// The same of a recording by itself: drag, stiffness and, where there are pairs, attraction and alignment. None where there is too little
// to see.
std::vector<GroupCurve> force_curves(const Tracks& recording);

// Median and robust standard deviation value by value, over those that are finite: runs that blew up or show too little do not
// count. NaN where there are none.
ForceSpread force_spread(std::span<const ForceCurves> all);

}  // namespace swarmfit
