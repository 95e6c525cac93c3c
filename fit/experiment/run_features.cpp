// SPDX-License-Identifier: MIT
#include "fit/experiment/run_features.h"

#include <cmath>

#include "libtrack/quantile.h"
#include "libtrack/vectors.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using Limits = std::array<double, 3>;

constexpr double kParts = 10;   // of a column's axis
constexpr double kTiny = 1e-6;  // of the recorded scale: keeps logarithms finite

double finite(double x) { return std::isfinite(x) ? x : 0; }
std::size_t place(Index i) { return static_cast<std::size_t>(i); }

std::vector<std::size_t> parts_of(const Histogram& recorded) {
  std::vector<std::size_t> first{0};
  double below = 0;
  for (std::size_t b = 0; b + 1 < recorded.counts.size(); ++b) {
    below += static_cast<double>(recorded.counts[b]);
    if (below * kParts >= static_cast<double>(first.size()) * static_cast<double>(recorded.samples)) first.push_back(b + 1);
  }
  return first;
}

void add_moments(std::vector<double>& out, const Column& column, const Moments& recorded, const Moments& seen) {
  const double mean = finite(seen.mean), scale = recorded.sd();
  const bool is_signed = column.metric == kAngularAcceleration;
  out.push_back(is_signed ? std::asinh(mean / scale) : std::log(mean / recorded.mean + kTiny));
  out.push_back(std::log(finite(seen.sd()) / scale + kTiny));
}

void add_shares(std::vector<double>& out, const std::vector<std::size_t>& first, const Histogram& seen) {
  for (std::size_t p = 0; p < first.size(); ++p) {
    const std::size_t end = p + 1 < first.size() ? first[p + 1] : seen.counts.size();
    double count = 0;
    for (std::size_t b = first[p]; b < end && b < seen.counts.size(); ++b) count += static_cast<double>(seen.counts[b]);
    out.push_back(seen.samples > 0 ? std::sqrt(count / static_cast<double>(seen.samples)) : 0);
  }
}

Limits quarters(const std::vector<double>& values) {
  if (values.empty()) return {0, 0, 0};
  return {quantile(values, 0.25), quantile(values, 0.5), quantile(values, 0.75)};
}

std::size_t quarter(double value, const Limits& limits) {
  std::size_t q = 0;
  while (q < limits.size() && value > limits[q]) ++q;
  return q;
}

struct Mean {
  double sum = 0, count = 0;
  void add(double value) { sum += value, ++count; }
  double value() const { return count > 0 ? sum / count : 0; }
};
using Means = std::array<Mean, 4>;

// Means over individuals and frames; accelerations in units of the recording's V / T.
struct Drives {
  Means along, outward, toward, together, power;  // by quarters
  Mean follow, memory, with_near, with_far, square, spread;

  void write(std::vector<double>& out) const {
    for (const Means* group : {&along, &outward, &toward, &together})
      for (const Mean& m : *group) out.push_back(std::asinh(m.value()));
    const double all = std::max(square.value(), kTiny);
    for (const Mean& m : power) out.push_back(std::log(m.value() / all + kTiny));
    out.push_back(std::asinh(follow.value()));
    for (const Mean* m : {&memory, &with_near, &with_far}) out.push_back(m->value() / all);
    out.push_back(std::log(spread.value() + kTiny));
    out.push_back(std::log(all));
  }
};

}  // namespace

// One individual over three positions a lag apart.
struct RunFeatures::Turn {
  Index row;                         // of the middle one
  Array3d position, before, change;  // there; velocity up to there; acceleration
  Array3d others = Array3d::Zero();  // mean velocity of all others in the frame less one's own; zero if there are none
  Index again = -1;                  // the same individual's turn one lag later
};

std::vector<RunFeatures::Turn> RunFeatures::turns(const Tracks& tracks, int lag) {
  std::vector<Turn> out;
  const double dt = tracks.dt() * lag;
  const auto l = static_cast<std::size_t>(lag);
  for_each_segment(tracks, 2 * lag + 1, [&](std::span<const Index> rows) {
    const auto at = [&](std::size_t i) { return Array3d(tracks.pos().row(rows[i]).transpose()); };
    for (std::size_t k = l; k + l < rows.size(); ++k) {
      Turn turn{rows[k], at(k), (at(k) - at(k - l)) / dt, (at(k + l) - 2 * at(k) + at(k - l)) / (dt * dt)};
      if (k + 2 * l < rows.size()) turn.again = static_cast<Index>(out.size() + l);
      out.push_back(turn);
    }
  });
  std::vector<Array3d> sum(tracks.frames().size(), Array3d::Zero());
  std::vector<double> count(sum.size());
  std::vector<std::size_t> frame_of(place(tracks.rows()));
  for (std::size_t f = 0; f < sum.size(); ++f)
    for (Index r = 0; r < tracks.frames()[f].count; ++r) frame_of[place(tracks.frames()[f].first + r)] = f;
  for (const Turn& turn : out) sum[frame_of[place(turn.row)]] += turn.before, ++count[frame_of[place(turn.row)]];
  for (Turn& turn : out) {
    const std::size_t f = frame_of[place(turn.row)];
    if (count[f] > 1) turn.others = (sum[f] - count[f] * turn.before) / (count[f] - 1);
  }
  return out;
}

RunFeatures::Limits RunFeatures::distances_from_middle(const std::vector<Turn>& turns) const {
  std::vector<double> distance;
  for (const Turn& turn : turns) distance.push_back(length(turn.position - middle_));
  return quarters(distance);
}

RunFeatures::RunFeatures(const Conditions& conditions, const Target& target) : conditions_(conditions), target_(target) {
  const Tracks& recording = conditions.recording;
  for (int axis = 0; axis < 3; ++axis) middle_[axis] = recording.pos().col(axis).mean();
  for (const Distribution& d : target.recording()) parts_.push_back(parts_of(d.histogram));
  const Nearest nearest = nearest_neighbours(recording);
  for (const int frames : conditions.metrics.lags) {
    std::vector<double> speed, near;
    const auto all = turns(recording, frames);
    for (const Turn& turn : all) {
      speed.push_back(length(turn.before));
      if (const double d = nearest.distance[place(turn.row)]; std::isfinite(d)) near.push_back(d);
    }
    lags_.push_back({frames, quarters(speed), distances_from_middle(all), quarters(near)});
  }
}

void RunFeatures::add_drives(std::vector<double>& out, const Tracks& tracks, const Nearest& nearest, const Lag& lag) const {
  const double speed_unit = conditions_.scales.speed, unit = speed_unit / conditions_.scales.time(), extent = conditions_.scales.extent;
  const auto all = turns(tracks, lag.frames);
  std::vector<Index> turn_of(place(tracks.rows()), -1);
  for (std::size_t k = 0; k < all.size(); ++k) turn_of[place(all[k].row)] = static_cast<Index>(k);
  Drives drives;
  for (const Turn& turn : all) {
    const Array3d a = turn.change / unit, outward = turn.position - middle_;
    const double speed = length(turn.before), radius = length(outward);
    drives.square.add(dot(a, a));
    drives.spread.add(radius * radius / (extent * extent));
    drives.power[quarter(speed, lag.speed)].add(dot(a, a));
    if (speed > 0) drives.along[quarter(speed, lag.speed)].add(dot(a, turn.before) / speed);
    if (radius > 0) drives.outward[quarter(radius, lag.place)].add(dot(a, outward) / radius);
    drives.follow.add(dot(a, turn.others) / speed_unit);
    if (turn.again >= 0) drives.memory.add(dot(a, all[place(turn.again)].change) / unit);
    const Index other = nearest.row[place(turn.row)];
    const double distance = nearest.distance[place(turn.row)];
    if (other < 0 || !(distance > 0)) continue;
    const std::size_t q = quarter(distance, lag.near);
    drives.toward[q].add(dot(a, tracks.pos().row(other).transpose() - turn.position) / distance);
    if (const Index theirs = turn_of[place(other)]; theirs >= 0) {
      (q < 2 ? drives.with_near : drives.with_far).add(dot(a, all[place(theirs)].change) / unit);
      drives.together[q].add(dot(turn.before, all[place(theirs)].before) / (speed_unit * speed_unit));
    }
  }
  drives.write(out);
}

Eigen::VectorXd RunFeatures::operator()(const Tracks& tracks) const {
  const auto seen = target_.distributions(metric_samples(tracks, conditions_.metrics));
  std::vector<double> out;
  for (std::size_t c = 0; c < seen.size(); ++c) {
    if (!target_.defined(c)) continue;
    add_moments(out, target_.columns()[c], target_.recording()[c].moments, seen[c].moments);
    add_shares(out, parts_[c], seen[c].histogram);
  }
  const Nearest nearest = nearest_neighbours(tracks);
  for (const Lag& lag : lags_) add_drives(out, tracks, nearest, lag);
  Eigen::VectorXd features(static_cast<Index>(out.size()));
  for (std::size_t k = 0; k < out.size(); ++k) features[static_cast<Index>(k)] = out[k];
  return features;
}

}  // namespace swarmfit
