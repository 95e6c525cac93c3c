// SPDX-License-Identifier: MIT
// The seven motion metrics of Ren et al. 2016 (Eq 6 ff.), per individual and frame.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "libeval/columns.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// How positions become velocities.
enum class VelocitySource {
  difference,  // v_k = (p_{k+1} - p_k) / dt, the paper's
  recorded,    // the recording's own velocity column; metrics that need v use it in place of the difference
};

struct MetricOptions {
  VelocitySource velocity = VelocitySource::difference;
  std::vector<int> lags = {1};            // ascending, each at least 1
  bool keep_rows = false;                 // fill MetricSamples::rows
  std::optional<std::uint8_t> kind = {};  // of this kind of agent only, as if the others had not been there (of_kind); none: of all
};

// All defined values of each metric, in row order of the tracks; the order carries no meaning.
//   v_k = (p_{k+1} - p_k)/dt;  v = |v_k|;  a = |v_{k+1} - v_k|/dt;  omega = angle(v_k, v_{k+1})/dt, by atan2(|×|, ·), in [0, pi/dt]
//   alpha = (omega_{k+1} - omega_k)/dt, signed;  mu = |(v_{k+2} - v_{k+1}) - (v_{k+1} - v_k)|/dt²
//   d = distance to the nearest other individual of the frame (ties: the lowest track number)
//   eta = | |v_nearest| - |v| | / d
// omega is undefined where either speed is zero or below 1e-9 of the median speed; eta where d < 1e-9; d and eta in frames with one
// individual. eta needs the nearest's velocity as well as one's own. Nothing is differenced across a gap.
//
// At lag l the first five are those of positions l frames apart, in overlapping samples: v_k = (p_{k+l} - p_k)/(l dt) and so on with
// k + l, k + 2l and l dt in place of k + 1, k + 2 and dt. A sample of mu needs 3l + 1 frames without a gap. d and eta have no lag.
struct MetricSamples {
  MetricSamples() : MetricSamples(columns_at({1})) {}
  explicit MetricSamples(std::vector<Column> of) : columns(std::move(of)) {
    const std::size_t n = columns.size();
    values.resize(n), rows.resize(n), undefined.resize(n), natural.resize(n), rounding.resize(n);
  }

  std::vector<Column> columns;
  PerColumn<std::vector<double>> values;  // finite
  PerColumn<std::vector<Index>> rows;     // of the tracks, where each value begins; empty unless asked for
  PerColumn<Index> undefined;             // rows where the metric had all the frames it needs and is still undefined
  // What the recording's mean speed V, mean nearest distance D and dt make of each metric's unit: V, V/dt, 1/dt, 1/dt², V/dt², D, V/D;
  // at lag l with l dt for dt and the speed at that lag. A spread below 1e-9 of it is rounding. 0: not known.
  PerColumn<double> natural;
  // Standard deviation of what the rounding of the file's positions puts on each metric (recorded_samples, libeval/rounding.h); 0: none, or
  // not looked at.
  PerColumn<double> rounding;
};
// Throws InputError if recorded velocities are asked for and the tracks have none, or at another lag than 1: they belong to an instant.
MetricSamples metric_samples(const Tracks& tracks, const MetricOptions& options = {});

// Nearest other individual in the same frame: row number per row and its distance [unit]; -1 and infinity for somebody alone.
struct Nearest {
  std::vector<Index> row;
  std::vector<double> distance;
};
enum class NearestMethod { automatic, all_pairs, tree };  // the same result, to the bit
Nearest nearest_neighbours(const Tracks& tracks, NearestMethod method = NearestMethod::automatic);

}  // namespace swarmfit
