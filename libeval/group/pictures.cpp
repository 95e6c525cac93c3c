// SPDX-License-Identifier: MIT
#include "libeval/group/pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libeval/group/even_pairs.h"
#include "libeval/group/order_table.h"
#include "libeval/value_spread.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

using Eigen::Vector3d;
constexpr double kMapReach = 4;   // in mean nearest-neighbour distances
constexpr double kDistances = 2;  // reach of the curves, in rms radii
constexpr std::size_t kBins = 24, kTimes = 80;
constexpr double kMostPairs = 4e6;  // that are looked at in one recording

// A mean per cell.
struct CellMeans {
  std::vector<double> sum, count;
  explicit CellMeans(std::size_t cells) : sum(cells, 0), count(cells, 0) {}
  void add(std::size_t cell, double value) {
    if (std::isfinite(value)) sum[cell] += value, ++count[cell];
  }
  std::vector<double> means() const {
    std::vector<double> out;
    for (std::size_t k = 0; k < sum.size(); ++k) out.push_back(count[k] > 0 ? sum[k] / count[k] : kNaN);
    return out;
  }
};

// Square of a map of this side and reach, or its number of squares where a place lies beyond.
std::size_t square(double across, double along, double reach, std::size_t side) {
  const auto at = [&](double v) { return static_cast<std::int64_t>(std::floor((v / reach + 1) / 2 * static_cast<double>(side))); };
  const std::int64_t x = at(across), y = at(along), n = static_cast<std::int64_t>(side);
  return x < 0 || y < 0 || x >= n || y >= n ? side * side : static_cast<std::size_t>(y * n + x);
}

// How an individual moves at a frame that it steps to and from.
struct Focal {
  Vector3d heading = Vector3d::Zero();  // zero: none
  Vector3d turn = Vector3d::Zero();     // acceleration across the heading, over the speed [1/s]
  double acceleration = 0;              // along the heading [unit/s²]
};

Focal focal_of(const Moment& moment, Index row) {
  const Places& p = moment.places();
  const double dt = moment.options().dt;
  const Vector3d step = p.step.row(row).transpose().matrix(), back = p.back.row(row).transpose().matrix();
  const Vector3d velocity = (step + back) / (2 * dt), force = (step - back) / (dt * dt);
  const double speed = velocity.norm();
  if (!std::isfinite(force.sum()) || !(speed > 0)) return {};
  Focal out;
  out.heading = velocity / speed;
  out.acceleration = force.dot(out.heading);
  out.turn = (force - out.acceleration * out.heading) / speed;
  return out;
}

class Collector {
 public:
  explicit Collector(const PictureGrid& grid)
      : grid_(grid),
        maps_(kMapSide * kMapSide, 0),
        turning_(maps_.size()),
        acceleration_(maps_.size()),
        pairs_(kBins, 0),
        headings_(kBins) {}

  void add(const Moment& moment) {
    if ((moment.places().frame - grid_.first) % grid_.every != 0 || moment.size() < 2 || !(grid_.reach > 0)) return;
    const Index n = moment.size();
    std::vector<Focal> focal;
    for (Index row = 0; row < n; ++row) focal.push_back(focal_of(moment, row));
    all_pairs_ += 0.5 * static_cast<double>(n) * static_cast<double>(n - 1);
    for (Index i = 0; i < n; ++i)
      for (Index j = i + 1; j < n; ++j) {
        const Vector3d way = moment.separation(i, j);
        const Focal &one = focal[static_cast<std::size_t>(i)], &other = focal[static_cast<std::size_t>(j)];
        if (const auto bin = static_cast<std::size_t>(std::min(way.norm() / grid_.width, static_cast<double>(kBins))); bin < kBins) {
          ++pairs_[bin];
          if (one.heading != Vector3d::Zero() && other.heading != Vector3d::Zero()) headings_.add(bin, one.heading.dot(other.heading));
        }
        neighbour(one, way);
        neighbour(other, -way);
      }
  }

  void put(Pictures& out) const {
    double counted = 0;
    for (const double count : maps_) counted += count;
    for (std::size_t cell = 0; cell < maps_.size(); ++cell)
      out.density.push_back(counted > 0 ? maps_[cell] / counted / even_share(cell % kMapSide) : kNaN);
    out.turning = turning_.means(), out.acceleration = acceleration_.means(), out.headings = headings_.means();
    for (std::size_t k = 0; k < kBins; ++k)
      out.pairs.push_back(all_pairs_ > 0 && k < grid_.even.size() && grid_.even[k] > 0 ? pairs_[k] / all_pairs_ / grid_.even[k] : kNaN);
  }

 private:
  // Of an even cloud, in one square of this column: squares in the plane, rings about the heading in space. No share on the left there.
  double even_share(std::size_t column) const {
    constexpr double kSide = kMapSide;
    if (grid_.dims == 2) return 1 / (kSide * kSide);
    const double out = (static_cast<double>(column) + 1) / kSide - 0.5, in = std::max(0.0, static_cast<double>(column) / kSide - 0.5);
    return out > 0 ? (out * out - in * in) / (0.25 * kSide) : kNaN;
  }

  void neighbour(const Focal& focal, const Vector3d& way) {
    const Vector3d& e = focal.heading;
    if (e == Vector3d::Zero()) return;
    const double along = way.dot(e);
    Vector3d right(e[1], -e[0], 0);
    if (grid_.dims != 2) {
      right = way - along * e;
      if (const double aside = right.norm(); aside > 0) right /= aside;
    }
    const std::size_t cell = square(way.dot(right), along, grid_.reach, kMapSide);
    if (cell >= maps_.size()) return;
    ++maps_[cell];
    turning_.add(cell, focal.turn.dot(right));
    acceleration_.add(cell, focal.acceleration);
  }

  const PictureGrid& grid_;
  std::vector<double> maps_;
  CellMeans turning_, acceleration_;
  std::vector<double> pairs_;
  CellMeans headings_;
  double all_pairs_ = 0;
};

// Order over time, and where everybody was.
class Course {
 public:
  explicit Course(const PictureGrid& grid) : grid_(grid), space_(kSpaceSide * kSpaceSide, 0) {
    for (const char* key : {"polarisation", "milling", "extent"}) what_.push_back(find_order_parameter(key));
    means_.assign(what_.size(), CellMeans(grid.times));
  }

  void add(const Moment& moment) {
    const std::int64_t bin = (moment.places().frame - grid_.first) / grid_.stride;
    if (bin >= 0 && bin < static_cast<std::int64_t>(grid_.times))
      for (std::size_t k = 0; k < what_.size(); ++k) means_[k].add(static_cast<std::size_t>(bin), what_[k]->of(moment));
    if (!(grid_.half > 0)) return;
    const Rows& pos = moment.places().pos;
    for (Index row = 0; row < moment.size(); ++row) {
      const std::size_t cell = square(pos(row, 0) - grid_.x, pos(row, 1) - grid_.y, grid_.half, kSpaceSide);
      if (cell < space_.size()) ++space_[cell];
      ++seen_;
    }
  }

  void put(Pictures& out) const {
    out.polarisation = means_[0].means(), out.milling = means_[1].means(), out.spread = means_[2].means();
    for (const double count : space_) out.space.push_back(seen_ > 0 ? count * static_cast<double>(space_.size()) / seen_ : kNaN);
  }

 private:
  const PictureGrid& grid_;
  std::vector<const OrderParameter*> what_;
  std::vector<CellMeans> means_;
  std::vector<double> space_;
  double seen_ = 0;
};

}  // namespace

PictureGrid picture_grid(const Tracks& recording) {
  PictureGrid grid;
  grid.plan = panel_plan(recording);
  grid.plan.msd_lags.assign(grid.plan.vacf_lags.begin() + (grid.plan.vacf_lags.empty() ? 0 : 1), grid.plan.vacf_lags.end());
  grid.dims = recording.meta().dims;
  grid.dt = recording.meta().dt;
  if (recording.frames().empty()) return grid;
  grid.first = recording.frames().front().number;
  const std::int64_t frames = recording.frames().back().number - grid.first + 1;
  grid.stride = (frames + static_cast<std::int64_t>(kTimes) - 1) / static_cast<std::int64_t>(kTimes);
  grid.times = static_cast<std::size_t>((frames + grid.stride - 1) / grid.stride);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double rows = 0, nearest = 0, neighbours = 0, pairs = 0;
  for_each_moment(recording, moment_options(recording), [&](const Moment& moment) {
    if (moment.size() < 2) return;
    pairs += 0.5 * static_cast<double>(moment.size()) * static_cast<double>(moment.size() - 1);
    for (const Vector3d& r : moment.offsets()) covariance += r * r.transpose(), ++rows;
    for (const double d : moment.nearest().distance) nearest += d, ++neighbours;
  });
  if (rows > 0) covariance /= rows, grid.reach = kMapReach * nearest / neighbours;
  grid.width = kDistances * std::sqrt(covariance.trace()) / static_cast<double>(kBins);
  if (grid.width > 0) grid.even = even_pairs(covariance, grid.dims, grid.width, kBins);
  if (!(grid.width > 0)) grid.reach = 0;
  grid.every = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(pairs / kMostPairs)));
  const Rows& pos = recording.pos();
  const Eigen::Array2d low = pos.leftCols(2).colwise().minCoeff().transpose(), high = pos.leftCols(2).colwise().maxCoeff().transpose();
  grid.x = 0.5 * (low[0] + high[0]), grid.y = 0.5 * (low[1] + high[1]);
  grid.half = 0.5 * (high - low).maxCoeff() * (1 + 1e-9);
  return grid;
}

Pictures pictures(const Tracks& tracks, const PictureGrid& grid) {
  Pictures out;
  if (tracks.frames().empty()) return out;
  Collector collector(grid);
  Course course(grid);
  for_each_moment(tracks, moment_options(tracks), [&](const Moment& moment) {
    collector.add(moment);
    course.add(moment);
  });
  collector.put(out);
  course.put(out);
  if (grid.plan.msd_lags.empty()) return out;  // too short for any delay
  Panel lagged = panel(tracks, grid.plan);
  out.vacf = std::move(lagged.vacf);
  const std::size_t first = static_cast<std::size_t>(grid.dims) + 2;  // in items(): after the extents, the speed and the zero
  for (std::size_t k = 0; k < grid.plan.msd_lags.size(); ++k) out.msd.push_back(lagged.values[first + k]);
  return out;
}

PictureSpread picture_spread(const std::vector<Pictures>& all) { return {summarised(all, mean_of), summarised(all, sd_of)}; }

}  // namespace swarmfit
