// SPDX-License-Identifier: MIT
#include "libtrack/tracks.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "libtrack/counting_sort.h"

namespace swarmfit {
namespace {

Rows reordered(const Rows& rows, const std::vector<Index>& order) {
  if (rows.rows() == 0) return rows;
  Rows out(rows.rows(), 3);
  for (Index axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < order.size(); ++i) out(static_cast<Index>(i), axis) = rows(order[i], axis);
  return out;
}

template <class T>
std::vector<T> reordered(const std::vector<T>& values, const std::vector<Index>& order) {
  if (values.empty()) return values;
  std::vector<T> out;
  out.reserve(values.size());
  for (const Index i : order) out.push_back(values[static_cast<std::size_t>(i)]);
  return out;
}

void check(const TrackColumns& c, const TrackMeta& meta) {
  const auto n = static_cast<std::size_t>(c.pos.rows());
  const auto fits = [n](std::size_t size) { return size == n; };
  const auto fits_or_empty = [n](std::size_t size) { return size == 0 || size == n; };
  if (!fits(c.track.size()) || !fits(c.frame.size()) || !fits_or_empty(c.kind.size()) ||
      !fits_or_empty(static_cast<std::size_t>(c.vel.rows())) || !fits_or_empty(static_cast<std::size_t>(c.acc.rows())))
    throw std::invalid_argument("Tracks: columns differ in length");
  if (meta.dims != 2 && meta.dims != 3) throw std::invalid_argument("Tracks: dims must be 2 or 3");
  if (!(meta.dt > 0)) throw std::invalid_argument("Tracks: the frame interval must be positive");
  if (!c.pos.isFinite().all()) throw std::invalid_argument("Tracks: positions must be finite");
  if (std::any_of(c.track.begin(), c.track.end(), [&](std::uint32_t t) { return t >= c.names.size(); }))
    throw std::invalid_argument("Tracks: a track number has no name");
}

}  // namespace

Tracks::Tracks(TrackColumns columns, TrackMeta meta) : columns_(std::move(columns)), meta_(std::move(meta)) {
  check(columns_, meta_);
  std::sort(columns_.episodes.begin(), columns_.episodes.end());
  sort();
  index_frames();
  index_tracks();
}

void Tracks::sort() {
  const auto& c = columns_;
  const auto key = [&c](std::size_t i) { return std::tuple(c.frame[i], c.track[i]); };
  const std::size_t n = c.frame.size();
  bool sorted = true;
  for (std::size_t i = 1; i < n && sorted; ++i) sorted = key(i - 1) <= key(i);
  if (!sorted) {
    auto order = sorted_by(c.track, identity_order<Index>(n));
    order = sorted_by(c.frame, std::move(order));
    columns_.track = reordered(columns_.track, order);
    columns_.frame = reordered(columns_.frame, order);
    columns_.kind = reordered(columns_.kind, order);
    columns_.pos = reordered(columns_.pos, order);
    columns_.vel = reordered(columns_.vel, order);
    columns_.acc = reordered(columns_.acc, order);
  }
  for (std::size_t i = 1; i < n; ++i)
    if (key(i) == key(i - 1)) throw std::invalid_argument("Tracks: a (track, frame) pair occurs twice");
}

void Tracks::index_frames() {
  const auto& frame = columns_.frame;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (i == 0 || frame[i] != frame[i - 1]) frames_.push_back({frame[i], static_cast<Index>(i), 0});
    ++frames_.back().count;
  }
}

void Tracks::index_tracks() {
  const auto n = static_cast<std::size_t>(rows());
  track_first_.assign(track_count() + 1, 0);
  for (const auto t : columns_.track) ++track_first_[t + 1];
  std::partial_sum(track_first_.begin(), track_first_.end(), track_first_.begin());
  by_track_.resize(n);
  next_.assign(n, -1);
  std::vector<Index> cursor(track_first_.begin(), track_first_.end() - 1);
  const auto& episodes = columns_.episodes;
  for (std::size_t i = 0; i < n; ++i) {
    const auto t = columns_.track[i];
    const auto slot = static_cast<std::size_t>(cursor[t]++);
    by_track_[slot] = static_cast<Index>(i);
    if (static_cast<Index>(slot) == track_first_[t]) continue;
    const auto previous = static_cast<std::size_t>(by_track_[slot - 1]);
    const bool adjacent = columns_.frame[i] == columns_.frame[previous] + 1;
    const bool new_take = std::binary_search(episodes.begin(), episodes.end(), columns_.frame[i]);
    if (adjacent && !new_take) next_[previous] = static_cast<Index>(i);
  }
}

int Tracks::kinds() const {
  const auto highest = std::max_element(columns_.kind.begin(), columns_.kind.end());
  return highest == columns_.kind.end() ? 1 : *highest + 1;
}

std::span<const Index> Tracks::rows_of(std::uint32_t track) const {
  const auto first = static_cast<std::size_t>(track_first_[track]);
  return {by_track_.data() + first, static_cast<std::size_t>(track_first_[track + 1]) - first};
}

TrackCollector::TrackCollector(std::vector<std::string> names, bool keep_velocity)
    : names_(std::move(names)), keep_velocity_(keep_velocity) {}

void TrackCollector::frame(const Snapshot& now) {
  for (std::size_t i = 0; i < now.id.size(); ++i) {
    track_.push_back(now.id[i]);
    frame_.push_back(now.frame);
    kind_.push_back(now.kind.empty() ? std::uint8_t{0} : now.kind[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto row = static_cast<Index>(i), column = static_cast<Index>(axis);
      values_[axis].push_back(now.pos(row, column));
      if (keep_velocity_) values_[axis + 3].push_back(now.vel(row, column));
    }
  }
}

Tracks TrackCollector::take(TrackMeta meta) {
  TrackColumns c;
  c.track = std::move(track_);
  c.frame = std::move(frame_);
  c.kind = std::move(kind_);
  const auto n = static_cast<Index>(c.track.size());
  const std::uint32_t highest = c.track.empty() ? 0 : *std::max_element(c.track.begin(), c.track.end()) + 1;
  c.names = std::move(names_);
  for (auto t = static_cast<std::uint32_t>(c.names.size()); t < highest; ++t) c.names.push_back(std::to_string(t));
  c.pos.resize(n, 3);
  if (keep_velocity_) c.vel.resize(n, 3);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto column = static_cast<Index>(axis);
    c.pos.col(column) = Eigen::Map<const Eigen::ArrayXd>(values_[axis].data(), n);
    if (keep_velocity_) c.vel.col(column) = Eigen::Map<const Eigen::ArrayXd>(values_[axis + 3].data(), n);
  }
  *this = TrackCollector();
  return Tracks(std::move(c), std::move(meta));
}

}  // namespace swarmfit
