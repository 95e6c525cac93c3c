// SPDX-License-Identifier: MIT
// What a recording says of its group: order parameters over time with means, and curves; of all, and of every kind of agent by itself.
#pragma once

#include <string>
#include <vector>

#include "libeval/group/curves.h"
#include "libeval/group/group_state.h"
#include "libeval/group/order_table.h"
#include "libeval/group/series_mean.h"

namespace swarmfit {

struct MeasureOptions {
  std::vector<const OrderParameter*> what;  // order_parameters_named
  double link = 0;                          // [unit]; 0: automatic_link() of the recording's mean nearest-neighbour distance
  StateWords words = StateWords::group;
  std::int64_t window = 0;  // of the classifier of states [frames]; 0: the time in which an individual flies twice the group's rms radius,
                            // 10 frames at least and a quarter of the recording at most
};

struct MeasuredGroup {
  std::string name;  // "all", or that of the kind
  double link = 0;   // that was used [unit]
  OrderRecord record{{}};
  std::vector<SeriesMean> means;  // one per order parameter of the record
  GroupCurves curves;
  std::int64_t window = 0;  // that was used [frames]
  StateCourse states;
};

// All first, then the kinds in their order, if there are several.
struct Measured {
  std::vector<MeasuredGroup> groups;
};
Measured measure(const Tracks& tracks, const MeasureOptions& options);

}  // namespace swarmfit
