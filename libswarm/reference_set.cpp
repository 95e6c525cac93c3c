// SPDX-License-Identifier: MIT
#include "libswarm/reference_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "libtrack/error.h"
#include "libtrack/vectors.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

constexpr std::uint64_t kDrawn = 1, kTurned = 2;  // ticks of the draws

struct Sample {
  Array3d v, a;
  double speed;
};

// Every place that is followed by two further frames, by speed.
std::vector<Sample> samples_of(const Tracks& recording) {
  const auto next = recording.next();
  const Rows& pos = recording.pos();
  std::vector<Sample> all;
  for (Index row = 0; row < recording.rows(); ++row) {
    const Index second = next[static_cast<std::size_t>(row)];
    const Index third = second < 0 ? -1 : next[static_cast<std::size_t>(second)];
    if (third < 0) continue;
    const Array3d v = (pos.row(second) - pos.row(row)).transpose() / recording.dt();
    const Array3d w = (pos.row(third) - pos.row(second)).transpose() / recording.dt();
    all.push_back({v, w - v, length(v)});
  }
  std::stable_sort(all.begin(), all.end(), [](const Sample& a, const Sample& b) { return a.speed < b.speed; });
  return all;
}

// One of each of `count` strata of equal size.
std::vector<Sample> stratified(const std::vector<Sample>& all, std::size_t count, const Rng& rng) {
  std::vector<Sample> drawn;
  for (std::size_t s = 0; s < count; ++s) {
    const std::size_t first = s * all.size() / count, end = (s + 1) * all.size() / count;
    const double u = rng.uniform(Stream::start, kDrawn, static_cast<std::uint32_t>(s));
    drawn.push_back(all[first + static_cast<std::size_t>(u * static_cast<double>(end - first))]);
  }
  return drawn;
}

void turn_about_vertical(Sample& sample, double angle) {
  const double cosine = std::cos(angle), sine = std::sin(angle);
  for (Array3d* x : {&sample.v, &sample.a}) *x = {cosine * (*x)[0] - sine * (*x)[1], sine * (*x)[0] + cosine * (*x)[1], (*x)[2]};
}

void put(ReferenceSet::Vectors& to, std::size_t row, const Array3d& x) {
  for (std::size_t axis = 0; axis < 3; ++axis) to[axis][row] = x[static_cast<Index>(axis)];
}

}  // namespace

ReferenceSet::ReferenceSet(const Tracks& recording, const ReferenceOptions& options, const Rng& rng) : dt_(recording.dt()) {
  auto chosen = samples_of(recording);
  if (chosen.size() < kFewest)
    throw InputError(fmt::format("{}: {} place{} followed by two further frames of the same individual; expected at least {} to learn from",
                                 recording.meta().from.path.empty() ? "the recording" : recording.meta().from.path, chosen.size(),
                                 chosen.size() == 1 ? " is" : "s are", kFewest));
  if (chosen.size() > options.samples) chosen = stratified(chosen, options.samples, rng);
  size_ = chosen.size();
  for (Vectors* vectors : {&velocity_, &heading_, &acceleration_, &turn_})
    for (Column& column : *vectors) column.assign(size_ + 4, 0.0);
  speed_.assign(size_ + 4, 0.0);
  change_.assign(size_ + 4, 0.0);
  double square = 0;
  for (std::size_t k = 0; k < size_; ++k) {
    Sample& s = chosen[k];
    if (options.yaw) turn_about_vertical(s, 2 * std::numbers::pi * rng.uniform(Stream::start, kTurned, static_cast<std::uint32_t>(k)));
    speed_[k] = s.speed;
    change_[k] = length(s.a);
    put(velocity_, k, s.v);
    put(acceleration_, k, s.a);
    if (speed_[k] > 0) put(heading_, k, s.v / speed_[k]);
    if (change_[k] > 0) put(turn_, k, s.a / change_[k]);
    square += change_[k] * change_[k];
  }
  rms_change_ = std::sqrt(square / static_cast<double>(size_));
  const std::size_t groups = std::clamp<std::size_t>(options.groups, 1, size_);
  for (std::size_t g = 0; g <= groups; ++g) group_first_.push_back(g * size_ / groups);
}

ReferenceSet::Span ReferenceSet::like(double speed, std::size_t window) const {
  const auto end = speed_.begin() + static_cast<std::ptrdiff_t>(size_);
  const auto place =
      std::min<std::size_t>(static_cast<std::size_t>(std::lower_bound(speed_.begin(), end, speed) - speed_.begin()), size_ - 1);
  const auto group = static_cast<std::size_t>(std::upper_bound(group_first_.begin(), group_first_.end(), place) - group_first_.begin()) - 1;
  const std::size_t groups = group_first_.size() - 1;
  return {group_first_[group - std::min(group, window)], group_first_[std::min(group + window + 1, groups)]};
}

}  // namespace swarmfit
