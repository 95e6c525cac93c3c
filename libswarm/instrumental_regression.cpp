// SPDX-License-Identifier: MIT
#include "libswarm/instrumental_regression.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libtrack/distributions.h"
#include "libtrack/linear_algebra.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kLag = 4;        // frames between a force and its instruments
constexpr Index kFirstSeen = 3;  // autocovariance without localisation error, in frames
constexpr Index kLastSeen = 40;
constexpr std::size_t kFewestSeen = 4, kSureToBeSeen = 15;
constexpr double kFewestPieces = 5;
constexpr double kSigmas = 4;                 // of chance, for memory
constexpr Index kPiece = 50;                  // frames of a track that count as one observation
constexpr double kLongest = 60;               // memory, in frames
constexpr int kMemories = 24, kHalvings = 8;  // that are tried
constexpr double kDoubled = 2, kAgrees = 0.05;
constexpr double kBartlett = 0.61;  // variance of a mean of three autocovariances where neighbours correlate by a quarter

// Autocovariance of Ornstein-Uhlenbeck noise in second differences over dt², by the same of the noise itself: shift 0 or 1. x: dt over the
// memory. It is the fourth difference of g with g'''' = exp(-x|u|).
double seen_memory(double x, int shift) {
  if (x < 0.05) return std::exp(-x * shift);
  const auto g = [x](double u) { return std::exp(-x * u) / std::pow(x, 4) + u / std::pow(x, 3) + u * u * u / (6 * x); };
  return shift == 0 ? 6 * g(0) - 8 * g(1) + 2 * g(2) : g(3) - 4 * g(2) + 7 * g(1) - 4 * g(0);
}
// The same from a shift of two frames on: what exp(-x shift) is multiplied by.
double seen_later(double x) { return x < 1e-6 ? 1 : std::pow(2 * std::sinh(x / 2) / x, 4); }

// Noise with this memory (dt over it is x) that looks most like them, and how much it misses: least squares.
struct Alike {
  Array3d variance;
  double missed;
};
Alike alike(const Eigen::ArrayX3d& seen, double x) {
  const ArrayXd shift = ArrayXd::LinSpaced(seen.rows(), kFirstSeen, static_cast<double>(kFirstSeen + seen.rows() - 1));
  const ArrayXd curve = seen_later(x) * (-x * shift).exp();
  const Array3d variance = (seen.colwise() * curve).colwise().sum().transpose() / curve.square().sum();
  double missed = 0;
  for (int axis = 0; axis < 3; ++axis) missed += (seen.col(axis) - variance[axis] * curve).square().sum();
  return {variance.max(0), missed};
}

// By how much it shrinks in a frame.
NoiseMemory memory_of(const Eigen::ArrayX3d& seen) {
  NoiseMemory best;
  double least = INFINITY;
  for (int k = 0; k <= 200 && seen.rows() > 0; ++k) {  // of one frame to kLongest
    const double x = std::pow(kLongest, -k / 200.0);
    if (const Alike a = alike(seen, x); a.missed < least) least = a.missed, best = {std::exp(-x), a.variance};
  }
  return best;
}

}  // namespace

RegressionDesign::RegressionDesign(const SymmetricDifferences& seen, Index of)
    : coefficients(of), dims(seen.tracks().dims()), dt(seen.tracks().dt()), runs(seen.runs().begin(), seen.runs().end()) {
  const auto rows = static_cast<Index>(seen.rows().size());
  for (auto& axis : acceleration) axis = VectorXd::Zero(rows);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dims); ++axis) terms[axis] = MatrixXd::Zero(rows, coefficients);
  for (Index u = 0; u < rows; ++u) {
    const Array3d a = seen.a(seen.rows()[static_cast<std::size_t>(u)]);
    for (std::size_t axis = 0; axis < 3; ++axis) acceleration[axis][u] = a[static_cast<Index>(axis)];
  }
}

InstrumentalRegression::InstrumentalRegression(RegressionDesign design) : design_(std::move(design)) {
  const Index n = design_.coefficients;
  scale_ = VectorXd::Zero(n);
  for (int axis = 0; axis < design_.dims; ++axis)
    scale_ += design_.terms[static_cast<std::size_t>(axis)].colwise().squaredNorm().transpose();
  scale_ = scale_.cwiseSqrt() / std::sqrt(static_cast<double>(std::max<Index>(1, design_.rows())));
  moments_ = {MatrixXd::Zero(n, n), MatrixXd::Zero(n, n), VectorXd::Zero(n), VectorXd::Zero(n)};
  for (int axis = 0; axis < design_.dims; ++axis)
    for (const auto& run : long_runs()) {
      // Products without blocks, whose size would depend on the machine and with it the last bits.
      const Index some = run.count - kLag, now = run.first + kLag;
      const auto z = design_.terms[static_cast<std::size_t>(axis)].middleRows(run.first, some).transpose();
      moments_.now += z.lazyProduct(design_.terms[static_cast<std::size_t>(axis)].middleRows(now, some));
      moments_.before += z.lazyProduct(design_.terms[static_cast<std::size_t>(axis)].middleRows(now - 1, some));
      moments_.a_now += z.lazyProduct(design_.acceleration[static_cast<std::size_t>(axis)].segment(now, some));
      moments_.a_before += z.lazyProduct(design_.acceleration[static_cast<std::size_t>(axis)].segment(now - 1, some));
      rows_ += axis == 0 ? some : 0;
    }
}

void InstrumentalRegression::choose(const std::vector<Index>& columns) {
  columns_.clear();
  unseen_.clear();
  for (const Index c : columns) (scale_[c] > 0 ? columns_ : unseen_).push_back(c);
}

void InstrumentalRegression::refit(const std::vector<Index>& columns) {
  choose(columns);
  solve();
  add_errors();
}

void InstrumentalRegression::fit(const std::vector<Index>& columns) {
  choose(columns);
  find_memory();
  solve();
  add_errors();
}

double InstrumentalRegression::p_of(Index first, Index count) const {
  if (count == 0 || !(scale_.segment(first, count).minCoeff() > 0)) return kNaN;
  const VectorXd theta = theta_.segment(first, count);
  const MatrixXd covariance = covariance_.block(first, first, count, count);
  const auto many = static_cast<double>(count), pieces = static_cast<double>(pieces_);
  if (pieces < many + kFewestPieces) return kNaN;
  const double wald = theta.dot(least_squares(covariance, theta));
  if (!std::isfinite(wald)) return 1;
  return fisher_f_tail(std::max(0.0, wald) * (pieces - many) / (many * (pieces - 1)), many, pieces - many);
}

Array3d InstrumentalRegression::white() const {
  Array3d out = Array3d::Zero();
  for (Index axis = 0; axis < design_.dims; ++axis) {
    const double x = memory_.rho > 0 ? -std::log(memory_.rho) : 0;
    const double of_memory[] = {memory_.variance[axis] * seen_memory(x, 0), memory_.variance[axis] * seen_memory(x, 1)};
    const double sum = 2 * (autocovariance(axis, 0) - of_memory[0]) + 3 * (autocovariance(axis, 1) - of_memory[1]);
    out[axis] = std::sqrt(std::max(0.0, 6 * design_.dt / 11 * sum));
  }
  return out;
}

double InstrumentalRegression::unexplained() const {
  double sum = 0;
  Index count = 0;
  for (Index axis = 0; axis < design_.dims; ++axis)
    for (const auto& run : design_.runs) {
      const VectorXd& e = residuals_[static_cast<std::size_t>(axis)];
      for (Index u = run.first + 1; u < run.first + run.count; ++u) sum += std::pow(e[u] - memory_.rho * e[u - 1], 2), ++count;
    }
  return count > 0 ? sum / static_cast<double>(count) : kNaN;
}

std::vector<SymmetricDifferences::Run> InstrumentalRegression::long_runs() const {
  std::vector<SymmetricDifferences::Run> out;
  for (const auto& run : design_.runs)
    if (run.count > kLag) out.push_back(run);
  return out;
}

void InstrumentalRegression::solve() {
  const auto n = static_cast<Index>(columns_.size());
  const VectorXd s = scale_(columns_);
  normal_ = (moments_.now - memory_.rho * moments_.before)(columns_, columns_);
  normal_ = s.cwiseInverse().asDiagonal() * normal_ * s.cwiseInverse().asDiagonal();
  const VectorXd right = s.cwiseInverse().asDiagonal() * VectorXd((moments_.a_now - memory_.rho * moments_.a_before)(columns_));
  theta_ = VectorXd::Zero(design_.coefficients);
  if (n > 0) theta_(columns_) = s.cwiseInverse().asDiagonal() * least_squares(normal_, right);
  for (Index axis = 0; axis < design_.dims; ++axis)
    residuals_[static_cast<std::size_t>(axis)] =
        design_.acceleration[static_cast<std::size_t>(axis)] - design_.terms[static_cast<std::size_t>(axis)] * theta_;
}

double InstrumentalRegression::autocovariance(Index axis, Index shift) const {
  double sum = 0;
  Index count = 0;
  const VectorXd& e = residuals_[static_cast<std::size_t>(axis)];
  for (const auto& run : design_.runs)
    if (run.count > shift) {
      sum += e.segment(run.first, run.count - shift).dot(e.segment(run.first + shift, run.count - shift));
      count += run.count - shift;
    }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

// Autocovariances of the residuals that localisation error does not reach, per axis, until they have died away: what follows is chance,
// and long waves of it. Too few to tell a memory: none.
Eigen::ArrayX3d InstrumentalRegression::remembered() const {
  Index longest = 0;
  for (const auto& run : design_.runs) longest = std::max(longest, run.count);
  const Index last = std::min(kLastSeen, longest / 4);
  std::vector<Array3d> found;
  for (Index s = kFirstSeen; s <= last && (found.size() < kSureToBeSeen || found.back().sum() > 0); ++s) {
    Array3d at = Array3d::Zero();
    for (Index axis = 0; axis < design_.dims; ++axis) at[axis] = autocovariance(axis, s);
    found.push_back(at);
  }
  if (found.size() < kFewestSeen) return {};
  Eigen::ArrayX3d seen(static_cast<Index>(found.size()), 3);
  for (std::size_t k = 0; k < found.size(); ++k) seen.row(static_cast<Index>(k)) = found[k].transpose();
  return seen;
}

// The shortest memory that agrees with the forces that it leads to. With a memory too long there are no forces but noise, or large ones
// that undo it: noise that doubles in variance is not believed.
void InstrumentalRegression::find_memory() {
  memory_ = {};
  const auto beyond = [&](double rho) {  // by how much the residuals remember longer than that, and a twentieth
    memory_.rho = rho;
    solve();
    const NoiseMemory found = memory_of(remembered());
    memory_.variance = found.variance;
    return found.rho - rho - kAgrees * (1 - rho);
  };
  double low = 0, nearest = 0, least = beyond(0);
  const double most = kDoubled * memory_.variance.sum();
  const bool any = most > 0 && remembers();
  for (int k = 0; any && k <= kMemories; ++k) {
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
  memory_ = {};
  if (nearest <= 0) return;
  memory_.rho = nearest;
  solve();
  const Eigen::ArrayX3d seen = remembered();
  if (seen.rows() > 0) memory_.variance = alike(seen, -std::log(nearest)).variance;
  if (!(memory_.variance.sum() > 0) || !remembers()) memory_ = {};
}

// Are autocovariances that localisation error does not reach more than chance?
bool InstrumentalRegression::remembers() const {
  double seen = 0, chance = 0;
  for (Index axis = 0; axis < design_.dims; ++axis) {
    for (Index s = kFirstSeen; s < kFirstSeen + 3; ++s) seen += autocovariance(axis, s) / 3;
    chance += kBartlett * std::pow(autocovariance(axis, 0), 2) / static_cast<double>(std::max<Index>(1, rows_));
  }
  return seen > kSigmas * std::sqrt(chance);
}

// Sandwich over pieces of tracks.
void InstrumentalRegression::add_errors() {
  const auto n = static_cast<Index>(columns_.size()), all = design_.coefficients;
  covariance_ = MatrixXd::Zero(all, all);
  if (n == 0) return;
  const VectorXd s = scale_(columns_);
  MatrixXd meat = MatrixXd::Zero(n, n);
  pieces_ = 0;
  for (const auto& run : long_runs())
    for (Index begin = kLag; begin < run.count; begin += kPiece) {
      const Index count = std::min(kPiece, run.count - begin), from = run.first + begin;
      VectorXd score = VectorXd::Zero(n);
      for (Index axis = 0; axis < design_.dims; ++axis) {
        const VectorXd& e = residuals_[static_cast<std::size_t>(axis)];
        const VectorXd fresh = e.segment(from, count) - memory_.rho * e.segment(from - 1, count);
        score +=
            (design_.terms[static_cast<std::size_t>(axis)].middleRows(from - kLag, count).transpose() * fresh)(columns_).cwiseQuotient(s);
      }
      meat += score * score.transpose();
      ++pieces_;
    }
  if (pieces_ > 1) meat *= static_cast<double>(pieces_) / static_cast<double>(pieces_ - 1);
  const MatrixXd inverse = pseudo_inverse(normal_);
  const MatrixXd scaled = s.cwiseInverse().asDiagonal() * (inverse * meat * inverse.transpose()) * s.cwiseInverse().asDiagonal();
  covariance_(columns_, columns_) = scaled;
  for (const Index c : unseen_) covariance_.row(c).setConstant(kNaN), covariance_.col(c).setConstant(kNaN);
}

}  // namespace swarmfit
