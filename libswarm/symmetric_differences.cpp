// SPDX-License-Identifier: MIT
#include "libswarm/symmetric_differences.h"

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

}  // namespace

SymmetricDifferences::SymmetricDifferences(const Tracks& tracks)
    : tracks_(tracks), before_(static_cast<std::size_t>(tracks.rows()), -1), frame_of_(static_cast<std::size_t>(tracks.rows())) {
  for (std::size_t row = 0; row < before_.size(); ++row)
    if (const Index next = tracks.next()[row]; next >= 0) before_[static_cast<std::size_t>(next)] = static_cast<Index>(row);
  for (std::size_t f = 0; f < tracks.frames().size(); ++f)
    std::fill_n(frame_of_.begin() + tracks.frames()[f].first, tracks.frames()[f].count, f);

  const Sample sample(tracks);
  for_each_segment(tracks, 3, [&](std::span<const Index> segment) {
    if (!sample.track(tracks.track()[static_cast<std::size_t>(segment.front())])) return;
    for (std::size_t k = 1; k + 1 < segment.size(); ++k) {
      if (!sample.frame(static_cast<Index>(frame_of_[static_cast<std::size_t>(segment[k])]))) continue;
      const bool goes_on = k > 1 && !rows_.empty() && rows_.back() == segment[k - 1];
      if (!goes_on) runs_.push_back({static_cast<Index>(rows_.size()), 0});
      rows_.push_back(segment[k]);
      ++runs_.back().count;
    }
  });
}

Array3d SymmetricDifferences::x(Index row) const {
  return whole(row) ? Array3d((last(row) + position(row) + next(row)) / 3) : position(row);
}

Array3d SymmetricDifferences::v(Index row) const {
  if (whole(row)) return (next(row) - last(row)) / (2 * tracks_.dt());
  if (next_of(row) >= 0) return (next(row) - position(row)) / tracks_.dt();
  return before_[static_cast<std::size_t>(row)] >= 0 ? Array3d((position(row) - last(row)) / tracks_.dt()) : Array3d::Zero();
}

Array3d SymmetricDifferences::a(Index row) const { return (next(row) - 2 * position(row) + last(row)) / (tracks_.dt() * tracks_.dt()); }

}  // namespace swarmfit
