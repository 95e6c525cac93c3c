// SPDX-License-Identifier: MIT
// The seven motion metrics of Ren et al. 2016 (Eq 6 ff.), per individual and frame.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

enum Metric : std::size_t { kSpeed, kAcceleration, kAngularVelocity, kAngularAcceleration, kJerk, kDistance, kVelocityDifference };
inline constexpr std::size_t kMetrics = 7;

template <class T>
using PerMetric = std::array<T, kMetrics>;

struct MetricInfo {
  std::string_view key;     // in tables and JSON: "v", "a", "omega", "alpha", "mu", "d", "eta"
  std::string_view symbol;  // "v", "a", "ω", "α", "μ", "d", "η"
  std::string_view name;    // "speed", ...
  int length, time;         // unit as powers of length and time
};
extern const PerMetric<MetricInfo> kMetricInfo;

// How positions become velocities.
enum class VelocitySource {
  difference,  // v_k = (p_{k+1} - p_k) / dt, the paper's
  recorded,    // the recording's own velocity column; metrics that need v use it in place of the difference
};

struct MetricOptions {
  VelocitySource velocity = VelocitySource::difference;
};

// All defined values of each metric, in row order of the tracks; the order carries no meaning.
//   v_k = (p_{k+1} - p_k)/dt;  v = |v_k|;  a = |v_{k+1} - v_k|/dt;  omega = angle(v_k, v_{k+1})/dt, by atan2(|×|, ·), in [0, pi/dt]
//   alpha = (omega_{k+1} - omega_k)/dt, signed;  mu = |(v_{k+2} - v_{k+1}) - (v_{k+1} - v_k)|/dt²
//   d = distance to the nearest other individual of the frame (ties: the lowest track number)
//   eta = | |v_nearest| - |v| | / d
// omega is undefined where either speed is zero or below 1e-9 of the median speed; eta where d < 1e-9; d and eta in frames with one
// individual. eta needs the nearest's velocity as well as one's own. Nothing is differenced across a gap.
struct MetricSamples {
  PerMetric<std::vector<double>> values;  // finite
  PerMetric<Index> undefined{};           // rows where the metric had all the frames it needs and is still undefined
  // What the recording's mean speed V, mean nearest distance D and dt make of each metric's unit: V, V/dt, 1/dt, 1/dt², V/dt², D, V/D.
  // A spread below 1e-9 of it is rounding. 0: not known.
  PerMetric<double> natural{};
};
// Throws InputError if recorded velocities are asked for and the tracks have none.
MetricSamples metric_samples(const Tracks& tracks, const MetricOptions& options = {});

// Nearest other individual in the same frame: row number per row and its distance [unit]; -1 and infinity for somebody alone.
struct Nearest {
  std::vector<Index> row;
  std::vector<double> distance;
};
enum class NearestMethod { automatic, all_pairs, tree };  // the same result, to the bit
Nearest nearest_neighbours(const Tracks& tracks, NearestMethod method = NearestMethod::automatic);

}  // namespace swarmfit
