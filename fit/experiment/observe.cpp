// SPDX-License-Identifier: MIT
#include "fit/experiment/observe.h"

#include <algorithm>

#include "libtrack/normals.h"

namespace swarmfit {

Observer::Observer(const Tracks* mask, const Eigen::Array3d& sigma, Rng rng, FrameSink& out, std::uint32_t tracked, const Grid& grid)
    : mask_(mask), sigma_(sigma), rng_(rng), out_(out), tracked_(tracked), grid_(grid) {}

void Observer::advance_to(std::int64_t frame) {
  const auto frames = mask_->frames();
  while (cursor_ < frames.size() && frames[cursor_].number < frame) ++cursor_;
  const bool recorded = cursor_ < frames.size() && frames[cursor_].number == frame;
  visible_ = recorded
                 ? mask_->track().subspan(static_cast<std::size_t>(frames[cursor_].first), static_cast<std::size_t>(frames[cursor_].count))
                 : std::span<const std::uint32_t>{};
}

bool Observer::seen(std::uint32_t id) const { return mask_ ? std::binary_search(visible_.begin(), visible_.end(), id) : id < tracked_; }

void Observer::frame(const Snapshot& now) {
  if (mask_) advance_to(now.frame);
  rows_.clear();
  id_.clear();
  kind_.clear();
  for (std::size_t i = 0; i < now.id.size(); ++i) {
    if (!seen(now.id[i])) continue;
    rows_.push_back(static_cast<Index>(i));
    id_.push_back(now.id[i]);
    kind_.push_back(now.kind[i]);
  }
  pos_.resize(static_cast<Index>(rows_.size()), 3);
  vel_.resize(static_cast<Index>(rows_.size()), 3);
  const auto tick = static_cast<std::uint64_t>(now.frame) & 0xFFFFFFFFFFFFu;  // frame numbers may be negative
  const bool blurred = (sigma_ != 0).any();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto row = static_cast<Index>(i);
    pos_.row(row) = now.pos.row(rows_[i]);
    vel_.row(row) = now.vel.row(rows_[i]);
  }
  if (blurred) {
    error_.resize(pos_.rows(), 3);
    three_normals(rng_, Stream::localisation, tick, id_, error_.col(0).data(), error_.col(1).data(), error_.col(2).data());
    for (Index axis = 0; axis < 3; ++axis) pos_.col(axis) += sigma_[axis] * error_.col(axis);
  }
  if (grid_.any())
    for (Index row = 0; row < pos_.rows(); ++row) pos_.row(row) = grid_.rounded(pos_.row(row).transpose()).transpose();
  out_.frame({now.frame, id_, kind_, pos_, vel_});
}

}  // namespace swarmfit
