// SPDX-License-Identifier: MIT
#include "libswarm/replay.h"

#include <algorithm>
#include <cassert>

namespace swarmfit {

using Eigen::Array3d;

Replay::Replay(std::vector<Individual> individuals, double frame_dt)
    : individuals_(std::make_shared<const std::vector<Individual>>(std::move(individuals))),
      frame_dt_(frame_dt),
      now_(individuals_->size()) {
  for (std::size_t k = 0; k < individuals_->size(); ++k) {
    const Individual& one = (*individuals_)[k];
    assert(!one.stretches.empty());
    if (one.id >= index_.size()) index_.resize(one.id + 1, SIZE_MAX);
    index_[one.id] = k;
  }
}

Replay::Now Replay::at(const Individual& one, std::int64_t frame, int sub) {
  const auto after = std::find_if(one.stretches.begin(), one.stretches.end(), [&](const Stretch& s) { return s.first > frame; });
  if (after == one.stretches.begin() || frame > one.until || (frame == one.until && sub > 0)) return {};
  const auto on = static_cast<std::size_t>(after - one.stretches.begin()) - 1;
  const Stretch& stretch = one.stretches[on];
  if (frame < stretch.last() || (frame == stretch.last() && sub == 0)) return {Where::recorded, on};
  const bool flies = after == one.stretches.end() || stretch.bridged;
  return {flies ? Where::flying : Where::absent, on};
}

void Replay::place(const Individual& one, const Stretch& stretch, const Clock& clock, State& state, Index row) const {
  const Index k = static_cast<Index>(clock.frame - stretch.first);
  state.vel.row(row) = stretch.vel.row(k);
  state.pos.row(row) = stretch.pos.row(k);
  if (clock.sub > 0) state.pos.row(row) += clock.sub * clock.dt / frame_dt_ * (stretch.pos.row(k + 1) - stretch.pos.row(k));
  state.kind[static_cast<std::size_t>(row)] = one.kind;
}

void Replay::advance(const Clock& clock, const World&, State& state) {
  std::vector<Index> gone;
  row_.assign(index_.size(), -1);
  for (Index row = 0; row < state.size(); ++row)
    if (const std::uint32_t id = state.id[static_cast<std::size_t>(row)]; id < row_.size()) row_[id] = row;
  for (std::size_t k = 0; k < individuals_->size(); ++k) {
    const Individual& one = (*individuals_)[k];
    const Now before = now_[k];
    now_[k] = at(one, clock.frame, clock.sub);
    Index& row = row_[one.id];
    if (now_[k].where == Where::absent) {
      if (row >= 0) gone.push_back(row);
      continue;
    }
    if (now_[k].where != Where::recorded) continue;
    const Stretch& stretch = one.stretches[now_[k].stretch];
    if (row < 0) row = state.spawn(one.kind, Array3d::Zero(), Array3d::Zero(), one.id);
    if (before.where == Where::flying) arrivals_.push_back({one.id, clock.frame, (stretch.pos.row(0) - state.pos.row(row)).transpose()});
    place(one, stretch, clock, state, row);
  }
  std::sort(gone.rbegin(), gone.rend());
  for (const Index row : gone) state.remove(row);
}

std::optional<Array3d> Replay::goal(std::uint32_t id) const {
  if (id >= index_.size() || index_[id] == SIZE_MAX) return std::nullopt;
  const Individual& one = (*individuals_)[index_[id]];
  const Now now = now_[index_[id]];
  // On the last frame of a stretch the step into the gap is still to come.
  if (now.where == Where::absent || now.stretch + 1 >= one.stretches.size()) return std::nullopt;
  return Array3d(one.stretches[now.stretch + 1].pos.row(0).transpose());
}

}  // namespace swarmfit
