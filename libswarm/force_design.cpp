// SPDX-License-Identifier: MIT
#include "libswarm/force_design.h"

#include <algorithm>
#include <cmath>

namespace swarmfit {
namespace {

using Eigen::Array3d;

constexpr Index kMostRows = 40000;      // more say nothing new
constexpr Index kWindows = 8;           // of a long recording
constexpr Index kShortestWindow = 200;  // frames: long against any memory of noise that can be told

// Which rows become equations.
class Sample {
 public:
  explicit Sample(const Tracks& tracks) {
    const auto frames = static_cast<Index>(tracks.frames().size());
    if (tracks.rows() <= kMostRows) return;
    const double per_frame = static_cast<double>(tracks.rows()) / static_cast<double>(frames);
    const auto affordable = static_cast<Index>(static_cast<double>(kMostRows) / per_frame);  // frames
    const Index used = std::min(frames, std::max(affordable, kShortestWindow));
    windows_ = std::clamp<Index>(used / kShortestWindow, 1, kWindows);
    part_ = frames / windows_;
    length_ = std::max<Index>(1, used / windows_);
    every_ = static_cast<std::uint32_t>(std::max(1.0, std::ceil(static_cast<double>(used) * per_frame / kMostRows)));
  }
  // The n-th frame in which there is anybody.
  bool frame(Index n) const { return windows_ == 0 || (n % part_ < length_ && n < windows_ * part_); }
  bool track(std::uint32_t number) const { return number % every_ == 0; }

 private:
  Index windows_ = 0, part_ = 0, length_ = 0;
  std::uint32_t every_ = 1;
};

Array3d position(const Tracks& tracks, Index row) { return tracks.pos().row(row).transpose(); }

// Symmetric differences of whoever has a frame before and after.
class Seen {
 public:
  explicit Seen(const Tracks& tracks) : tracks_(tracks), before_(static_cast<std::size_t>(tracks.rows()), -1) {
    for (std::size_t row = 0; row < before_.size(); ++row)
      if (const Index next = tracks.next()[row]; next >= 0) before_[static_cast<std::size_t>(next)] = static_cast<Index>(row);
  }
  bool whole(Index row) const { return before_[static_cast<std::size_t>(row)] >= 0 && tracks_.next()[static_cast<std::size_t>(row)] >= 0; }
  // Somebody whose differences are not known is where he was seen.
  Array3d x(Index row) const { return whole(row) ? Array3d((last(row) + position(tracks_, row) + next(row)) / 3) : position(tracks_, row); }
  Array3d v(Index row) const { return (next(row) - last(row)) / (2 * tracks_.dt()); }
  Array3d a(Index row) const { return (next(row) - 2 * position(tracks_, row) + last(row)) / (tracks_.dt() * tracks_.dt()); }

 private:
  Array3d last(Index row) const { return position(tracks_, before_[static_cast<std::size_t>(row)]); }
  Array3d next(Index row) const { return position(tracks_, tracks_.next()[static_cast<std::size_t>(row)]); }

  const Tracks& tracks_;
  std::vector<Index> before_;
};

class Terms {
 public:
  Terms(const ForceBasis& basis, std::array<Eigen::MatrixXd, 3>& out) : basis_(basis), out_(out) {
    for (std::size_t g = 0; g < kForceGroups; ++g) first_[g] = static_cast<Index>(basis.first(static_cast<ForceGroup>(g)));
  }

  void alone(Index row, const Array3d& place, const Array3d& v) {
    const Array3d x = place - basis_.centre;
    const double speed = std::min(std::sqrt(v.square().sum()), basis_.top_speed);
    const double distance = std::min(std::sqrt(x.square().sum()), basis_.reach);
    add(row, ForceGroup::drag, 0, v);
    add(row, ForceGroup::speed_drag, 0, speed * v);
    add(row, ForceGroup::speed_drag, 1, speed * speed * v);
    add(row, ForceGroup::hardening, 0, distance * distance * x);
    for (int axis = 0; axis < basis_.dims; ++axis) {
      Array3d along = Array3d::Zero();
      along[axis] = 1;
      add(row, ForceGroup::confinement, static_cast<std::size_t>(axis), along * x);
      add(row, ForceGroup::push, static_cast<std::size_t>(axis), along);
    }
  }

  // Another, that far away and with that difference of velocities.
  void pair(Index row, const Array3d& away, const Array3d& difference) {
    const double distance = std::sqrt(away.square().sum());
    const auto [first, weight, next] = basis_.hat(distance);
    if (!(distance > 0) || (weight == 0 && next == 0)) return;
    const auto kernel = [&](std::size_t k, double by) {
      add(row, ForceGroup::pair, k, by / distance * away);
      add(row, ForceGroup::alignment, k, by * difference);
    };
    kernel(first, weight);
    if (next > 0) kernel(first + 1, next);
  }

 private:
  void add(Index row, ForceGroup group, std::size_t k, const Array3d& value) {
    const Index column = first_[static_cast<std::size_t>(group)] + static_cast<Index>(k);
    for (int axis = 0; axis < basis_.dims; ++axis) out_[static_cast<std::size_t>(axis)](row, column) += value[axis];
  }

  const ForceBasis& basis_;
  std::array<Eigen::MatrixXd, 3>& out_;
  std::array<Index, kForceGroups> first_{};
};

}  // namespace

ForceDesign::ForceDesign(const Tracks& tracks, const ForceBasis& basis) {
  const Sample sample(tracks);
  std::vector<Index> frame_of(static_cast<std::size_t>(tracks.rows()));
  for (std::size_t f = 0; f < tracks.frames().size(); ++f)
    std::fill_n(frame_of.begin() + tracks.frames()[f].first, tracks.frames()[f].count, static_cast<Index>(f));

  std::vector<Index> rows;  // of the tracks
  for_each_segment(tracks, 3, [&](std::span<const Index> segment) {
    if (!sample.track(tracks.track()[static_cast<std::size_t>(segment.front())])) return;
    for (std::size_t k = 1; k + 1 < segment.size(); ++k) {
      if (!sample.frame(frame_of[static_cast<std::size_t>(segment[k])])) continue;
      const bool goes_on = k > 1 && !rows.empty() && rows.back() == segment[k - 1];
      if (!goes_on) runs_.push_back({static_cast<Index>(rows.size()), 0});
      rows.push_back(segment[k]);
      ++runs_.back().count;
    }
  });

  const auto n = static_cast<Index>(rows.size());
  for (std::size_t axis = 0; axis < 3; ++axis) acceleration_[axis] = Eigen::VectorXd::Zero(n);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(basis.dims); ++axis)
    terms_[axis] = Eigen::MatrixXd::Zero(n, static_cast<Index>(basis.size()));
  const Seen seen(tracks);
  Terms terms(basis, terms_);
  for (Index u = 0; u < n; ++u) {
    const Index row = rows[static_cast<std::size_t>(u)];
    const Array3d x = seen.x(row), v = seen.v(row), a = seen.a(row);
    for (int axis = 0; axis < 3; ++axis) acceleration_[static_cast<std::size_t>(axis)][u] = a[axis];
    terms.alone(u, x, v);
    if (basis.kernel_size() == 0) continue;
    const FrameRange& frame = tracks.frames()[static_cast<std::size_t>(frame_of[static_cast<std::size_t>(row)])];
    for (Index other = frame.first; other < frame.first + frame.count; ++other)
      if (other != row) terms.pair(u, seen.x(other) - x, seen.whole(other) ? Array3d(seen.v(other) - v) : Array3d::Zero());
  }
}

}  // namespace swarmfit
