// SPDX-License-Identifier: MIT
#include "libeval/panel.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "libeval/centre.h"
#include "libeval/jackknife.h"
#include "libeval/metrics.h"
#include "libeval/order.h"
#include "libeval/spacing.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

constexpr double kLagGrowth = 1.12;
constexpr std::size_t kBlocks = 8;

// Everything the panel is made of, as sums over rows or frames.
struct AxisSums {
  double n = 0, x = 0, a = 0, xx = 0, xa = 0, a2 = 0, a3 = 0, a4 = 0;
};
struct Sums {
  std::array<AxisSums, 3> axis;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  double spread_rows = 0, spread_free = 0;  // rows behind the scatter, and less one per frame
  double polarisation = 0, polarised = 0;
  double nearest = 0, spacing = 0;  // sum of distances, sum of n^(-1/dims) over the same rows
  double speed = 0, steps = 0;
  double group_msd = 0, group_msd_n = 0;
  Eigen::ArrayXd vacf, vacf_n, msd, msd_n;

  explicit Sums(const PanelPlan& plan)
      : vacf(Eigen::ArrayXd::Zero(static_cast<Index>(plan.vacf_lags.size()))),
        vacf_n(vacf),
        msd(Eigen::ArrayXd::Zero(static_cast<Index>(plan.msd_lags.size()))),
        msd_n(msd) {}
  // this += sign × other
  void add(const Sums& o, double sign);
};

void Sums::add(const Sums& o, double sign) {
  for (std::size_t k = 0; k < 3; ++k) {
    AxisSums& s = axis[k];
    const AxisSums& t = o.axis[k];
    s.n += sign * t.n, s.x += sign * t.x, s.a += sign * t.a, s.xx += sign * t.xx, s.xa += sign * t.xa;
    s.a2 += sign * t.a2, s.a3 += sign * t.a3, s.a4 += sign * t.a4;
  }
  scatter += sign * o.scatter;
  spread_rows += sign * o.spread_rows, spread_free += sign * o.spread_free;
  polarisation += sign * o.polarisation, polarised += sign * o.polarised;
  nearest += sign * o.nearest, spacing += sign * o.spacing;
  speed += sign * o.speed, steps += sign * o.steps;
  group_msd += sign * o.group_msd, group_msd_n += sign * o.group_msd_n;
  vacf += sign * o.vacf, vacf_n += sign * o.vacf_n, msd += sign * o.msd, msd_n += sign * o.msd_n;
}

// Walks over the tracks once per kind of sum and books every term in the block in which it begins.
class Accumulator {
 public:
  Accumulator(const Tracks& tracks, const PanelPlan& plan, std::size_t blocks)
      : tracks_(tracks), plan_(plan), sums_(blocks, Sums(plan)), entry_(static_cast<std::size_t>(tracks.rows())) {
    const auto frames = tracks.frames();
    for (std::size_t f = 0; f < frames.size(); ++f)
      for (Index row = frames[f].first; row < frames[f].first + frames[f].count; ++row) entry_[static_cast<std::size_t>(row)] = f;
  }

  std::vector<Sums> take() {
    group();
    speeds();
    forces();
    correlations();
    return std::move(sums_);
  }

 private:
  std::size_t block_of_entry(std::size_t f) const { return f * sums_.size() / tracks_.frames().size(); }
  std::size_t entry(Index row) const { return entry_[static_cast<std::size_t>(row)]; }
  Sums& block(Index row) { return sums_[block_of_entry(entry(row))]; }
  Index next(Index row) const { return tracks_.next()[static_cast<std::size_t>(row)]; }
  Eigen::Array3d pos(Index row) const { return tracks_.pos().row(row).transpose(); }

  void group() {
    centroid_ = centroids(tracks_);
    const auto order = order_parameters(tracks_);
    const Nearest nearest = nearest_neighbours(tracks_);
    for (std::size_t f = 0; f < centroid_.size(); ++f) {
      Sums& s = sums_[block_of_entry(f)];
      if (std::isfinite(order.polarisation[f])) s.polarisation += order.polarisation[f], ++s.polarised;
      const FrameRange& frame = tracks_.frames()[f];
      if (frame.count < 2) continue;
      const auto n = static_cast<double>(frame.count);
      s.spread_rows += n;
      s.spread_free += n - 1;
      s.spacing += n * std::pow(n, -1.0 / plan_.dims);
      for (Index row = frame.first; row < frame.first + frame.count; ++row) {
        const Eigen::Vector3d r = (pos(row) - centroid_[f]).matrix();
        s.scatter += r * r.transpose();
        s.nearest += nearest.distance[static_cast<std::size_t>(row)];
      }
    }
  }

  void speeds() {
    for (Index row = 0; row < tracks_.rows(); ++row) {
      const Index after = next(row);
      if (after < 0) continue;
      Sums& s = block(row);
      s.speed += std::sqrt((pos(after) - pos(row)).square().sum()) / plan_.dt;
      ++s.steps;
    }
  }

  void forces() {
    const double dt2 = plan_.dt * plan_.dt;
    for (Index before = 0; before < tracks_.rows(); ++before) {
      const Index row = next(before), after = row < 0 ? -1 : next(row);
      if (after < 0) continue;
      const Eigen::Array3d a = (pos(before) - 2 * pos(row) + pos(after)) / dt2, x = pos(row) - centroid_[entry(row)];
      Sums& sums = block(row);
      for (std::size_t k = 0; k < 3; ++k) {
        AxisSums& s = sums.axis[k];
        const auto axis = static_cast<Index>(k);
        const double xk = x[axis], ak = a[axis], square = ak * ak;
        ++s.n;
        s.x += xk, s.a += ak, s.xx += xk * xk, s.xa += xk * ak, s.a2 += square, s.a3 += square * ak, s.a4 += square * square;
      }
    }
  }

  // Velocity autocorrelation and squared displacement, of each unbroken run.
  void correlations() {
    const auto path = group_path(tracks_);
    drift(path);
    std::vector<Eigen::Array3d> r, v;
    for_each_segment(tracks_, 2, [&](std::span<const Index> rows) {
      r.clear(), v.clear();
      for (const Index row : rows) r.push_back(pos(row) - path[entry(row)]);
      for (std::size_t k = 0; k + 1 < r.size(); ++k) v.emplace_back((r[k + 1] - r[k]) / plan_.dt);
      for (std::size_t j = 0; j < plan_.vacf_lags.size(); ++j)
        lagged(rows, v, plan_.vacf_lags[j], [&](Sums& s, const Eigen::Array3d& a, const Eigen::Array3d& b) {
          s.vacf(static_cast<Index>(j)) += a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
          ++s.vacf_n(static_cast<Index>(j));
        });
      for (std::size_t j = 0; j < plan_.msd_lags.size(); ++j)
        lagged(rows, r, plan_.msd_lags[j], [&](Sums& s, const Eigen::Array3d& a, const Eigen::Array3d& b) {
          s.msd(static_cast<Index>(j)) += (b - a).square().sum();
          ++s.msd_n(static_cast<Index>(j));
        });
    });
  }

  void drift(const std::vector<Eigen::Array3d>& path) {
    const auto lag = static_cast<std::size_t>(plan_.msd_lags.back());
    for (std::size_t f = 0; f + lag < path.size(); ++f) {
      if (tracks_.frames()[f + lag].number - tracks_.frames()[f].number != plan_.msd_lags.back()) continue;  // frames without anybody
      Sums& s = sums_[block_of_entry(f)];
      const Eigen::Array3d step = path[f + lag] - path[f];
      s.group_msd += step[0] * step[0] + step[1] * step[1] + step[2] * step[2];
      ++s.group_msd_n;
    }
  }

  template <class Term>
  void lagged(std::span<const Index> rows, const std::vector<Eigen::Array3d>& values, Index lag, const Term& term) {
    const auto l = static_cast<std::size_t>(lag);
    for (std::size_t k = 0; k + l < values.size(); ++k) term(block(rows[k]), values[k], values[k + l]);
  }

  const Tracks& tracks_;
  const PanelPlan& plan_;
  std::vector<Sums> sums_;
  std::vector<std::size_t> entry_;  // of tracks.frames(), per row
  std::vector<Eigen::Array3d> centroid_;
};

double kurtosis(const AxisSums& s) {
  const double m = s.a / s.n, m2 = s.a2 / s.n - m * m;
  return (s.a4 / s.n - 4 * m * s.a3 / s.n + 6 * m * m * s.a2 / s.n - 3 * m * m * m * m) / (m2 * m2);
}

double stiffness(const AxisSums& s) { return -(s.n * s.xa - s.x * s.a) / (s.n * s.xx - s.x * s.x); }

double nearest_ratio(const Sums& s, int dims) {
  const Eigen::Matrix3d covariance = s.scatter / s.spread_free;
  const double determinant = dims == 3 ? covariance.determinant() : covariance.topLeftCorner<2, 2>().determinant();
  return s.nearest / (poisson_nearest(dims) * std::pow(uniform_volume(determinant, dims), 1.0 / dims) * s.spacing);
}

// First zero of a curve given at some lags; NaN if there is none.
double first_zero(const std::vector<double>& curve, const PanelPlan& plan) {
  for (std::size_t j = 1; j < curve.size(); ++j) {
    if (!std::isfinite(curve[j])) return kNaN;
    if (curve[j] > 0) continue;
    const auto before = static_cast<double>(plan.vacf_lags[j - 1]), here = static_cast<double>(plan.vacf_lags[j]);
    return plan.dt * (before + (here - before) * curve[j - 1] / (curve[j - 1] - curve[j]));
  }
  return kNaN;
}

// In the order of PanelPlan::items().
Panel panel_of(const Sums& s, const PanelPlan& plan) {
  Panel out;
  const auto finite = [](double x) { return std::isfinite(x) ? x : kNaN; };
  for (Index j = 0; j < s.vacf.size(); ++j) out.vacf.push_back(finite((s.vacf(j) / s.vacf_n(j)) / (s.vacf(0) / s.vacf_n(0))));
  const auto axes = static_cast<std::size_t>(plan.dims);
  for (std::size_t k = 0; k < axes; ++k)
    out.values.push_back(std::sqrt(s.scatter(static_cast<Index>(k), static_cast<Index>(k)) / s.spread_rows));
  out.values.push_back(s.speed / s.steps);
  out.values.push_back(first_zero(out.vacf, plan));
  for (Index j = 0; j < s.msd.size(); ++j) out.values.push_back(s.msd(j) / s.msd_n(j));
  out.values.push_back(s.group_msd / s.group_msd_n);
  for (std::size_t k = 0; k < axes; ++k) out.values.push_back(stiffness(s.axis[k]));
  out.values.push_back(s.polarisation / s.polarised);
  out.values.push_back(s.nearest / s.spread_rows);
  out.values.push_back(nearest_ratio(s, plan.dims));
  double sum = 0;
  for (std::size_t k = 0; k < axes; ++k) sum += kurtosis(s.axis[k]);
  out.values.push_back(sum / plan.dims);
  for (double& value : out.values) value = finite(value);
  return out;
}

std::vector<double> jackknife(const std::vector<Panel>& without, std::vector<double> Panel::*part) {
  std::vector<double> out;
  for (std::size_t k = 0; k < (without.front().*part).size(); ++k) {
    std::vector<double> column;
    for (const Panel& p : without) column.push_back((p.*part)[k]);
    out.push_back(swarmfit::jackknife(column));
  }
  return out;
}

}  // namespace

std::vector<PanelItem> PanelPlan::items() const {
  std::vector<PanelItem> out;
  const std::string axes = "xyz";
  for (int k = 0; k < dims; ++k) out.push_back({fmt::format("sd_{}", axes[k]), fmt::format("extent along {} (sd)", axes[k]), 1, 0});
  out.push_back({"speed", "mean speed", 1, -1});
  out.push_back({"vacf_zero", "zero of the velocity autocorrelation", 0, 1});
  for (const Index lag : msd_lags) {
    const double seconds = static_cast<double>(lag) * dt;
    out.push_back({fmt::format("msd_{:.3g}s", seconds), fmt::format("mean squared displacement after {:.3g} s", seconds), 2, 0});
  }
  if (!msd_lags.empty()) {
    const double seconds = static_cast<double>(msd_lags.back()) * dt;
    out.push_back(
        {fmt::format("group_msd_{:.3g}s", seconds), fmt::format("mean squared displacement of the group after {:.3g} s", seconds), 2, 0});
  }
  for (int k = 0; k < dims; ++k) out.push_back({fmt::format("k_{}", axes[k]), fmt::format("restoring slope along {}", axes[k]), 0, -2});
  out.push_back({"polarisation", "polarisation", 0, 0});
  out.push_back({"nearest", "mean distance to the nearest neighbour", 1, 0});
  out.push_back({"nearest_ratio", "nearest distance over that of a Poisson process", 0, 0});
  out.push_back({"kurtosis", "kurtosis of the acceleration", 0, 0});
  return out;
}

PanelPlan panel_plan(const Tracks& recording) {
  PanelPlan plan{recording.dims(), recording.dt(), {0}, {}};
  if (recording.frames().empty()) return plan;
  const Index length = recording.frames().back().number - recording.frames().front().number + 1;
  const Index longest = std::max<Index>(length / 4, 1);
  while (plan.vacf_lags.back() < longest) {
    const auto lag = plan.vacf_lags.back();
    plan.vacf_lags.push_back(std::min(longest, std::max(lag + 1, static_cast<Index>(kLagGrowth * static_cast<double>(lag)))));
  }
  const Index second = std::max<Index>(8, std::lround(1 / recording.dt()));
  for (const Index part : {8, 4, 2, 1}) plan.msd_lags.push_back(second / part);
  return plan;
}

Panel panel(const Tracks& tracks, const PanelPlan& plan) { return panel_of(Accumulator(tracks, plan, 1).take().front(), plan); }

PanelEstimate panel_with_error(const Tracks& tracks, const PanelPlan& plan) {
  const auto blocks = Accumulator(tracks, plan, kBlocks).take();
  Sums all(plan);
  for (const Sums& s : blocks) all.add(s, 1);
  std::vector<Panel> without;
  for (const Sums& s : blocks) {
    Sums rest = all;
    rest.add(s, -1);
    without.push_back(panel_of(rest, plan));
  }
  return {panel_of(all, plan), {jackknife(without, &Panel::values), jackknife(without, &Panel::vacf)}};
}

}  // namespace swarmfit
