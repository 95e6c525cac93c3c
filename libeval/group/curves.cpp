// SPDX-License-Identifier: MIT
#include "libeval/group/curves.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "libeval/group/even_pairs.h"
#include "libeval/jackknife.h"
#include "libeval/panel.h"
#include "libtrack/cut.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

using Eigen::Vector3d;
constexpr std::size_t kBlocks = 8, kBins = 30;
constexpr double kReach = 2;     // distances up to so many rms radii
constexpr double kMapReach = 3;  // of the neighbour map, in mean nearest-neighbour distances
constexpr int kMapSide = 21;

// Sums of one block of time; all of them add up.
struct Sums {
  std::vector<double> pairs, product, products, force, at_radius;
  double square = 0, movers = 0;  // u² and how many
  double frames_pairs = 0;        // n (n - 1) / 2 over the frames
  Sums() : pairs(kBins, 0), product(kBins, 0), products(kBins, 0), force(kBins, 0), at_radius(kBins, 0) {}
  void add(const Sums& o, double sign) {
    for (std::size_t k = 0; k < kBins; ++k) {
      pairs[k] += sign * o.pairs[k], product[k] += sign * o.product[k], products[k] += sign * o.products[k];
      force[k] += sign * o.force[k], at_radius[k] += sign * o.at_radius[k];
    }
    square += sign * o.square, movers += sign * o.movers, frames_pairs += sign * o.frames_pairs;
  }
};

// What must be known before anything can be binned.
struct Sizes {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double rows = 0, nearest = 0, extent = 0;
};

Sizes sizes_of(const Tracks& tracks, const MomentOptions& options) {
  Sizes s;
  double neighbours = 0;
  for_each_moment(tracks, options, [&](const Moment& moment) {
    if (moment.size() < 2) return;
    for (const Vector3d& r : moment.offsets()) s.covariance += r * r.transpose(), ++s.rows;
    for (const double d : moment.nearest().distance) s.nearest += d, ++neighbours;
  });
  if (s.rows > 0) s.covariance /= s.rows, s.nearest /= neighbours;
  s.extent = std::sqrt(s.covariance.trace());
  return s;
}

class Collector {
 public:
  Collector(const Sizes& sizes, std::int64_t first, std::int64_t last) : sizes_(sizes), first_(first), frames_(last - first + 1) {
    map_.side = kMapSide;
    map_.reach = kMapReach * sizes.nearest;
    map_.density.assign(std::size_t{kMapSide} * kMapSide, 0);
  }

  void add(const Moment& moment) {
    if (moment.size() < 2) return;
    const auto kBlock = static_cast<std::int64_t>(kBlocks);
    Sums& s = blocks_[static_cast<std::size_t>((moment.places().frame - first_) * kBlock / frames_)];
    pairs(moment, s);
    forces(moment, s);
    neighbours(moment);
  }

  const std::array<Sums, kBlocks>& blocks() const { return blocks_; }
  double width() const { return kReach * sizes_.extent / static_cast<double>(kBins); }

  NeighbourMap map() const {
    NeighbourMap out = map_;
    const double even = out.counted / static_cast<double>(out.density.size());
    for (double& d : out.density) d = even > 0 ? d / even : kNaN;
    out.ahead = heads_ > 0 ? ahead_ / heads_ : kNaN;
    out.left = sided_ > 0 ? left_ / sided_ : kNaN;
    return out;
  }

 private:
  std::size_t bin(double distance) const { return static_cast<std::size_t>(std::min(distance / width(), static_cast<double>(kBins))); }

  void pairs(const Moment& moment, Sums& s) {
    const auto n = static_cast<std::size_t>(moment.size());
    std::vector<Vector3d> u(n, Vector3d::Constant(kNaN));
    const Motion& m = moment.motion();
    for (std::size_t k = 0; k < m.row.size() && m.row.size() > 1; ++k) {
      Vector3d& mine = u[static_cast<std::size_t>(m.row[k])];
      mine = (m.step[k] - m.mean_step) / moment.options().dt;
      s.square += mine.squaredNorm(), ++s.movers;
    }
    s.frames_pairs += 0.5 * static_cast<double>(n) * static_cast<double>(n - 1);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j) {
        const std::size_t b = bin(moment.separation(static_cast<Index>(i), static_cast<Index>(j)).norm());
        if (b >= kBins) continue;
        ++s.pairs[b];
        if (const double product = u[i].dot(u[j]); std::isfinite(product)) s.product[b] += product, ++s.products[b];
      }
  }

  void forces(const Moment& moment, Sums& s) const {
    const Places& p = moment.places();
    const double dt2 = moment.options().dt * moment.options().dt;
    for (Index row = 0; row < moment.size(); ++row) {
      const Vector3d a = (p.step.row(row) - p.back.row(row)).transpose().matrix() / dt2;
      const Vector3d& r = moment.offsets()[static_cast<std::size_t>(row)];
      const double radius = r.norm();
      const std::size_t b = bin(radius);
      if (!std::isfinite(a.sum()) || !(radius > 0) || b >= kBins) continue;
      s.force[b] += a.dot(r) / radius;
      ++s.at_radius[b];
    }
  }

  // In the frame of the focal individual: ahead is up, its left is left. In space the map is turned about the heading until the neighbour
  // lies to the right, so that the left half is empty.
  void neighbours(const Moment& moment) {
    if (!(map_.reach > 0)) return;
    const Motion& m = moment.motion();
    for (std::size_t k = 0; k < m.row.size(); ++k) {
      const Index row = m.row[k], other = moment.nearest().row[static_cast<std::size_t>(row)];
      if (other < 0 || m.heading[k] == Vector3d::Zero()) continue;
      const Vector3d& e = m.heading[k];
      const Vector3d way = moment.separation(row, other);
      const bool plane = moment.options().dims == 2;
      const double along = way.dot(e), across = plane ? e[1] * way[0] - e[0] * way[1] : (way - along * e).norm();
      ++heads_, ahead_ += along > 0;
      if (plane) ++sided_, left_ += across < 0;
      const auto square = [&](double x) { return static_cast<int>(std::floor((x / map_.reach + 1) / 2 * kMapSide)); };
      const int x = square(across), y = square(along);
      if (x < 0 || y < 0 || x >= kMapSide || y >= kMapSide) continue;
      ++map_.density[static_cast<std::size_t>(y) * kMapSide + static_cast<std::size_t>(x)];
      ++map_.counted;
    }
  }

  const Sizes& sizes_;
  std::int64_t first_, frames_;
  std::array<Sums, kBlocks> blocks_;
  NeighbourMap map_;
  double heads_ = 0, ahead_ = 0, sided_ = 0, left_ = 0;
};

// Every curve of these sums: values, in the order of `out`.
struct Values {
  std::vector<double> g, c, force;
  double length = kNaN;
};

Values values_of(const Sums& s, const std::vector<double>& even, double width) {
  Values v;
  for (std::size_t k = 0; k < kBins; ++k) {
    v.g.push_back(even[k] > 0 && s.frames_pairs > 0 ? s.pairs[k] / s.frames_pairs / even[k] : kNaN);
    v.c.push_back(s.products[k] > 0 && s.square > 0 ? s.product[k] / s.products[k] / (s.square / s.movers) : kNaN);
    v.force.push_back(s.at_radius[k] > 0 ? s.force[k] / s.at_radius[k] : kNaN);
  }
  double before_r = 0, before_c = 1;
  for (std::size_t k = 0; k < kBins; ++k) {
    const double r = (static_cast<double>(k) + 0.5) * width;
    if (!std::isfinite(v.c[k])) continue;
    if (v.c[k] <= 0) {
      v.length = before_r + (r - before_r) * before_c / (before_c - v.c[k]);
      break;
    }
    before_r = r, before_c = v.c[k];
  }
  return v;
}

void add_curve(GroupCurves& out, GroupCurve like, const Values& all, const std::vector<Values>& without, std::vector<double> Values::*part,
               double width) {
  for (std::size_t k = 0; k < kBins; ++k) {
    if (!std::isfinite((all.*part)[k])) continue;
    std::vector<double> others;
    for (const Values& w : without) others.push_back((w.*part)[k]);
    like.x.push_back((static_cast<double>(k) + 0.5) * width);
    like.y.push_back((all.*part)[k]);
    like.se.push_back(jackknife(others));
  }
  if (!like.x.empty()) out.curves.push_back(std::move(like));
}

// Those of the panel, at all its lags.
void add_lagged(GroupCurves& out, const Tracks& tracks) {
  PanelPlan plan = panel_plan(tracks);
  if (plan.vacf_lags.size() < 2) return;
  plan.msd_lags.assign(plan.vacf_lags.begin() + 1, plan.vacf_lags.end());
  const PanelEstimate found = panel_with_error(tracks, plan);
  GroupCurve vacf{"vacf", "velocity autocorrelation", "time", 0, 1, 0, 0, {}, {}, {}},
      msd{"msd", "mean squared displacement", "time", 0, 1, 2, 0, {}, {}, {}};
  for (std::size_t k = 0; k < plan.vacf_lags.size(); ++k) {
    if (!std::isfinite(found.value.vacf[k])) continue;
    vacf.x.push_back(static_cast<double>(plan.vacf_lags[k]) * plan.dt);
    vacf.y.push_back(found.value.vacf[k]), vacf.se.push_back(found.se.vacf[k]);
  }
  const auto first = static_cast<std::size_t>(plan.dims) + 2;  // in items(): after the extents, the speed and the zero
  for (std::size_t k = 0; k < plan.msd_lags.size(); ++k) {
    if (!std::isfinite(found.value.values[first + k])) continue;
    msd.x.push_back(static_cast<double>(plan.msd_lags[k]) * plan.dt);
    msd.y.push_back(found.value.values[first + k]), msd.se.push_back(found.se.values[first + k]);
  }
  for (GroupCurve* curve : {&vacf, &msd})
    if (!curve->x.empty()) out.curves.push_back(std::move(*curve));
}

}  // namespace

GroupCurves group_curves(const Tracks& tracks, const MomentOptions& options) {
  GroupCurves out;
  out.correlation_length = out.correlation_length_se = kNaN;
  if (tracks.frames().empty()) return out;
  const Sizes sizes = sizes_of(tracks, options);
  if (sizes.extent > 0) {
    Collector collector(sizes, tracks.frames().front().number, tracks.frames().back().number);
    for_each_moment(tracks, options, [&](const Moment& moment) { collector.add(moment); });
    const double width = collector.width();
    const auto even = even_pairs(sizes.covariance, options.dims, width, kBins);
    Sums total;
    for (const Sums& s : collector.blocks()) total.add(s, 1);
    std::vector<Values> without;
    std::vector<double> lengths;
    for (const Sums& s : collector.blocks()) {
      Sums rest = total;
      rest.add(s, -1);
      without.push_back(values_of(rest, even, width));
      lengths.push_back(without.back().length);
    }
    const Values all = values_of(total, even, width);
    out.correlation_length = all.length, out.correlation_length_se = jackknife(lengths);
    add_curve(out, {"g_r", "pair distribution g(r)", "distance", 1, 0, 0, 0, {}, {}, {}}, all, without, &Values::g, width);
    add_curve(out, {"fluctuation_corr", "correlation of velocity fluctuations", "distance", 1, 0, 0, 0, {}, {}, {}}, all, without,
              &Values::c, width);
    add_curve(out, {"radial_force", "effective radial force", "distance from the centroid", 1, 0, 1, -2, {}, {}, {}}, all, without,
              &Values::force, width);
    out.map = collector.map();
  }
  options.kind ? add_lagged(out, of_kind(tracks, *options.kind)) : add_lagged(out, tracks);
  return out;
}

}  // namespace swarmfit
