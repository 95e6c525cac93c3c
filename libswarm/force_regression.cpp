// SPDX-License-Identifier: MIT
#include "libswarm/force_regression.h"

#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace swarmfit {
namespace {

using Eigen::Array3d;
using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr Index kMostRows = 40000;  // more say nothing new
constexpr Index kWindows = 8;       // of a longer recording
constexpr Index kLag = 4;           // frames between a force and its instruments
constexpr Index kFirstSeen = 3;     // autocovariance without localisation error, in frames
constexpr Index kLastSeen = 40;
constexpr std::size_t kFewestSeen = 4, kSureToBeSeen = 15;
constexpr double kQuantiles[] = {0.02, 0.1, 0.25, 0.45, 0.7, 0.98};  // of distances of pairs, for knots
constexpr double kCommon = 0.99;                                     // of speeds and distances
constexpr double kAlpha = 0.05;
constexpr double kSigmas = 4;                 // of chance, for memory
constexpr Index kPiece = 50;                  // frames of a track that count as one observation
constexpr double kLongest = 60;               // memory, in frames
constexpr int kMemories = 24, kHalvings = 8;  // that are tried
constexpr double kDoubled = 2, kAgrees = 0.05;

double at_quantile(std::vector<double> values, double q) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

Array3d place(const Tracks& tracks, Index row) { return tracks.pos().row(row).transpose(); }

// Every how many frames pairs are looked at.
std::size_t stride(const Tracks& tracks) { return std::max<std::size_t>(1, tracks.frames().size() / 100); }

std::vector<double> pair_distances(const Tracks& tracks) {
  std::vector<double> out;
  for (std::size_t f = 0; f < tracks.frames().size(); f += stride(tracks)) {
    const FrameRange& frame = tracks.frames()[f];
    const Index some = std::max<Index>(1, frame.count / 100);
    for (Index i = 0; i < frame.count; i += some)
      for (Index j = i + 1; j < frame.count; ++j) {
        const double d = std::sqrt((place(tracks, frame.first + i) - place(tracks, frame.first + j)).square().sum());
        if (d > 0) out.push_back(d);
      }
  }
  return out;
}

// Which frames are used: all, or the beginnings of equal parts of a long recording.
class Windows {
 public:
  explicit Windows(const Tracks& tracks) {
    if (tracks.rows() <= kMostRows) return;
    first_ = tracks.frames().front().number;
    length_ = std::max<std::int64_t>(1, (tracks.frames().back().number - first_ + 1) / kWindows);
    used_ = static_cast<std::int64_t>(static_cast<double>(length_) * static_cast<double>(kMostRows) / static_cast<double>(tracks.rows()));
  }
  bool hold(std::int64_t frame) const { return length_ == 0 || (frame - first_) % length_ < used_; }

 private:
  std::int64_t first_ = 0, length_ = 0, used_ = 0;
};

// An unbroken run of accelerations: rows of the design.
struct Run {
  Index first, count;
};

// Symmetric differences, and who they are of.
class Motion {
 public:
  Motion(const Tracks& tracks, const Windows& windows) : number_(static_cast<std::size_t>(tracks.rows()), -1) {
    std::vector<Index> before, here, after;
    for_each_segment(tracks, 3, [&](std::span<const Index> run) {
      Run now{static_cast<Index>(here.size()), 0};
      const auto close = [&] {
        if (now.count > 0) runs_.push_back(now);
        now = {static_cast<Index>(here.size()), 0};
      };
      for (std::size_t k = 1; k + 1 < run.size(); ++k) {
        if (!windows.hold(tracks.frame()[static_cast<std::size_t>(run[k])])) {
          close();
          continue;
        }
        number_[static_cast<std::size_t>(run[k])] = static_cast<Index>(here.size());
        before.push_back(run[k - 1]), here.push_back(run[k]), after.push_back(run[k + 1]);
        ++now.count;
      }
      close();
    });
    const auto n = static_cast<Index>(here.size());
    const double dt = tracks.dt();
    x_.resize(n, 3), v_.resize(n, 3), a_.resize(n, 3);
    for (Index u = 0; u < n; ++u) {
      const auto k = static_cast<std::size_t>(u);
      const Array3d b = place(tracks, before[k]), h = place(tracks, here[k]), a = place(tracks, after[k]);
      x_.row(u) = ((b + h + a) / 3).transpose();
      v_.row(u) = ((a - b) / (2 * dt)).transpose();
      a_.row(u) = ((a - 2 * h + b) / (dt * dt)).transpose();
    }
  }

  Index rows() const { return x_.rows(); }
  Index number(Index row) const { return number_[static_cast<std::size_t>(row)]; }  // of a row of the tracks; -1: has no differences
  const std::vector<Run>& runs() const { return runs_; }
  Array3d x(Index u) const { return x_.row(u).transpose(); }
  Array3d v(Index u) const { return v_.row(u).transpose(); }
  const Rows& acceleration() const { return a_; }

 private:
  std::vector<Index> number_;
  std::vector<Run> runs_;
  Rows x_, v_, a_;
};

// What every term is at every place: per axis, rows x coefficients.
using Design = std::array<MatrixXd, 3>;

class DesignOf {
 public:
  DesignOf(const ForceBasis& basis, const Motion& motion) : basis_(basis), motion_(motion) {
    for (std::size_t g = 0; g < kForceGroups; ++g) first_[g] = static_cast<Index>(basis.first(static_cast<ForceGroup>(g)));
    for (int axis = 0; axis < basis.dims; ++axis)
      design_[static_cast<std::size_t>(axis)] = MatrixXd::Zero(motion.rows(), static_cast<Index>(basis.size()));
  }

  Design take(const Tracks& tracks) && {
    for (Index u = 0; u < motion_.rows(); ++u) alone(u);
    if (basis_.kernel_size() > 0)
      for (const FrameRange& frame : tracks.frames()) pairs(tracks, frame);
    return std::move(design_);
  }

 private:
  void add(Index u, ForceGroup group, std::size_t k, const Array3d& value) {
    for (int axis = 0; axis < basis_.dims; ++axis)
      design_[static_cast<std::size_t>(axis)](u, first_[static_cast<std::size_t>(group)] + static_cast<Index>(k)) += value[axis];
  }

  void alone(Index u) {
    const Array3d v = motion_.v(u), x = motion_.x(u) - basis_.centre;
    const double speed = std::min(std::sqrt(v.square().sum()), basis_.top_speed);
    const double distance = std::min(std::sqrt(x.square().sum()), basis_.reach);
    add(u, ForceGroup::drag, 0, v);
    add(u, ForceGroup::speed_drag, 0, speed * v);
    add(u, ForceGroup::speed_drag, 1, speed * speed * v);
    add(u, ForceGroup::hardening, 0, distance * distance * x);
    for (int axis = 0; axis < basis_.dims; ++axis) {
      Array3d along = Array3d::Zero();
      along[axis] = 1;
      add(u, ForceGroup::confinement, static_cast<std::size_t>(axis), along * x);
      add(u, ForceGroup::push, static_cast<std::size_t>(axis), along);
    }
  }

  void pairs(const Tracks& tracks, const FrameRange& frame) {
    for (Index i = 0; i < frame.count; ++i)
      for (Index j = i + 1; j < frame.count; ++j) pair(tracks, frame.first + i, frame.first + j);
  }

  // Somebody whose differences are not known acts from where he was seen, and aligns nobody.
  void pair(const Tracks& tracks, Index row, Index other) {
    const Index u = motion_.number(row), w = motion_.number(other);
    if (u < 0 && w < 0) return;
    const auto where = [&](Index n, Index r) { return n >= 0 ? motion_.x(n) : place(tracks, r); };
    const Array3d away = where(w, other) - where(u, row);
    const double distance = std::sqrt(away.square().sum());
    const auto [first, weight, next] = basis_.hat(distance);
    if (!(distance > 0) || (weight == 0 && next == 0)) return;
    const Array3d towards = away / distance;
    const Array3d difference = u >= 0 && w >= 0 ? Array3d(motion_.v(w) - motion_.v(u)) : Array3d::Zero();
    const auto both = [&](std::size_t k, double by) {
      if (by == 0) return;
      if (u >= 0) add(u, ForceGroup::pair, k, by * towards), add(u, ForceGroup::alignment, k, by * difference);
      if (w >= 0) add(w, ForceGroup::pair, k, -by * towards), add(w, ForceGroup::alignment, k, -by * difference);
    };
    both(first, weight);
    if (next > 0) both(first + 1, next);
  }

  const ForceBasis& basis_;
  const Motion& motion_;
  std::array<Index, kForceGroups> first_{};
  Design design_;
};

// Sums that the regression needs, for any memory of the noise.
struct Moments {
  MatrixXd now, before;  // instruments · terms of the same and of the preceding frame
  VectorXd a_now, a_before;
};

// Noise that remembers: variance per axis, and by what it shrinks in a frame.
struct Memory {
  double rho = 0;
  Array3d variance = Array3d::Zero();
};

// Autocovariance of Ornstein-Uhlenbeck noise in second differences over dt², by the same of the noise itself: shift 0 or 1. x: dt over the
// memory. It is the fourth difference of g with g'''' = exp(-x|u|).
double seen_memory(double x, int shift) {
  if (x < 0.05) return std::exp(-x * shift);
  const auto g = [x](double u) { return std::exp(-x * u) / std::pow(x, 4) + u / std::pow(x, 3) + u * u * u / (6 * x); };
  return shift == 0 ? 6 * g(0) - 8 * g(1) + 2 * g(2) : g(3) - 4 * g(2) + 7 * g(1) - 4 * g(0);
}
// The same from a shift of two frames on: what exp(-x shift) is multiplied by.
double seen_later(double x) { return x < 1e-6 ? 1 : std::pow(2 * std::sinh(x / 2) / x, 4); }

class Regression {
 public:
  Regression(const ForceBasis& basis, const Motion& motion, Design design, double dt)
      : basis_(basis), motion_(motion), design_(std::move(design)), dt_(dt) {
    const auto n = static_cast<Index>(basis.size());
    scale_ = VectorXd::Zero(n);
    for (int axis = 0; axis < basis.dims; ++axis) scale_ += of(axis).colwise().squaredNorm().transpose();
    scale_ = scale_.cwiseSqrt() / std::sqrt(static_cast<double>(std::max<Index>(1, motion.rows())));
    moments_ = {MatrixXd::Zero(n, n), MatrixXd::Zero(n, n), VectorXd::Zero(n), VectorXd::Zero(n)};
    for (int axis = 0; axis < basis.dims; ++axis)
      for (const Run& run : long_runs()) {
        const Index some = run.count - kLag;
        const auto z = of(axis).middleRows(run.first, some);
        moments_.now += z.transpose() * of(axis).middleRows(run.first + kLag, some);
        moments_.before += z.transpose() * of(axis).middleRows(run.first + kLag - 1, some);
        moments_.a_now += z.transpose() * acceleration(axis, run.first + kLag, some);
        moments_.a_before += z.transpose() * acceleration(axis, run.first + kLag - 1, some);
        rows_ += axis == 0 ? some : 0;
      }
  }

  Index rows() const { return rows_; }
  const Memory& memory() const { return memory_; }
  const VectorXd& coefficients() const { return theta_; }
  const MatrixXd& covariance() const { return covariance_; }
  double condition() const { return condition_; }

  // Forces of these groups alone, with the memory as it is.
  void refit(const ForceGroups& kept) {
    columns_ = columns_of(kept);
    solve();
    add_errors();
  }

  // The same, and the memory that goes with them.
  void fit(const ForceGroups& kept) {
    columns_ = columns_of(kept);
    find_memory();
    solve();
    add_errors();
  }

  // Could all coefficients of a group be 0?
  double p_of(ForceGroup group) const {
    const auto first = static_cast<Index>(basis_.first(group)), count = static_cast<Index>(basis_.count(group));
    if (count == 0 || !(scale_.segment(first, count).minCoeff() > 0)) return kUndefined;
    const VectorXd theta = theta_.segment(first, count);
    const MatrixXd covariance = covariance_.block(first, first, count, count);
    const double wald = theta.dot(covariance.completeOrthogonalDecomposition().solve(theta));
    if (!std::isfinite(wald)) return 1;
    return cdf(complement(boost::math::chi_squared(static_cast<double>(count)), std::max(0.0, wald)));
  }

  // Strength of what is white, per axis.
  Array3d white() const {
    Array3d out = Array3d::Zero();
    for (int axis = 0; axis < basis_.dims; ++axis) {
      const double x = memory_.rho > 0 ? -std::log(memory_.rho) : 0;
      const double of_memory[] = {memory_.variance[axis] * seen_memory(x, 0), memory_.variance[axis] * seen_memory(x, 1)};
      const double sum = 2 * (autocovariance(axis, 0) - of_memory[0]) + 3 * (autocovariance(axis, 1) - of_memory[1]);
      out[axis] = std::sqrt(std::max(0.0, 6 * dt_ / 11 * sum));
    }
    return out;
  }

 private:
  const MatrixXd& of(int axis) const { return design_[static_cast<std::size_t>(axis)]; }
  VectorXd acceleration(int axis, Index first, Index count) const {
    return motion_.acceleration().col(axis).segment(first, count).matrix();
  }
  std::vector<Run> long_runs() const {
    std::vector<Run> out;
    for (const Run& run : motion_.runs())
      if (run.count > kLag) out.push_back(run);
    return out;
  }

  // Coefficients of these groups that any row can tell.
  std::vector<Index> columns_of(const ForceGroups& kept) const {
    std::vector<Index> out;
    for (std::size_t g = 0; g < kForceGroups; ++g)
      for (std::size_t k = 0; kept[g] && k < basis_.count(static_cast<ForceGroup>(g)); ++k)
        if (const auto c = static_cast<Index>(basis_.first(static_cast<ForceGroup>(g)) + k); scale_[c] > 0) out.push_back(c);
    return out;
  }

  void solve() {
    const auto n = static_cast<Index>(columns_.size());
    const VectorXd s = scale_(columns_);
    normal_ = (moments_.now - memory_.rho * moments_.before)(columns_, columns_);
    normal_ = s.cwiseInverse().asDiagonal() * normal_ * s.cwiseInverse().asDiagonal();
    const VectorXd right = s.cwiseInverse().asDiagonal() * VectorXd((moments_.a_now - memory_.rho * moments_.a_before)(columns_));
    theta_ = VectorXd::Zero(static_cast<Index>(basis_.size()));
    if (n > 0) theta_(columns_) = s.cwiseInverse().asDiagonal() * VectorXd(normal_.completeOrthogonalDecomposition().solve(right));
    for (int axis = 0; axis < basis_.dims; ++axis)
      residuals_[static_cast<std::size_t>(axis)] = acceleration(axis, 0, motion_.rows()) - of(axis) * theta_;
  }

  double autocovariance(int axis, Index shift) const {
    double sum = 0;
    Index count = 0;
    const VectorXd& e = residuals_[static_cast<std::size_t>(axis)];
    for (const Run& run : motion_.runs())
      if (run.count > shift) {
        sum += e.segment(run.first, run.count - shift).dot(e.segment(run.first + shift, run.count - shift));
        count += run.count - shift;
      }
    return count > 0 ? sum / static_cast<double>(count) : 0;
  }

  // The exponential through the autocovariances that localisation error does not reach: least squares.
  Memory memory_of_residuals() const {
    Index longest = 0;
    for (const Run& run : motion_.runs()) longest = std::max(longest, run.count);
    const Index last = std::min(kLastSeen, longest / 4);
    std::vector<Array3d> found;  // until it has died away: what follows is chance, and long waves of it
    for (Index s = kFirstSeen; s <= last && (found.size() < kSureToBeSeen || found.back().sum() > 0); ++s) {
      Array3d at = Array3d::Zero();
      for (int axis = 0; axis < basis_.dims; ++axis) at[axis] = autocovariance(axis, s);
      found.push_back(at);
    }
    if (found.size() < kFewestSeen) return {};
    Eigen::ArrayX3d seen(static_cast<Index>(found.size()), 3);
    for (std::size_t k = 0; k < found.size(); ++k) seen.row(static_cast<Index>(k)) = found[k].transpose();
    const ArrayXd shift = ArrayXd::LinSpaced(seen.rows(), kFirstSeen, static_cast<double>(kFirstSeen + seen.rows() - 1));
    Memory best;
    double least = INFINITY;
    for (int k = 0; k <= 200; ++k) {  // of one frame to kLongest
      const double x = std::pow(kLongest, -k / 200.0);
      const ArrayXd curve = seen_later(x) * (-x * shift).exp();
      const Array3d variance = (seen.colwise() * curve).colwise().sum().transpose() / curve.square().sum();
      double missed = 0;
      for (int axis = 0; axis < basis_.dims; ++axis) missed += (seen.col(axis) - variance[axis] * curve).square().sum();
      if (missed < least) least = missed, best = {std::exp(-x), variance.max(0)};
    }
    return best;
  }

  // The shortest memory that agrees with the forces that it leads to. With a memory too long there are no forces but noise, or large ones
  // that undo it: noise that doubles in variance is not believed.
  void find_memory() {
    memory_ = {};
    const auto beyond = [&](double rho) {  // by how much the residuals remember longer than that, and a twentieth
      memory_.rho = rho;
      solve();
      const Memory found = memory_of_residuals();
      memory_.variance = found.variance;
      return found.rho - rho - kAgrees * (1 - rho);
    };
    double low = 0, nearest = 0, least = beyond(0);
    const double most = kDoubled * memory_.variance.sum();
    if (!remembers()) return void(memory_ = {});
    for (int k = 0; k <= kMemories; ++k) {
      double high = std::exp(-std::pow(kLongest, -k / double{kMemories}));
      const double now = beyond(high);
      if (memory_.variance.sum() > most) break;
      if (now <= 0) {
        for (int n = 0; n < kHalvings; ++n) {
          const double middle = 0.5 * (low + high);
          (beyond(middle) > 0 ? low : high) = middle;
        }
        nearest = high;
        break;
      }
      if (now < least) least = now, nearest = high;
      low = high;
    }
    beyond(nearest);
    if (!remembers()) memory_ = {};
  }

  // Are autocovariances that localisation error does not reach more than chance?
  bool remembers() const {
    double seen = 0, chance = 0;
    for (int axis = 0; axis < basis_.dims; ++axis) {
      for (Index s = kFirstSeen; s < kFirstSeen + 3; ++s) seen += autocovariance(axis, s) / 3;
      chance += std::pow(autocovariance(axis, 0), 2) / static_cast<double>(3 * std::max<Index>(1, rows_));
    }
    return seen > kSigmas * std::sqrt(chance);
  }

  // Sandwich over pieces of tracks.
  void add_errors() {
    const auto n = static_cast<Index>(columns_.size()), all = static_cast<Index>(basis_.size());
    covariance_ = MatrixXd::Zero(all, all);
    if (n == 0) return;
    const VectorXd s = scale_(columns_);
    MatrixXd meat = MatrixXd::Zero(n, n);
    Index pieces = 0;
    for (const Run& run : long_runs())
      for (Index begin = kLag; begin < run.count; begin += kPiece) {
        const Index count = std::min(kPiece, run.count - begin), from = run.first + begin;
        VectorXd score = VectorXd::Zero(n);
        for (int axis = 0; axis < basis_.dims; ++axis) {
          const VectorXd& e = residuals_[static_cast<std::size_t>(axis)];
          const VectorXd fresh = e.segment(from, count) - memory_.rho * e.segment(from - 1, count);
          score += (of(axis).middleRows(from - kLag, count).transpose() * fresh)(columns_).cwiseQuotient(s);
        }
        meat += score * score.transpose();
        ++pieces;
      }
    if (pieces > 1) meat *= static_cast<double>(pieces) / static_cast<double>(pieces - 1);
    const auto factors = normal_.completeOrthogonalDecomposition();
    const MatrixXd inverse = factors.pseudoInverse();
    const MatrixXd scaled = s.cwiseInverse().asDiagonal() * (inverse * meat * inverse.transpose()) * s.cwiseInverse().asDiagonal();
    covariance_(columns_, columns_) = scaled;
    const VectorXd pivots = factors.matrixT().diagonal().head(n).cwiseAbs();
    condition_ = pivots.minCoeff() > 0 ? pivots.maxCoeff() / pivots.minCoeff() : INFINITY;
  }

  const ForceBasis& basis_;
  const Motion& motion_;
  Design design_;
  double dt_;
  VectorXd scale_;  // root mean square of every term
  Moments moments_;
  Index rows_ = 0;
  std::vector<Index> columns_;  // of the groups that are fitted
  MatrixXd normal_, covariance_;
  VectorXd theta_;
  std::array<VectorXd, 3> residuals_;
  Memory memory_;
  double condition_ = 0;
};

constexpr double kNeeded = kAlpha / kForceGroups;
constexpr ForceGroups kSimplest{true, false, true};  // drag and confinement

// To drag and confinement the group that is needed most comes in and those that are not needed any more go out, as long as one does.
// The memory of the noise stays as it is.
ForceGroups needed_groups(Regression& regression, const ForceGroups& there) {
  ForceGroups kept = kSimplest;
  for (std::size_t round = 0; round < kForceGroups; ++round) {
    std::optional<std::size_t> next;
    double least = kNeeded;
    for (std::size_t g = 0; g < kForceGroups; ++g) {
      if (kept[g] || !there[g]) continue;
      ForceGroups with = kept;
      with[g] = true;
      regression.refit(with);
      if (const double p = regression.p_of(static_cast<ForceGroup>(g)); p < least) least = p, next = g;
    }
    if (next) kept[*next] = true;
    regression.refit(kept);
    bool gone = false;
    for (std::size_t g = 0; g < kForceGroups; ++g)
      if (kept[g] && !kSimplest[g] && !(regression.p_of(static_cast<ForceGroup>(g)) < kNeeded)) kept[g] = false, gone = true;
    if (!next && !gone) break;
  }
  return kept;
}

}  // namespace

ForceBasis force_basis(const Tracks& recording) {
  ForceBasis out;
  out.dims = recording.dims();
  out.centre = recording.rows() > 0 ? Array3d(recording.pos().colwise().mean().transpose()) : Array3d::Zero();
  std::vector<double> speeds, distances;
  for (Index row = 0; row < recording.rows(); ++row) {
    distances.push_back(std::sqrt((place(recording, row) - out.centre).square().sum()));
    const Index next = recording.next()[static_cast<std::size_t>(row)];
    if (next >= 0) speeds.push_back(std::sqrt((place(recording, next) - place(recording, row)).square().sum()) / recording.dt());
  }
  if (!speeds.empty()) out.top_speed = at_quantile(std::move(speeds), kCommon);
  if (!distances.empty()) out.reach = at_quantile(std::move(distances), kCommon);
  if (const auto pairs = pair_distances(recording); !pairs.empty())
    for (const double q : kQuantiles)
      if (const double knot = at_quantile(pairs, q); out.knots.empty() || knot > out.knots.back()) out.knots.push_back(knot);
  if (out.knots.size() < 2) out.knots.clear();
  return out;
}

// What is measured once, and fitted again and again.
struct ForceRegression::Measured {
  Measured(const Tracks& tracks, const ForceBasis& of)
      : basis(of), dt(tracks.dt()), motion(tracks, Windows(tracks)), regression(basis, motion, DesignOf(basis, motion).take(tracks), dt) {
    for (std::size_t g = 0; g < kForceGroups; ++g) there[g] = basis.count(static_cast<ForceGroup>(g)) > 0;
  }

  const ForceBasis basis;
  const double dt;
  const Motion motion;
  Regression regression;
  ForceGroups there{};  // those that have any terms
};

ForceRegression::ForceRegression(const Tracks& tracks, const ForceBasis& basis) : measured_(std::make_unique<Measured>(tracks, basis)) {}
ForceRegression::~ForceRegression() = default;

Index ForceRegression::rows() const { return measured_->regression.rows(); }
Index ForceRegression::enough() const { return 4 * static_cast<Index>(measured_->basis.size()); }

ForceGroups ForceRegression::needed() {
  measured_->regression.fit(measured_->there);
  return needed_groups(measured_->regression, measured_->there);
}

ForceFit ForceRegression::fit(const ForceGroups& groups) {
  if (rows() >= enough()) measured_->regression.fit(there(groups));
  return result(groups);
}

ForceFit ForceRegression::refit(const ForceGroups& groups) {
  if (rows() >= enough()) measured_->regression.refit(there(groups));
  return result(groups);
}

ForceGroups ForceRegression::there(ForceGroups groups) const {
  for (std::size_t g = 0; g < kForceGroups; ++g) groups[g] = groups[g] && measured_->there[g];
  return groups;
}

ForceFit ForceRegression::result(const ForceGroups& groups) const {
  const Regression& r = measured_->regression;
  const auto size = static_cast<Index>(measured_->basis.size());
  ForceFit out;
  out.law.basis = measured_->basis;
  out.rows = r.rows();
  out.p.fill(kUndefined);
  if (rows() < enough()) {
    out.law.coefficients = VectorXd::Constant(size, kUndefined);
    out.covariance = MatrixXd::Constant(size, size, kUndefined);
    return out;
  }
  out.groups = there(groups);
  for (std::size_t g = 0; g < kForceGroups; ++g)
    if (out.groups[g]) out.p[g] = r.p_of(static_cast<ForceGroup>(g));
  out.law.coefficients = r.coefficients();
  out.law.white = r.white();
  if (const Memory& memory = r.memory(); memory.rho > 0) {
    out.law.coloured = memory.variance.sqrt();
    out.law.memory = -measured_->dt / std::log(memory.rho);
  }
  out.covariance = r.covariance();
  out.condition = r.condition();
  return out;
}

ForceFit fit_forces(const Tracks& tracks, const ForceBasis& basis) {
  ForceRegression regression(tracks, basis);
  return regression.fit(regression.rows() < regression.enough() ? ForceGroups{} : regression.needed());
}

double ForceFit::se(ForceGroup group, std::size_t k) const {
  const auto c = static_cast<Index>(law.basis.first(group) + k);
  return std::sqrt(covariance(c, c));
}

double ForceFit::kernel_se(ForceGroup group, double distance) const {
  const auto [first, weight, next] = law.basis.hat(distance);
  VectorXd w = VectorXd::Zero(covariance.rows());
  const auto c = static_cast<Index>(law.basis.first(group) + first);
  if (weight != 0) w[c] = weight;
  if (next > 0) w[c + 1] = next;
  return std::sqrt(w.dot(covariance * w));
}

double ForceFit::confinement_se(double distance) const {
  const double d = std::min(distance, law.basis.reach);
  VectorXd w = VectorXd::Zero(covariance.rows());
  for (int axis = 0; axis < law.basis.dims; ++axis)
    w[static_cast<Index>(law.basis.first(ForceGroup::confinement)) + axis] = 1.0 / law.basis.dims;
  w[static_cast<Index>(law.basis.first(ForceGroup::hardening))] = d * d;
  return std::sqrt(w.dot(covariance * w));
}

double ForceFit::drag_se(double speed) const {
  const double s = std::min(speed, law.basis.top_speed);
  VectorXd w = VectorXd::Zero(covariance.rows());
  const auto c = static_cast<Index>(law.basis.first(ForceGroup::speed_drag));
  w[static_cast<Index>(law.basis.first(ForceGroup::drag))] = 1;
  w[c] = s;
  w[c + 1] = s * s;
  return std::sqrt(w.dot(covariance * w));
}

int ForceFit::terms() const {
  std::size_t sum = 0;
  for (std::size_t g = 0; g < kForceGroups; ++g) sum += groups[g] ? law.basis.count(static_cast<ForceGroup>(g)) : 0;
  return static_cast<int>(sum);
}

}  // namespace swarmfit
