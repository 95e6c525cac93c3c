// SPDX-License-Identifier: MIT
#include "libeval/summary.h"

#include <algorithm>
#include <cmath>

#include "libeval/energy.h"
#include "libeval/robust.h"
#include "libeval/suspicions.h"
#include "libtrack/nan.h"
#include "libtrack/quantile.h"

namespace swarmfit {
namespace {

constexpr double kOutlier = 10;  // robust standard deviations

// Did a new take begin after frame `before` and not after frame `now`?
bool new_take(std::span<const std::int64_t> episodes, std::int64_t before, std::int64_t now) {
  const auto first = std::upper_bound(episodes.begin(), episodes.end(), before);
  return first != episodes.end() && *first <= now;
}

void count_gaps(const Tracks& tracks, Summary& out) {
  const auto frame = tracks.frame();
  for (std::uint32_t t = 0; t < tracks.track_count(); ++t) {
    const auto rows = tracks.rows_of(t);
    for (std::size_t k = 1; k < rows.size(); ++k) {
      const auto before = frame[static_cast<std::size_t>(rows[k - 1])], now = frame[static_cast<std::size_t>(rows[k])];
      if (now == before + 1 || new_take(tracks.episodes(), before, now)) continue;
      ++out.gaps;
      out.missing_frames += static_cast<std::size_t>(now - before - 1);
    }
  }
}

void count_lengths(const Tracks& tracks, Summary& out) {
  std::vector<double> individuals, lengths, segments;
  for (const FrameRange& frame : tracks.frames()) individuals.push_back(static_cast<double>(frame.count));
  for (std::uint32_t t = 0; t < tracks.track_count(); ++t)
    if (const auto rows = tracks.rows_of(t); !rows.empty()) lengths.push_back(static_cast<double>(rows.size()));
  for_each_segment(tracks, 1, [&](std::span<const Index> rows) { segments.push_back(static_cast<double>(rows.size())); });
  out.tracks = lengths.size();
  out.segments = segments.size();
  out.individuals = quantiles(std::move(individuals));
  out.track_length = quantiles(std::move(lengths));
  out.segment_length = quantiles(std::move(segments));
}

void extent_in_time_and_space(const Tracks& tracks, Summary& out) {
  out.rows = tracks.rows();
  out.frames = tracks.frames().size();
  out.lower.setConstant(kNaN);
  out.upper.setConstant(kNaN);
  if (tracks.rows() == 0) return;
  out.first_frame = tracks.frames().front().number;
  out.last_frame = tracks.frames().back().number;
  out.duration = static_cast<double>(out.last_frame - out.first_frame) * tracks.dt();
  out.lower = tracks.pos().colwise().minCoeff().transpose();
  out.upper = tracks.pos().colwise().maxCoeff().transpose();
}

void motion(const Tracks& tracks, Summary& out) {
  MetricSamples samples = metric_samples(tracks);
  out.speed_outliers = count_outliers(samples.values[kSpeed], kOutlier);
  out.acceleration_outliers = count_outliers(samples.values[kAcceleration], kOutlier);
  out.speed = quantiles(std::move(samples.values[kSpeed]));
  out.acceleration = quantiles(std::move(samples.values[kAcceleration]));
  out.nearest = quantiles(std::move(samples.values[kDistance]));
  OrderSeries order = order_parameters(tracks);
  out.extent = quantiles(std::move(order.extent));
  out.polarisation = quantiles(std::move(order.polarisation));
  out.milling = quantiles(std::move(order.milling));
}

std::vector<std::uint64_t> shape(const std::vector<double>& values, double lower, double upper) {
  constexpr std::size_t kBins = 12;
  if (!(upper > lower)) return {};
  std::vector<std::uint64_t> counts(kBins);
  for (const double x : values)
    if (x >= lower && x <= upper) ++counts[std::min(kBins - 1, static_cast<std::size_t>(kBins * (x - lower) / (upper - lower)))];
  return counts;
}

}  // namespace

Quantiles quantiles(std::vector<double> values) {
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  if (values.empty()) return {0, kNaN, kNaN, kNaN, kNaN, kNaN, kNaN, kNaN, {}};
  Moments moments;
  for (const double x : values) moments.add(x);
  const double q05 = quantile(values, 0.05), q50 = quantile(values, 0.5), q95 = quantile(values, 0.95);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {values.size(), moments.mean, moments.sd(), *low, q05, q50, q95, *high, shape(values, q05, q95)};
}

Summary summarise(const Tracks& tracks) {
  Summary out;
  extent_in_time_and_space(tracks, out);
  count_lengths(tracks, out);
  count_gaps(tracks, out);
  motion(tracks, out);
  out.localisation = estimate_localisation(tracks);
  out.suspicions = suspicions(tracks, out);
  return out;
}

}  // namespace swarmfit
