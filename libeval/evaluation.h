// SPDX-License-Identifier: MIT
// The evaluator's two jobs as one call each: how alike are two recordings, and what does a table of energies say.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "libeval/energy.h"
#include "libeval/score.h"

namespace swarmfit {

// Means over frames of the order parameters; NaN where undefined.
struct OrderMeans {
  double polarisation = 0, milling = 0;  // in [0, 1]
  double extent = 0;                     // root-mean-square radius about the centroid [unit]
};

struct Evaluation {
  TrackMeta real, simulated;
  Binning binning;
  std::vector<Column> columns = columns_at({1});
  PerColumn<double> axis_lower, axis_width;  // bin i covers [lower + i width, lower + (i+1) width), physical units
  Energies raw_energies;                     // NaN: undefined
  PerColumn<Distribution> real_distribution, simulated_distribution;
  OrderMeans real_order, simulated_order;
};

// Compares two recordings. Throws InputError if they differ in dimension, length unit, or by more than 1 % in frame interval,
// and as require_lags does.
Evaluation evaluate(const Tracks& real, const Tracks& simulated, const Binning& binning, const MetricOptions& options = {});

// A table of energies with names: rows are models, columns metrics.
struct WeighedTable {
  std::vector<std::string> models, metrics;
  Eigen::MatrixXd energies;  // as given; NaN: undefined
  Weighting weighting;
  std::vector<double> scores;  // per row; NaN: undefined
};

// Reads comma-separated text: a header whose first field is ignored, then one line per model, its name first; an empty field is
// undefined. Weighs and scores it. Throws InputError naming the place.
WeighedTable weigh(const std::string& name, std::string_view csv);

}  // namespace swarmfit
