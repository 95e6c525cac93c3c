// SPDX-License-Identifier: MIT
#include "fit/model_fit/regression.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "fit/model_fit/model_forces.h"
#include "libswarm/instrumental_regression.h"
#include "libtrack/distributions.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

using Eigen::VectorXd;

constexpr double kNudge = 1e-4;       // of a coordinate's range, for derivatives
constexpr double kLongestStep = 0.5;  // of the range
constexpr double kStill = 1e-4;       // of the range
constexpr int kSteps = 40;
constexpr Index kRowsPerParameter = 4;
constexpr int kBlocks = 10;             // of time, left out one by one
constexpr int kGrid = 10, kRounds = 3;  // of a profile: values per radius, and how often it is made finer

// A searched parameter on the axis on which steps are taken: the value itself, or its logarithm; the range is 1.
struct Coordinate {
  std::size_t row;
  double lower, upper;
  bool log;

  double value(double u) const { return log ? lower * std::pow(upper / lower, u) : lower + u * (upper - lower); }
  double of(double value) const { return log ? std::log(value / lower) / std::log(upper / lower) : (value - lower) / (upper - lower); }
};

struct Solution {
  std::vector<double> parameters;
  VectorXd u;
  InstrumentalRegression last;
  bool settled;
};

class Matching {
 public:
  Matching(const SearchSpace& space, const Conditions& conditions)
      : seen_(conditions.recording),
        force_(without_noise(space.model()), conditions, seen_),
        start_(space.parameters(space.start())),
        remembers_(space.model().spec->remembers(space.model().options)) {
    const ForceLike& like = *space.model().spec->force;
    const Options options = without_noise(space.model()).options;
    for (const std::size_t row : like.silent) start_[row] = 0;
    const auto table = space.describe(space.start(), "");
    for (const std::size_t row : space.searched()) {
      const bool silent = std::count(like.silent.begin(), like.silent.end(), row) > 0;
      if (silent || !space.model().spec->uses(row, options)) continue;
      const std::string& name = space.model().spec->parameters[row].name;
      const auto of = std::find_if(table.begin(), table.end(), [&](const ParameterResult& p) { return p.name == name; });
      const Coordinate coordinate{row, of->lower, of->upper, of->log && of->lower > 0};
      (std::count(like.jumps.begin(), like.jumps.end(), row) > 0 ? jumps_ : smooth_).push_back(coordinate);
    }
  }

  std::optional<AccelerationFit> fit() const {
    if (smooth_.empty()) return {};
    const std::vector<double> from = jumps_.empty() ? start_ : profiled();
    const auto found = solve(from, {}, kSteps);
    if (!found || !found->settled || found->last.rows() < kRowsPerParameter * coefficients()) return {};
    return reported(*found, remembers_ ? jackknife(*found) : half_widths(*found));
  }

 private:
  static ModelChoice without_noise(ModelChoice model) {
    for (const auto& [name, value] : model.spec->force->options) model.options[name] = value;
    return model;
  }

  Index coefficients() const { return static_cast<Index>(smooth_.size()); }

  std::vector<double> at(std::vector<double> parameters, const VectorXd& u) const {
    for (std::size_t k = 0; k < smooth_.size(); ++k) parameters[smooth_[k].row] = smooth_[k].value(u[static_cast<Index>(k)]);
    return parameters;
  }

  std::vector<SymmetricDifferences::Run> without_block(int block) const {
    const auto frames = seen_.tracks().frames();
    const std::int64_t first = frames.front().number, span = frames.back().number - first + 1;
    std::vector<SymmetricDifferences::Run> out;
    for (const auto& run : seen_.runs()) {
      bool goes_on = false;
      for (Index u = run.first; u < run.first + run.count; ++u) {
        const std::int64_t frame = seen_.frame_of(seen_.rows()[static_cast<std::size_t>(u)]).number;
        const bool in = (frame - first) * kBlocks / span != block;
        if (in && !goes_on) out.push_back({u, 0});
        if (in) ++out.back().count;
        goes_on = in;
      }
    }
    return out;
  }

  // What the force leaves to explain, and its derivatives; none where it is not finite.
  std::optional<RegressionDesign> linearised(const std::vector<double>& base, const VectorXd& u) const {
    RegressionDesign out(seen_, coefficients());
    const auto here = force_.at(at(base, u));
    for (std::size_t axis = 0; axis < 3; ++axis) out.acceleration[axis] -= here[axis];
    for (Index k = 0; k < coefficients(); ++k) {
      VectorXd there = u;
      there[k] += u[k] > 0.5 ? -kNudge : kNudge;
      const auto moved = force_.at(at(base, there));
      for (std::size_t axis = 0; axis < static_cast<std::size_t>(out.dims); ++axis)
        out.terms[axis].col(k) = (moved[axis] - here[axis]) / (there[k] - u[k]);
    }
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(out.dims); ++axis)
      if (!out.acceleration[axis].allFinite() || !out.terms[axis].allFinite()) return {};
    return out;
  }

  // A step of those that it does not lead out of their bounds, while the others stay on theirs.
  VectorXd constrained_step(const VectorXd& u, InstrumentalRegression& regression, const std::optional<NoiseMemory>& memory) const {
    std::vector<Index> free(smooth_.size());
    std::iota(free.begin(), free.end(), Index{0});
    if (memory || !remembers_) regression.use(memory.value_or(NoiseMemory{}));
    for (;;) {
      if (memory || !remembers_) {
        regression.refit(free);
      } else {
        regression.fit(free);
      }
      const VectorXd& by = regression.coefficients();
      if (std::erase_if(free, [&](Index k) { return (u[k] <= 0 && by[k] < 0) || (u[k] >= 1 && by[k] > 0); }) == 0) return by;
    }
  }

  // Gauss-Newton steps from there, on all frames or without a block of them. Noise that remembers does so as it is told or, without that,
  // as is found.
  std::optional<Solution> solve(const std::vector<double>& base, const std::optional<NoiseMemory>& memory, int steps,
                                std::optional<int> block = {}) const {
    VectorXd u(coefficients());
    for (std::size_t k = 0; k < smooth_.size(); ++k) u[static_cast<Index>(k)] = std::clamp(smooth_[k].of(base[smooth_[k].row]), 0.0, 1.0);
    for (int step = 1;; ++step) {
      auto design = linearised(base, u);
      if (!design) return {};
      if (block) design->runs = without_block(*block);
      InstrumentalRegression regression(std::move(*design));
      VectorXd by = constrained_step(u, regression, memory);
      if (!by.allFinite()) return {};
      by *= std::min(1.0, kLongestStep / std::max(by.cwiseAbs().maxCoeff(), 1e-300));
      const VectorXd next = (u + by).cwiseMax(0).cwiseMin(1);
      const double moved = (next - u).cwiseAbs().maxCoeff();
      if (step == steps || moved < kStill) return Solution{at(base, u), u, std::move(regression), moved < kStill};
      u = next;
    }
  }

  // Radii at which forces jump have no derivatives: every combination of a few values, then finer about the best. The noise keeps the
  // memory that goes with the defaults.
  std::vector<double> profiled() const {
    const auto first = solve(start_, {}, 2);
    const NoiseMemory memory = first ? first->last.memory() : NoiseMemory{};
    std::vector<double> best = start_, centre(jumps_.size(), 0.5);
    double least = INFINITY, width = 1;
    for (int round = 0; round < kRounds; ++round, width *= 2.0 / kGrid) {
      const std::vector<double> about = centre;
      std::size_t points = 1;
      for (std::size_t k = 0; k < jumps_.size(); ++k) points *= kGrid;
      for (std::size_t point = 0; point < points; ++point) {
        std::vector<double> tried = best, place(jumps_.size());
        std::size_t rest = point;
        for (std::size_t k = 0; k < jumps_.size(); ++k, rest /= kGrid) {
          place[k] = std::clamp(about[k] + width * ((static_cast<double>(rest % kGrid) + 0.5) / kGrid - 0.5), 0.0, 1.0);
          tried[jumps_[k].row] = jumps_[k].value(place[k]);
        }
        const auto found = solve(tried, memory, 2);
        if (!found || !(found->last.unexplained() < least)) continue;
        least = found->last.unexplained();
        best = found->parameters;
        centre = place;
      }
    }
    return best;
  }

  // Of 95 % intervals, on the axes of the steps; NaN where the force does not depend on the parameter.
  VectorXd half_widths(const Solution& found) const { return kNormal95 * found.last.covariance().diagonal().cwiseSqrt(); }

  // The same where the memory of the noise is not known either: blocks of time are left out (Efron and Tibshirani 1993, section 11.5).
  VectorXd jackknife(const Solution& found) const {
    std::vector<VectorXd> without;
    for (int block = 0; block < kBlocks; ++block)
      if (auto one = solve(found.parameters, {}, kSteps, block); one && one->settled) without.push_back(one->u);
    VectorXd mean = VectorXd::Zero(coefficients()), variance = mean;
    for (const VectorXd& u : without) mean += u / kBlocks;
    for (const VectorXd& u : without) variance += (u - mean).cwiseAbs2() * (kBlocks - 1) / kBlocks;
    VectorXd width = student_t_above(0.025, kBlocks - 1) * variance.cwiseSqrt();
    for (Index k = 0; k < width.size(); ++k) {
      if (std::isnan(found.last.covariance()(k, k))) width[k] = kNaN;
      if (without.size() < kBlocks) width[k] = INFINITY;
    }
    return width;
  }

  AccelerationFit reported(const Solution& found, const VectorXd& width) const {
    AccelerationFit out;
    out.rows = found.last.rows();
    if (const double rho = found.last.memory().rho; rho > 0) out.memory = -seen_.tracks().dt() / std::log(rho);
    for (Index k = 0; k < coefficients(); ++k) {
      const Coordinate& c = smooth_[static_cast<std::size_t>(k)];
      const double u = found.u[k];
      if (std::isnan(width[k])) continue;
      const bool inside = u > 0 && u < 1 && width[k] > 0 && std::isfinite(width[k]);
      out.parameters.push_back({c.row, c.value(u), inside ? c.value(u - width[k]) : kNaN, inside ? c.value(u + width[k]) : kNaN});
    }
    for (const Coordinate& c : jumps_) out.parameters.push_back({c.row, found.parameters[c.row], kNaN, kNaN});
    std::sort(out.parameters.begin(), out.parameters.end(), [](const auto& a, const auto& b) { return a.row < b.row; });
    return out;
  }

  SymmetricDifferences seen_;
  ModelForces force_;
  std::vector<double> start_;
  bool remembers_;  // the noise
  std::vector<Coordinate> smooth_, jumps_;
};

}  // namespace

std::optional<AccelerationFit> acceleration_fit(const SearchSpace& space, const Conditions& conditions) {
  if (!space.model().spec->has_force(space.model().options) || space.dimensions() == 0) return {};
  return Matching(space, conditions).fit();
}

}  // namespace swarmfit
