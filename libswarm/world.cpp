// SPDX-License-Identifier: MIT
#include "libswarm/world.h"

#include <algorithm>
#include <tuple>

#include "libtrack/normals.h"

namespace swarmfit {
namespace {

// Reflects x at the walls of [low, high] as often as needed; true if the direction of motion is reversed at the end.
bool fold(double& x, double low, double high) {
  const double width = high - low;
  if (width <= 0) {
    x = low;
    return true;
  }
  const double laps = std::floor((x - low) / width);
  const double rest = std::clamp(x - low - laps * width, 0.0, width);
  const bool odd = std::fmod(std::abs(laps), 2.0) == 1.0;
  x = odd ? high - rest : low + rest;
  return odd;
}

struct RowRange {
  Index first, end;
};

void confine_box(const Bounds& b, State& state, int dims, RowRange rows) {
  for (Index axis = 0; axis < dims; ++axis)
    for (Index i = rows.first; i < rows.end; ++i) {
      double &x = state.pos(i, axis), &v = state.vel(i, axis);
      if (x >= b.lower[axis] && x <= b.upper[axis]) continue;
      if (b.wall == Bounds::Wall::slip) {
        x = std::clamp(x, b.lower[axis], b.upper[axis]);
        v = 0;
      } else if (fold(x, b.lower[axis], b.upper[axis])) {
        v = -v;
      }
    }
}

void confine_periodic(const Bounds& b, State& state, int dims, RowRange rows) {
  for (Index axis = 0; axis < dims; ++axis) {
    const double low = b.lower[axis], width = b.upper[axis] - low;
    if (width <= 0) continue;
    for (Index i = rows.first; i < rows.end; ++i) {
      double& x = state.pos(i, axis);
      if (x >= low && x < b.upper[axis]) continue;
      x -= width * std::floor((x - low) / width);
      if (x >= b.upper[axis]) x = low;  // rounding of a tiny negative excess
    }
  }
}

void confine_sphere(const Bounds& b, State& state, int dims, RowRange rows) {
  for (Index i = rows.first; i < rows.end; ++i) {
    Eigen::Array3d r = state.pos.row(i).transpose() - b.centre;
    if (dims == 2) r[2] = 0;
    const double d2 = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
    if (d2 <= b.radius * b.radius) continue;
    const double d = std::sqrt(d2);
    const Eigen::Array3d n = r / d;
    const bool reflects = b.wall == Bounds::Wall::reflect;
    // The overshoot is mirrored at the tangent plane; one that is longer than the radius ends at the centre.
    const double depth = reflects ? std::max(0.0, 2 * b.radius - d) : b.radius;
    for (Index axis = 0; axis < dims; ++axis) state.pos(i, axis) = b.centre[axis] + depth * n[axis];
    const double outward = state.vel(i, 0) * n[0] + state.vel(i, 1) * n[1] + state.vel(i, 2) * n[2];
    if (outward <= 0) continue;
    for (Index axis = 0; axis < dims; ++axis) state.vel(i, axis) -= (reflects ? 2 : 1) * outward * n[axis];
  }
}

}  // namespace

Eigen::Array3d Bounds::separation(const Eigen::Array3d& a, const Eigen::Array3d& b) const {
  Eigen::Array3d d = b - a;
  if (kind == Kind::periodic)
    for (Index axis = 0; axis < 3; ++axis) {
      const double width = upper[axis] - lower[axis];
      if (width > 0) d[axis] -= width * std::round(d[axis] / width);
    }
  return d;
}

namespace {

void confine_rows(const Bounds& bounds, State& state, int dims, RowRange rows) {
  switch (bounds.kind) {
    case Bounds::Kind::open:
      return;
    case Bounds::Kind::box:
      return confine_box(bounds, state, dims, rows);
    case Bounds::Kind::periodic:
      return confine_periodic(bounds, state, dims, rows);
    case Bounds::Kind::sphere:
      return confine_sphere(bounds, state, dims, rows);
  }
}

}  // namespace

void Bounds::confine(State& state, int dims) const { confine_rows(*this, state, dims, {0, state.size()}); }
void Bounds::confine(State& state, int dims, Index row) const { confine_rows(*this, state, dims, {row, row + 1}); }

World& World::operator=(const World& other) {
  if (this == &other) return *this;
  dims = other.dims;
  bounds = other.bounds;
  parts_.clear();
  for (const auto& part : other.parts_) parts_.push_back(part->clone());
  return *this;
}

Presence::Presence(std::vector<Visit> visits) {
  std::sort(visits.begin(), visits.end(), [](const Visit& a, const Visit& b) { return std::tie(a.enter, a.id) < std::tie(b.enter, b.id); });
  visits_ = std::make_shared<const std::vector<Visit>>(std::move(visits));
}

void Presence::see_off(std::int64_t frame, State& state) {
  for (Index row = state.size() - 1; row >= 0; --row) {
    const auto leaves = leave_.find(state.id[static_cast<std::size_t>(row)]);
    if (leaves != leave_.end() && leaves->second < frame) {
      leave_.erase(leaves);
      state.remove(row);
    }
  }
  first_leave_ = INT64_MAX;
  for (const auto& [id, leave] : leave_) first_leave_ = std::min(first_leave_, leave);
}

void Presence::advance(const Clock& clock, const World&, State& state) {
  if (clock.sub != 0 || clock.frame <= done_) return;
  done_ = clock.frame;
  if (first_leave_ < clock.frame) see_off(clock.frame, state);
  std::vector<const Visit*> newcomers;
  for (; entered_ < visits_->size() && (*visits_)[entered_].enter <= clock.frame; ++entered_) {
    const Visit& visit = (*visits_)[entered_];
    if (visit.leave >= clock.frame) newcomers.push_back(&visit);  // or it was over before the run began
  }
  if (!newcomers.empty()) welcome(newcomers, clock, state);
}

void Presence::welcome(std::span<const Visit* const> newcomers, const Clock& clock, State& state) {
  const std::uint32_t next_id = state.next_id;  // they bring their own
  Index row = state.append(static_cast<Index>(newcomers.size()));
  state.next_id = next_id;
  const auto tick = static_cast<std::uint64_t>(clock.frame) & 0xFFFFFFFFFFFFu;  // frame numbers may be negative
  for (const Visit* visit : newcomers) {
    state.pos.row(row) = visit->pos.transpose();
    state.vel.row(row) = (visit->vel + visit->vel_error * three_normals(clock.rng, Stream::entry, tick, visit->id)).transpose();
    state.kind[static_cast<std::size_t>(row)] = visit->kind;
    state.id[static_cast<std::size_t>(row)] = visit->id;
    state.next_id = std::max(state.next_id, visit->id + 1);
    leave_[visit->id] = visit->leave;
    first_leave_ = std::min(first_leave_, visit->leave);
    ++row;
  }
}

}  // namespace swarmfit
