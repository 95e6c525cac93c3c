// SPDX-License-Identifier: MIT
// What a person wants to know of a recording before trusting it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "libeval/localisation.h"
#include "libeval/order.h"

namespace swarmfit {

struct Quantiles {
  std::size_t count = 0;
  double mean, sd, min, q05, median, q95, max;  // NaN without samples; sd is the population's
  std::vector<std::uint64_t> shape{};           // counts in twelve equal bins from q05 to q95; empty if these are the same
};
Quantiles quantiles(std::vector<double> values);  // of the finite values

// A suspicion about the data, in words.
struct Suspicion {
  std::string what;      // "identity swap", "identity jump", "frozen track", "unit", "measurement error", ... (see suspicions.h)
  std::string message;   // one sentence with numbers, and what to do about it
  std::string examples;  // up to three places: "track 12, frame 340"; empty where there is no place to point at
};

struct Summary {
  std::size_t tracks = 0, segments = 0, gaps = 0, missing_frames = 0;  // missing: inside gaps
  std::int64_t first_frame = 0, last_frame = 0;
  std::size_t frames = 0;  // with at least one individual
  double duration = 0;     // from the first frame to the last [s]
  Index rows = 0;
  // Individuals per frame; observations per track and per unbroken segment; the metrics v, a and d; order parameters per frame.
  Quantiles individuals, track_length, segment_length, speed, acceleration, nearest, extent, polarisation, milling;
  std::size_t speed_outliers = 0, acceleration_outliers = 0;  // beyond median ± 10 × 1.4826 MAD
  Eigen::Array3d lower, upper;                                // bounding box [unit]; NaN without rows
  Localisation localisation;
  std::vector<Suspicion> suspicions;
};
Summary summarise(const Tracks& tracks);

}  // namespace swarmfit
