// SPDX-License-Identifier: MIT
#include "libeval/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libtrack/error.h"

namespace swarmfit {

const PerMetric<MetricInfo> kMetricInfo = {{
    {"v", "v", "speed", 1, -1},
    {"a", "a", "acceleration", 1, -2},
    {"omega", "ω", "angular velocity", 0, -1},
    {"alpha", "α", "angular acceleration", 0, -2},
    {"mu", "μ", "Cartesian jerk", 1, -3},
    {"d", "d", "shortest distance", 1, 0},
    {"eta", "η", "velocity difference", 0, -1},
}};

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

// Velocity and speed per row, whichever way velocities are got.
class Velocities {
 public:
  Velocities(const Tracks& tracks, VelocitySource source) : next_(tracks.next()), recorded_(source == VelocitySource::recorded) {
    if (recorded_ && !tracks.has_velocity())
      throw InputError("--velocity recorded: the recording has no velocity columns; expected columns for vx, vy (and vz)");
    const auto n = static_cast<std::size_t>(tracks.rows());
    v_.resize(n);
    speed_.assign(n, kUndefined);
    const double dt = tracks.dt();
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

class Sampler {
 public:
  Sampler(const Tracks& tracks, const MetricOptions& options)
      : tracks_(tracks), next_(tracks.next()), dt_(tracks.dt()), v_(tracks, options.velocity) {
    for (auto& values : out_.values) values.reserve(static_cast<std::size_t>(tracks.rows()));
  }

  MetricSamples take() {
    motion();
    turning();
    neighbours();
    scales();
    return std::move(out_);
  }

 private:
  void put(Metric metric, double value) { std::isfinite(value) ? out_.values[metric].push_back(value) : void(++out_.undefined[metric]); }
  Index next(Index row) const { return next_[static_cast<std::size_t>(row)]; }

  // v, a and mu
  void motion() {
    for (Index k = 0; k < tracks_.rows(); ++k) {
      if (!v_.exists(k)) continue;
      put(kSpeed, v_.speed(k));
      const Index k1 = next(k);
      if (!v_.exists(k1)) continue;
      const Vec change = v_[k1] - v_[k];
      put(kAcceleration, length(change) / dt_);
      const Index k2 = next(k1);
      if (!v_.exists(k2)) continue;
      put(kJerk, length((v_[k2] - v_[k1]) - change) / (dt_ * dt_));
    }
  }

  // omega and alpha
  void turning() {
    const double still = still_speed(out_.values[kSpeed]);
    std::vector<double> omega(static_cast<std::size_t>(tracks_.rows()), kUndefined);
    for (Index k = 0; k < tracks_.rows(); ++k) {
      if (!turns(k)) continue;
      const Index k1 = next(k);
      const double slower = std::min(v_.speed(k), v_.speed(k1));
      double& now = omega[static_cast<std::size_t>(k)];
      if (slower > 0 && slower >= still) now = angle(v_[k], v_[k1]) / dt_;
      put(kAngularVelocity, now);
    }
    for (Index k = 0; k < tracks_.rows(); ++k)
      if (turns(k) && turns(next(k)))
        put(kAngularAcceleration, (omega[static_cast<std::size_t>(next(k))] - omega[static_cast<std::size_t>(k)]) / dt_);
  }
  bool turns(Index row) const { return v_.exists(row) && v_.exists(next(row)); }

  // d and eta
  void neighbours() {
    const Nearest nearest = nearest_neighbours(tracks_);
    for (Index k = 0; k < tracks_.rows(); ++k) {
      const Index j = nearest.row[static_cast<std::size_t>(k)];
      const double d = nearest.distance[static_cast<std::size_t>(k)];
      put(kDistance, d);
      if (!v_.exists(k) || (j >= 0 && !v_.exists(j))) continue;
      put(kVelocityDifference, j >= 0 && d >= kCoincident ? std::abs(v_.speed(j) - v_.speed(k)) / d : kUndefined);
    }
  }

  void scales() {
    const double v = mean(out_.values[kSpeed]), d = mean(out_.values[kDistance]), dt = dt_;
    out_.natural = {v, v / dt, 1 / dt, 1 / (dt * dt), v / (dt * dt), d, d > 0 ? v / d : 0};
  }

  const Tracks& tracks_;
  std::span<const Index> next_;
  double dt_;
  Velocities v_;
  MetricSamples out_;
};

}  // namespace

MetricSamples metric_samples(const Tracks& tracks, const MetricOptions& options) { return Sampler(tracks, options).take(); }

}  // namespace swarmfit
