// SPDX-License-Identifier: MIT
#include "libeval/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "libtrack/cut.h"
#include "libtrack/error.h"

namespace swarmfit {

namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr double kStill = 1e-9;       // of the median speed: slower than this has no direction
constexpr double kCoincident = 1e-9;  // [unit]: closer than this is the same place

struct Vec {
  double x, y, z;
};
Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double length(Vec a) { return std::sqrt(dot(a, a)); }
Vec cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

// Angle between two vectors, exact near 0 and pi where arccos of the cosine is not.
double angle(Vec a, Vec b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

Vec row_of(const Rows& rows, Index i) { return {rows(i, 0), rows(i, 1), rows(i, 2)}; }

// The row `lag` frames later in the same unbroken run, per row; -1 where there is none.
std::vector<Index> rows_ahead(const Tracks& tracks, int lag) {
  std::vector<Index> ahead(static_cast<std::size_t>(tracks.rows()), -1);
  const auto l = static_cast<std::size_t>(lag);
  for_each_segment(tracks, lag + 1, [&](std::span<const Index> run) {
    for (std::size_t k = 0; k + l < run.size(); ++k) ahead[static_cast<std::size_t>(run[k])] = run[k + l];
  });
  return ahead;
}

// Velocity and speed per row, whichever way velocities are got. `next` is the row that a difference is taken with, dt later.
class Velocities {
 public:
  Velocities(const Tracks& tracks, VelocitySource source, std::span<const Index> next, double dt)
      : next_(next), recorded_(source == VelocitySource::recorded) {
    const auto n = static_cast<std::size_t>(tracks.rows());
    v_.resize(n);
    speed_.assign(n, kUndefined);
    for (std::size_t r = 0; r < n; ++r) {
      if (!exists(static_cast<Index>(r))) continue;
      if (recorded_) {
        v_[r] = row_of(tracks.vel(), static_cast<Index>(r));
      } else {
        const Vec step = row_of(tracks.pos(), next_[r]) - row_of(tracks.pos(), static_cast<Index>(r));
        v_[r] = {step.x / dt, step.y / dt, step.z / dt};
      }
      speed_[r] = length(v_[r]);
    }
  }

  // Are the frames there that a velocity at this row needs? `row` may be -1.
  bool exists(Index row) const { return row >= 0 && (recorded_ || next_[static_cast<std::size_t>(row)] >= 0); }
  Vec operator[](Index row) const { return v_[static_cast<std::size_t>(row)]; }
  double speed(Index row) const { return speed_[static_cast<std::size_t>(row)]; }
  const std::vector<double>& speeds() const { return speed_; }

 private:
  std::span<const Index> next_;
  bool recorded_;
  std::vector<Vec> v_;
  std::vector<double> speed_;
};

// The speed below which a direction is meaningless. The median is only needed when somebody is that slow.
double still_speed(const std::vector<double>& defined) {
  if (defined.empty()) return 0;
  const auto [low, high] = std::minmax_element(defined.begin(), defined.end());
  if (*low >= kStill * *high) return 0;
  std::vector<double> sorted = defined;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  if (sorted.size() % 2 == 1) return kStill * *middle;
  return kStill * 0.5 * (*middle + *std::max_element(sorted.begin(), middle));
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values) sum += x;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

// Books values; which row each is of only if that is wanted.
class Book {
 public:
  Book(MetricSamples& out, bool keep_rows) : out_(out), keep_rows_(keep_rows) {}
  void put(std::size_t column, Index row, double value) {
    if (!std::isfinite(value)) return void(++out_.undefined[column]);
    out_.values[column].push_back(value);
    if (keep_rows_) out_.rows[column].push_back(row);
  }
  MetricSamples& samples() { return out_; }

 private:
  MetricSamples& out_;
  bool keep_rows_;
};

// The columns of one lag, the first of which is `first`. `next` is the row one lag ahead, `dt` the time until then.
class Motion {
 public:
  Motion(const Velocities& v, std::span<const Index> next, double dt, std::size_t first, Book& book)
      : v_(v), next_(next), dt_(dt), first_(first), book_(book), out_(book.samples()) {}

  void take() {
    motion();
    turning();
    const double v = mean(out_.values[first_ + kSpeed]), dt = dt_;
    const std::array<double, kMotionMetrics> natural = {v, v / dt, 1 / dt, 1 / (dt * dt), v / (dt * dt)};
    std::copy(natural.begin(), natural.end(), book_.samples().natural.begin() + static_cast<std::ptrdiff_t>(first_));
  }

 private:
  void put(Metric metric, Index row, double value) { book_.put(first_ + metric, row, value); }
  Index next(Index row) const { return next_[static_cast<std::size_t>(row)]; }
  Index rows() const { return static_cast<Index>(next_.size()); }

  // v, a and mu
  void motion() {
    for (Index k = 0; k < rows(); ++k) {
      if (!v_.exists(k)) continue;
      put(kSpeed, k, v_.speed(k));
      const Index k1 = next(k);
      if (!v_.exists(k1)) continue;
      const Vec change = v_[k1] - v_[k];
      put(kAcceleration, k, length(change) / dt_);
      const Index k2 = next(k1);
      if (!v_.exists(k2)) continue;
      put(kJerk, k, length((v_[k2] - v_[k1]) - change) / (dt_ * dt_));
    }
  }

  // omega and alpha
  void turning() {
    const double still = still_speed(out_.values[first_ + kSpeed]);
    std::vector<double> omega(next_.size(), kUndefined);
    for (Index k = 0; k < rows(); ++k) {
      if (!turns(k)) continue;
      const Index k1 = next(k);
      const double slower = std::min(v_.speed(k), v_.speed(k1));
      double& now = omega[static_cast<std::size_t>(k)];
      if (slower > 0 && slower >= still) now = angle(v_[k], v_[k1]) / dt_;
      put(kAngularVelocity, k, now);
    }
    for (Index k = 0; k < rows(); ++k)
      if (turns(k) && turns(next(k)))
        put(kAngularAcceleration, k, (omega[static_cast<std::size_t>(next(k))] - omega[static_cast<std::size_t>(k)]) / dt_);
  }
  bool turns(Index row) const { return v_.exists(row) && v_.exists(next(row)); }

  const Velocities& v_;
  std::span<const Index> next_;
  double dt_;
  std::size_t first_;
  Book& book_;
  const MetricSamples& out_;
};

// d and eta; v: from one frame to the next.
void neighbours(const Tracks& tracks, const Velocities& v, Book& out) {
  const Nearest nearest = nearest_neighbours(tracks);
  for (Index k = 0; k < tracks.rows(); ++k) {
    const Index j = nearest.row[static_cast<std::size_t>(k)];
    const double d = nearest.distance[static_cast<std::size_t>(k)];
    out.put(kDistance, k, d);
    if (!v.exists(k) || (j >= 0 && !v.exists(j))) continue;
    out.put(kVelocityDifference, k, j >= 0 && d >= kCoincident ? std::abs(v.speed(j) - v.speed(k)) / d : kUndefined);
  }
}

void require_velocities(const Tracks& tracks, const MetricOptions& options) {
  if (options.velocity != VelocitySource::recorded) return;
  if (!tracks.has_velocity())
    throw InputError("`velocity` recorded: the recording has no velocity columns; expected columns for vx, vy (and vz)");
  if (options.lags != std::vector<int>{1})
    throw InputError("`velocity` recorded: recorded velocities belong to an instant; expected `lags` 1");
}

MetricSamples samples_of_kind(const Tracks& tracks, MetricOptions options) {
  const std::uint8_t kind = *std::exchange(options.kind, std::nullopt);
  MetricSamples out = metric_samples(of_kind(tracks, kind), options);
  std::vector<Index> rows;
  for (Index row = 0; row < tracks.rows(); ++row)
    if (tracks.kind(row) == kind) rows.push_back(row);
  for (auto& begins : out.rows)
    for (Index& row : begins) row = rows[static_cast<std::size_t>(row)];
  return out;
}

}  // namespace

MetricSamples metric_samples(const Tracks& tracks, const MetricOptions& options) {
  if (options.kind) return samples_of_kind(tracks, options);
  require_velocities(tracks, options);
  MetricSamples out(columns_at(options.lags));
  for (auto& values : out.values) values.reserve(static_cast<std::size_t>(tracks.rows()));
  Book book(out, options.keep_rows);
  const double dt = tracks.dt();
  const Velocities now(tracks, options.velocity, tracks.next(), dt);
  std::size_t first = 0;
  for (const int lag : options.lags) {
    if (lag == 1) {
      Motion(now, tracks.next(), dt, first, book).take();
    } else {
      const std::vector<Index> ahead = rows_ahead(tracks, lag);
      const double lagged = lag * dt;
      Motion(Velocities(tracks, options.velocity, ahead, lagged), ahead, lagged, first, book).take();
    }
    first += first == 0 ? kMetrics : kMotionMetrics;
  }
  neighbours(tracks, now, book);
  const double d = mean(out.values[kDistance]);
  out.natural[kDistance] = d;
  out.natural[kVelocityDifference] = d > 0 ? out.natural[kSpeed] / d : 0;
  return out;
}

}  // namespace swarmfit
