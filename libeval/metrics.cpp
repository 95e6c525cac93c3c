// SPDX-License-Identifier: MIT
#include "libeval/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "libeval/angles.h"
#include "libeval/row_blocks.h"
#include "libtrack/cut.h"
#include "libtrack/error.h"
#include "libtrack/hot.h"
#include "libtrack/nan.h"
#include "libtrack/quantile.h"

namespace swarmfit {

namespace {

constexpr double kStill = 1e-9;       // of the median speed: slower than this has no direction
constexpr double kCoincident = 1e-9;  // [unit]: closer than this is the same place

using Axes = std::array<std::vector<double>, 3>;
using Blocks = std::vector<RowBlock>;

SWARMFIT_HOT void subtract(const double* from, const double* what, Index count, double* out) {
  for (Index k = 0; k < count; ++k) out[k] = from[k] - what[k];
}
SWARMFIT_HOT void divide(double* values, double by, Index count) {
  for (Index k = 0; k < count; ++k) values[k] /= by;
}
SWARMFIT_HOT void lengths(const double* x, const double* y, const double* z, Index count, double* out) {
  for (Index k = 0; k < count; ++k) out[k] = std::sqrt(x[k] * x[k] + y[k] * y[k] + z[k] * z[k]);
}
SWARMFIT_HOT bool all_finite(const double* values, Index count) {
  constexpr double most = std::numeric_limits<double>::max();
  std::int64_t wild = 0;
  for (Index k = 0; k < count; ++k) wild += std::abs(values[k]) <= most ? 0 : 1;
  return wild == 0;
}

// |a × b| and a · b, for the angle between: exact near 0 and pi, where the arc cosine is not.
SWARMFIT_HOT void products(const double* ax, const double* ay, const double* az, const double* bx, const double* by, const double* bz,
                           Index count, double* cross, double* dot) {
  for (Index k = 0; k < count; ++k) {
    const double x = ay[k] * bz[k] - az[k] * by[k], y = az[k] * bx[k] - ax[k] * bz[k], z = ax[k] * by[k] - ay[k] * bx[k];
    cross[k] = std::sqrt(x * x + y * y + z * z);
    dot[k] = ax[k] * bx[k] + ay[k] * by[k] + az[k] * bz[k];
  }
}

// The row `lag` frames later in the same unbroken run, per row; -1 where there is none.
std::vector<Index> rows_ahead(const Tracks& tracks, int lag) {
  std::vector<Index> ahead(static_cast<std::size_t>(tracks.rows()), -1);
  const auto l = static_cast<std::size_t>(lag);
  for_each_segment(tracks, lag + 1, [&](std::span<const Index> run) {
    for (std::size_t k = 0; k + l < run.size(); ++k) ahead[static_cast<std::size_t>(run[k])] = run[k + l];
  });
  return ahead;
}

// Velocity and speed per row, whichever way velocities are got: differences along `links`, whose ends lie dt later, or recorded.
class Velocities {
 public:
  Velocities(const Tracks& tracks, VelocitySource source, const Blocks& links, double dt) {
    const auto n = static_cast<std::size_t>(tracks.rows());
    rows_ = source == VelocitySource::recorded ? Blocks{{0, tracks.rows(), 0}} : links;
    speed_.resize(n);
    exists_.assign(n, false);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<double>& v = v_[axis];
      v.resize(n);
      if (source == VelocitySource::recorded) {
        std::copy_n(tracks.vel().col(static_cast<Index>(axis)).data(), n, v.begin());
        continue;
      }
      const double* x = tracks.pos().col(static_cast<Index>(axis)).data();
      for (const auto& [first, count, shift] : rows_) {
        subtract(x + first + shift, x + first, count, &v[static_cast<std::size_t>(first)]);
        divide(&v[static_cast<std::size_t>(first)], dt, count);
      }
    }
    for (const auto& [first, count, shift] : rows_) {
      lengths(at(0, first), at(1, first), at(2, first), count, &speed_[static_cast<std::size_t>(first)]);
      std::fill_n(exists_.begin() + first, count, true);
    }
  }

  const Blocks& rows() const { return rows_; }  // that have one
  bool exists(Index row) const { return exists_[static_cast<std::size_t>(row)] != 0; }
  const double* at(std::size_t axis, Index row) const { return &v_[axis][static_cast<std::size_t>(row)]; }
  const double* speed(Index row) const { return &speed_[static_cast<std::size_t>(row)]; }

 private:
  Blocks rows_;
  Axes v_;
  std::vector<double> speed_;
  std::vector<std::uint8_t> exists_;
};

// The speed below which a direction is meaningless. The median is only needed when somebody is that slow.
double still_speed(const std::vector<double>& defined) {
  if (defined.empty()) return 0;
  const auto [low, high] = std::minmax_element(defined.begin(), defined.end());
  if (*low >= kStill * *high) return 0;
  return kStill * median(defined);
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
  // Of rows one after the other.
  void put(std::size_t column, Index first, const double* values, Index count) {
    if (!all_finite(values, count)) {
      for (Index k = 0; k < count; ++k) put(column, first + k, values[k]);
      return;
    }
    out_.values[column].insert(out_.values[column].end(), values, values + count);
    if (!keep_rows_) return;
    for (Index k = 0; k < count; ++k) out_.rows[column].push_back(first + k);
  }
  MetricSamples& samples() { return out_; }

 private:
  MetricSamples& out_;
  bool keep_rows_;
};

// The columns of one lag, the first of which is `first`. `links` end one lag later, after the time dt.
class Motion {
 public:
  Motion(const Velocities& v, const Blocks& links, double dt, std::size_t first, Book& book)
      : v_(v), turning_(blocks_into(links, v.rows())), jerking_(blocks_into(turning_, turning_)), dt_(dt), first_(first), book_(book) {}

  void take() {
    for (const auto& [row, count, shift] : v_.rows()) book_.put(first_ + kSpeed, row, v_.speed(row), count);
    const std::size_t rows = turning_.empty() ? 0 : static_cast<std::size_t>(turning_.back().first + turning_.back().count);
    accelerations(rows);
    turns(rows);
    const double v = mean(book_.samples().values[first_ + kSpeed]), dt = dt_;
    const std::array<double, kMotionMetrics> natural = {v, v / dt, 1 / dt, 1 / (dt * dt), v / (dt * dt)};
    std::copy(natural.begin(), natural.end(), book_.samples().natural.begin() + static_cast<std::ptrdiff_t>(first_));
  }

 private:
  // Where a block has its results until they are booked.
  double* scratch(std::size_t which, Index count) {
    scratch_[which].resize(std::max(scratch_[which].size(), static_cast<std::size_t>(count)));
    return scratch_[which].data();
  }

  // a and mu
  void accelerations(std::size_t rows) {
    Axes change;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      change[axis].resize(rows);
      for (const auto& [row, count, shift] : turning_)
        subtract(v_.at(axis, row + shift), v_.at(axis, row), count, &change[axis][static_cast<std::size_t>(row)]);
    }
    for (const auto& [row, count, shift] : turning_) {
      const auto k = static_cast<std::size_t>(row);
      double* a = scratch(0, count);
      lengths(&change[0][k], &change[1][k], &change[2][k], count, a);
      divide(a, dt_, count);
      book_.put(first_ + kAcceleration, row, a, count);
    }
    for (const auto& [row, count, shift] : jerking_) {
      double* difference[3];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        difference[axis] = scratch(axis, count);
        subtract(&change[axis][static_cast<std::size_t>(row + shift)], &change[axis][static_cast<std::size_t>(row)], count,
                 difference[axis]);
      }
      lengths(difference[0], difference[1], difference[2], count, difference[0]);
      divide(difference[0], dt_ * dt_, count);
      book_.put(first_ + kJerk, row, difference[0], count);
    }
  }

  // omega and alpha
  void turns(std::size_t rows) {
    const double still = still_speed(book_.samples().values[first_ + kSpeed]);
    std::vector<double> omega(rows);
    for (const auto& [row, count, shift] : turning_) {
      double *cross = scratch(0, count), *dot = scratch(1, count), *now = &omega[static_cast<std::size_t>(row)];
      products(v_.at(0, row), v_.at(1, row), v_.at(2, row), v_.at(0, row + shift), v_.at(1, row + shift), v_.at(2, row + shift), count,
               cross, dot);
      angles(cross, dot, count, now);
      divide(now, dt_, count);
      for (Index k = 0; k < count; ++k)
        if (const double slower = std::min(*v_.speed(row + k), *v_.speed(row + shift + k)); !(slower > 0 && slower >= still)) now[k] = kNaN;
      book_.put(first_ + kAngularVelocity, row, now, count);
    }
    for (const auto& [row, count, shift] : jerking_) {
      double* alpha = scratch(0, count);
      subtract(&omega[static_cast<std::size_t>(row + shift)], &omega[static_cast<std::size_t>(row)], count, alpha);
      divide(alpha, dt_, count);
      book_.put(first_ + kAngularAcceleration, row, alpha, count);
    }
  }

  const Velocities& v_;
  Blocks turning_, jerking_;  // rows that have a velocity one link later, and one after that
  double dt_;
  std::size_t first_;
  Book& book_;
  std::array<std::vector<double>, 3> scratch_;
};

// d and eta; v: from one frame to the next.
void neighbours(const Tracks& tracks, const Velocities& v, Book& out) {
  const Nearest nearest = nearest_neighbours(tracks);
  for (Index k = 0; k < tracks.rows(); ++k) {
    const Index j = nearest.row[static_cast<std::size_t>(k)];
    const double d = nearest.distance[static_cast<std::size_t>(k)];
    out.put(kDistance, k, d);
    if (!v.exists(k) || (j >= 0 && !v.exists(j))) continue;
    out.put(kVelocityDifference, k, j >= 0 && d >= kCoincident ? std::abs(*v.speed(j) - *v.speed(k)) / d : kNaN);
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
  const Blocks links = blocks_of(tracks.next());
  const Velocities now(tracks, options.velocity, links, dt);
  std::size_t first = 0;
  for (const int lag : options.lags) {
    if (lag == 1) {
      Motion(now, links, dt, first, book).take();
    } else {
      const Blocks ahead = blocks_of(rows_ahead(tracks, lag));
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
