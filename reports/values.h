// SPDX-License-Identifier: MIT
// Plain values of the commands that end in a few numbers and no run directory. The command fills them, reports/ writes them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "libeval/energy.h"
#include "libeval/score.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// Means over frames of the order parameters; NaN where undefined.
struct OrderMeans {
  double polarisation = 0, milling = 0;  // in [0, 1]
  double extent = 0;                     // root-mean-square radius about the centroid [unit]
};

// What `swarmfit evaluate REAL SIM` found.
struct Evaluation {
  TrackMeta real, simulated;
  Binning binning;
  PerMetric<double> axis_lower{}, axis_width{};  // bin i covers [lower + i width, lower + (i+1) width), physical units
  Energies raw_energies{};                       // NaN: undefined
  PerMetric<Distribution> real_distribution{}, simulated_distribution{};
  OrderMeans real_order, simulated_order;
};

// What `swarmfit weigh TABLE.csv` found: the table itself and what it determines.
struct WeighedTable {
  std::vector<std::string> models, metrics;  // names of the rows and columns
  Eigen::MatrixXd energies;                  // as given
  Weighting weighting;
  std::vector<double> scores;  // per row; NaN: undefined
};

// One line of `swarmfit models`, `scenarios` or `formats`.
struct ListEntry {
  std::string name, summary;
  std::vector<std::pair<std::string, std::string>> facts;  // further lines: ("options", "noise=curl|white"), ("source", ...)
};

}  // namespace swarmfit
