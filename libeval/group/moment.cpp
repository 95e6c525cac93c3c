// SPDX-License-Identifier: MIT
#include "libeval/group/moment.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "libeval/group/components.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

using Eigen::Vector3d;
constexpr double kLink2 = 5, kLink3 = 3;

Vector3d at(const Rows& rows, Index row) { return {rows(row, 0), rows(row, 1), rows(row, 2)}; }

Vector3d shortest(Vector3d way, const Eigen::Array3d& period) {
  for (Index axis = 0; axis < 3; ++axis)
    if (period[axis] > 0) way[axis] -= period[axis] * std::round(way[axis] / period[axis]);
  return way;
}

// The circular mean along periodic axes: the angle of the mean unit vector.
Vector3d centre_of(const Rows& pos, const Eigen::Array3d& period) {
  const auto n = static_cast<double>(pos.rows());
  Vector3d sum = Vector3d::Zero();
  for (Index row = 0; row < pos.rows(); ++row) sum += at(pos, row);
  Vector3d centre = sum / n;
  for (Index axis = 0; axis < 3; ++axis) {
    if (!(period[axis] > 0)) continue;
    double c = 0, s = 0;
    for (Index row = 0; row < pos.rows(); ++row) {
      const double angle = 2 * std::numbers::pi * pos(row, axis) / period[axis];
      c += std::cos(angle), s += std::sin(angle);
    }
    centre[axis] = std::atan2(s, c) * period[axis] / (2 * std::numbers::pi);
  }
  return centre;
}

Places of_one_kind(const Snapshot& now, const MomentOptions& options) {
  Places out;
  out.frame = now.frame;
  if (!options.kind) {
    out.id.assign(now.id.begin(), now.id.end());
    out.pos = now.pos;
  } else {
    std::vector<Index> rows;
    for (std::size_t k = 0; k < now.id.size(); ++k)
      if ((now.kind.empty() ? 0 : now.kind[k]) == *options.kind) rows.push_back(static_cast<Index>(k)), out.id.push_back(now.id[k]);
    out.pos = now.pos(rows, Eigen::all);
  }
  out.step = out.back = Rows::Constant(out.pos.rows(), 3, kNaN);
  return out;
}

}  // namespace

MomentOptions moment_options(const Tracks& tracks, std::optional<std::uint8_t> kind) {
  MomentOptions o;
  o.dims = tracks.dims();
  o.dt = tracks.dt();
  o.episodes.assign(tracks.episodes().begin(), tracks.episodes().end());
  o.kind = kind;
  return o;
}

Axes principal_axes(std::span<const Vector3d> places, int dims) {
  Axes out;
  if (places.empty()) return out;
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& p : places) mean += p;
  mean /= static_cast<double>(places.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vector3d& p : places) scatter += (p - mean) * (p - mean).transpose();
  scatter /= static_cast<double>(places.size());
  if (dims == 2) {
    const double a = scatter(0, 0), b = scatter(0, 1), c = scatter(1, 1);
    const double middle = 0.5 * (a + c), half = std::hypot(0.5 * (a - c), b), angle = 0.5 * std::atan2(2 * b, a - c);
    out.variance = {middle + half, std::max(0.0, middle - half), 0};
    out.axis.col(0) = Vector3d(std::cos(angle), std::sin(angle), 0);
    out.axis.col(1) = Vector3d(-std::sin(angle), std::cos(angle), 0);
    return out;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);  // ascending
  for (Index k = 0; k < 3; ++k) {
    out.variance[k] = std::max(0.0, solver.eigenvalues()[2 - k]);
    out.axis.col(k) = solver.eigenvectors().col(2 - k);
  }
  return out;
}

Vector3d Moment::separation(Index a, Index b) const { return shortest(at(places_.pos, b) - at(places_.pos, a), options_.period); }

const Vector3d& Moment::centre() const {
  if (!centre_) centre_ = centre_of(places_.pos, options_.period);
  return *centre_;
}

const std::vector<Vector3d>& Moment::offsets() const {
  if (offsets_) return *offsets_;
  offsets_.emplace();
  for (Index row = 0; row < size(); ++row) offsets_->push_back(shortest(at(places_.pos, row) - centre(), options_.period));
  return *offsets_;
}

const Motion& Moment::motion() const {
  if (motion_) return *motion_;
  Motion& m = motion_.emplace();
  Vector3d middle = Vector3d::Zero();
  for (Index row = 0; row < size(); ++row) {
    const Vector3d step = at(places_.step, row);
    if (!std::isfinite(step.sum())) continue;
    const double length = step.norm();
    m.row.push_back(row);
    m.step.push_back(step);
    m.heading.push_back(length > 0 ? Vector3d(step / length) : Vector3d(Vector3d::Zero()));
    m.moving += length > 0;
    m.mean_step += step;
    middle += offsets()[static_cast<std::size_t>(row)];
  }
  if (m.row.empty()) return m;
  const auto n = static_cast<double>(m.row.size());
  m.mean_step /= n;
  middle /= n;
  for (std::size_t k = 0; k < m.row.size(); ++k) {
    m.from.emplace_back(offsets()[static_cast<std::size_t>(m.row[k])] - middle);
    m.to.emplace_back(m.from.back() + m.step[k] - m.mean_step);
  }
  return m;
}

const Axes& Moment::axes() const {
  if (!axes_) axes_ = principal_axes(offsets(), options_.dims);
  return *axes_;
}

const NearestOthers& Moment::nearest() const {
  if (nearest_) return *nearest_;
  if ((options_.period <= 0).all()) {
    nearest_ = nearest_others(places_.pos);
    return *nearest_;
  }
  const auto n = static_cast<std::size_t>(size());
  NearestOthers& out = nearest_.emplace(NearestOthers{std::vector<Index>(n, -1), std::vector<double>(n, INFINITY)});
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j) continue;
      const double d = separation(static_cast<Index>(i), static_cast<Index>(j)).norm();
      if (d < out.distance[i]) out.distance[i] = d, out.row[i] = static_cast<Index>(j);
    }
  return out;
}

double automatic_link(double mean_nearest, int dims) { return (dims == 3 ? kLink3 : kLink2) * mean_nearest; }

double Moment::link() const {
  if (link_) return *link_;
  link_ = options_.link;
  if (!(options_.link > 0) && size() > 1) {
    const auto& d = nearest().distance;
    link_ = automatic_link(std::accumulate(d.begin(), d.end(), 0.0) / static_cast<double>(d.size()), options_.dims);
  }
  return *link_;
}

const Components& Moment::components() const {
  if (!components_) components_ = connected(places_.pos, link(), options_.period);
  return *components_;
}

Places largest_component(const Moment& moment) {
  const Places& all = moment.places();
  const Components& c = moment.components();
  std::vector<Index> rows;
  Places out;
  out.frame = all.frame;
  for (std::size_t k = 0; k < c.of.size(); ++k)
    if (c.of[k] == 0) rows.push_back(static_cast<Index>(k)), out.id.push_back(all.id[k]);
  out.pos = all.pos(rows, Eigen::all);
  out.step = all.step(rows, Eigen::all);
  out.back = all.back(rows, Eigen::all);
  return out;
}

void MomentStream::frame(const Snapshot& now) {
  Places places = of_one_kind(now, options_);
  if (holding_) {
    link(places);
    emit();
  }
  held_ = std::move(places);
  holding_ = true;
}

void MomentStream::finish() {
  if (holding_) emit();
  holding_ = false;
}

void MomentStream::emit() {
  if (held_.pos.rows() > 0 && held_.frame % options_.every == 0) visit_(Moment(options_, held_));
}

// Gives everybody who is in both frames the step between them.
void MomentStream::link(Places& now) {
  Places& before = held_;
  if (now.frame != before.frame + 1) return;
  if (std::binary_search(options_.episodes.begin(), options_.episodes.end(), now.frame)) return;
  const auto join = [&](Index from, Index to) {
    const Vector3d step = shortest(at(now.pos, to) - at(before.pos, from), options_.period);
    before.step.row(from) = now.back.row(to) = step.transpose().array();
  };
  if (before.id == now.id) {
    for (Index row = 0; row < now.pos.rows(); ++row) join(row, row);
    return;
  }
  std::vector<std::pair<std::uint32_t, Index>> there;
  for (std::size_t k = 0; k < now.id.size(); ++k) there.emplace_back(now.id[k], static_cast<Index>(k));
  std::sort(there.begin(), there.end());
  for (std::size_t k = 0; k < before.id.size(); ++k) {
    const auto found = std::lower_bound(there.begin(), there.end(), std::pair(before.id[k], Index{0}));
    if (found != there.end() && found->first == before.id[k]) join(static_cast<Index>(k), found->second);
  }
}

void replay(const Tracks& tracks, FrameSink& sink) {
  const Rows still;
  Rows pos;
  std::vector<std::uint8_t> kind;
  for (const FrameRange& frame : tracks.frames()) {
    const auto first = static_cast<std::size_t>(frame.first), count = static_cast<std::size_t>(frame.count);
    pos = tracks.pos().middleRows(frame.first, frame.count);
    kind.clear();
    for (Index row = frame.first; row < frame.first + frame.count; ++row) kind.push_back(tracks.kind(row));
    sink.frame({frame.number, tracks.track().subspan(first, count), kind, pos, still});
  }
}

void for_each_moment(const Tracks& tracks, const MomentOptions& options, const MomentStream::Visit& visit) {
  MomentStream stream(options, visit);
  replay(tracks, stream);
  stream.finish();
}

}  // namespace swarmfit
