// SPDX-License-Identifier: MIT
#include "libeval/skill.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "libeval/distance.h"
#include "libeval/rounding.h"
#include "libtrack/cut.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

constexpr std::size_t kBlocks = HalfDistance::kBlocks;
constexpr unsigned kAll = (1U << kBlocks) - 1;
constexpr std::size_t kFewestFrames = 4 * kBlocks;  // a jerk needs four

Histogram sum_of(const HalfDistance::Blocks& blocks, std::size_t metric, unsigned mask) {
  Histogram sum;
  for (std::size_t b = 0; b < kBlocks; ++b)
    if (mask >> b & 1U) sum.add(blocks[b][metric]);
  return sum;
}

// Of `a` the chosen blocks, of `b` the rest.
double half_against_half(const HalfDistance::Blocks& a, const HalfDistance::Blocks& b, std::size_t metric, unsigned mask) {
  return total_variation(sum_of(a, metric, mask), sum_of(b, metric, kAll & ~mask));
}

// Total variation over all choices of half the blocks.
Moments over_halves(const HalfDistance::Blocks& a, const HalfDistance::Blocks& b, std::size_t metric) {
  Moments moments;
  for (unsigned mask = 0; mask <= kAll; ++mask)
    if (std::popcount(mask) == kBlocks / 2) moments.add(half_against_half(a, b, metric, mask));
  return moments;
}

}  // namespace

HalfDistance::HalfDistance(const Tracks& recording, const MetricOptions& options)
    : options_(options), target_(recorded_samples(recording, options), Binning::standard(Normalisation::reference)) {
  floor_ = floor_sd_ = PerColumn<double>(columns().size(), kNaN);
  recording_ = no_blocks();
  const auto frames = recording.frames();
  if (frames.size() < kFewestFrames) return;
  for (std::size_t b = 0; b < kBlocks; ++b) first_frame_.push_back(frames[b * frames.size() / kBlocks].number);
  recording_ = blocks(recording);
  for (std::size_t m = 0; m < floor_.size(); ++m) {
    const Moments moments = over_halves(recording_, recording_, m);
    if (moments.count == 0) continue;
    floor_[m] = moments.mean;
    floor_sd_[m] = moments.sd();
  }
}

Moments HalfDistance::floor_over(const PerColumn<bool>& used) const {
  Moments moments;
  for (unsigned mask = 0; mask <= kAll; ++mask) {
    if (std::popcount(mask) != kBlocks / 2) continue;
    PerColumn<double> distance(columns().size(), kNaN);
    for (std::size_t m = 0; m < distance.size(); ++m)
      if (used[m]) distance[m] = half_against_half(recording_, recording_, m, mask);
    moments.add(mean_used(distance, used));
  }
  return moments;
}

HalfDistance::Blocks HalfDistance::blocks(const Tracks& tracks) const {
  Blocks out = no_blocks();
  constexpr std::int64_t kBefore = std::numeric_limits<std::int64_t>::min(), kAfter = std::numeric_limits<std::int64_t>::max();
  for (std::size_t b = 0; b < first_frame_.size(); ++b) {
    const Tracks part = cut(tracks, b == 0 ? kBefore : first_frame_[b], b + 1 < kBlocks ? first_frame_[b + 1] : kAfter);
    const auto distributions = target_.distributions(metric_samples(part, options_));
    for (std::size_t m = 0; m < distributions.size(); ++m) out[b][m] = distributions[m].histogram;
  }
  return out;
}

HalfDistance::Blocks HalfDistance::no_blocks() const {
  Blocks out;
  out.fill(PerColumn<Histogram>(columns().size()));
  return out;
}

PerColumn<double> HalfDistance::to(const Blocks& other, const PerColumn<bool>& wanted) const {
  PerColumn<double> out(columns().size(), kNaN);
  for (std::size_t m = 0; m < out.size(); ++m) {
    if (!wanted[m]) continue;
    const Moments moments = over_halves(recording_, other, m);
    if (moments.count > 0) out[m] = moments.mean;
  }
  return out;
}

PerColumn<Histogram> HalfDistance::pooled(const Blocks& blocks) {
  PerColumn<Histogram> out(blocks[0].size());
  for (std::size_t m = 0; m < out.size(); ++m) out[m] = sum_of(blocks, m, kAll);
  return out;
}

double HalfDistance::bin_width() const {
  const Binning& b = target_.binning();
  return (b.upper - b.lower) / b.bins;
}

double SkillScale::skill(double distance) const { return null > floor ? 1 - (distance - floor) / (null - floor) : kNaN; }

double SkillScale::slope() const { return null > floor ? 1 / (null - floor) : kNaN; }

double mean_used(const PerColumn<double>& values, const PerColumn<bool>& used) {
  double sum = 0, count = 0;
  for (std::size_t m = 0; m < used.size(); ++m)
    if (used[m]) sum += values[m], ++count;
  return count > 0 ? sum / count : kNaN;
}

SkillScale skill_scale(const PerColumn<double>& floor, const PerColumn<double>& null, const PerColumn<bool>& used) {
  return {mean_used(floor, used), mean_used(null, used)};
}

}  // namespace swarmfit
