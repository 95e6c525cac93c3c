// SPDX-License-Identifier: MIT
// What a person wants to know of a recording before trusting it.
#pragma once

#include <string>

#include "libeval/localisation.h"
#include "libeval/order.h"

namespace swarmfit {

struct Quantiles {
  std::size_t count = 0;
  double mean, sd, min, q05, median, q95, max;  // NaN without samples
};
Quantiles quantiles(std::vector<double> values);

// A suspicion about the data, in words.
struct Suspicion {
  std::string what;     // "identity jump", "frozen track", "unit", "measurement error", ...
  std::string message;  // one sentence with numbers, and what to do about it
  std::string examples; // up to three places: "track 12, frame 340"
};

struct Summary {
  std::size_t tracks = 0, segments = 0, gaps = 0, missing_frames = 0;  // missing: inside gaps
  std::int64_t first_frame = 0, last_frame = 0;
  std::size_t frames = 0;              // with at least one individual
  double duration = 0;                 // [s]
  Index rows = 0;
  Quantiles individuals, track_length, segment_length, speed, acceleration, nearest, extent, polarisation, milling;
  std::size_t speed_outliers = 0, acceleration_outliers = 0;  // beyond median ± 10 × 1.4826 MAD
  Eigen::Array3d lower, upper;         // bounding box [unit]
  Localisation localisation;
  std::vector<Suspicion> suspicions;
};
Summary summarise(const Tracks& tracks);

}  // namespace swarmfit
