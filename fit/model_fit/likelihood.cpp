// SPDX-License-Identifier: MIT
#include "fit/model_fit/likelihood.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlopt.hpp>
#include <numbers>

#include "libswarm/centre.h"
#include "libtrack/distributions.h"
#include "libtrack/linear_algebra.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

constexpr double kUnknownSpeed = 1e3;                 // standard deviation of a velocity before anything is known of it, in mean speeds
constexpr double kLeastError = 1e-4, kMostError = 1;  // of positions, in mean steps
constexpr int kStarts = 2, kEvaluations = 400;        // starts beside the two that are not drawn
constexpr double kCurvatureStep = 1e-3;               // in the unit cube

// y(t + dt) = keep y(t) + a normal error of this covariance.
struct Transition {
  Matrix keep, error;
};

class Transitions {
 public:
  Transitions(const LinearMotion& motion, double dt) : motion_(motion), dt_(dt) {}

  const Transition& over(std::int64_t frames) {
    const auto [at, is_new] = known_.try_emplace(frames);
    if (is_new) {
      const LinearNoise<3> step(motion_.drift, motion_.noise, dt_ * static_cast<double>(frames));
      Matrix draw;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
          at->second.keep(r, c) = step.keep[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
          draw(r, c) = step.draw[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
        }
      at->second.error = draw * draw.transpose();
    }
    return at->second;
  }

 private:
  const LinearMotion& motion_;
  double dt_;
  std::map<std::int64_t, Transition> known_;
};

// What is known of one component of one individual.
class Filter {
 public:
  Filter(const LinearMotion& m, double x, double variance, double speed) : variance_(variance), mean_(x, 0, m.hidden_on[0] * x) {
    const double fast = speed * speed;
    Eigen::Matrix<double, 3, 2> on;
    on << 1, 0, 0, 1, m.hidden_on[0], m.hidden_on[1];
    covariance_ = on * Eigen::Vector2d(variance, fast).asDiagonal() * on.transpose();
    covariance_(2, 2) += m.hidden_sd * m.hidden_sd;
  }

  // The log-density of the next position, given all before.
  double next(const Transition& step, double x) {
    mean_ = step.keep * mean_;
    covariance_ = step.keep * covariance_ * step.keep.transpose() + step.error;
    const double spread = covariance_(0, 0) + variance_, off = x - mean_[0];
    const Vector gain = covariance_.col(0) / spread;
    mean_ += gain * off;
    // Joseph's form stays symmetric and positive whatever is rounded.
    Matrix left = Matrix::Identity();
    left.col(0) -= gain;
    covariance_ = left * covariance_ * left.transpose() + variance_ * gain * gain.transpose();
    return -0.5 * (std::log(2 * std::numbers::pi * spread) + off * off / spread);
  }

 private:
  double variance_;
  Vector mean_;
  Matrix covariance_;
};

double mean_speed(const Tracks& recording) { return natural_scales(recording).speed; }

// Per individual, its rows in order of time.
std::vector<std::vector<Index>> rows_by_track(const Tracks& recording) {
  std::vector<std::vector<Index>> out(recording.track_count());
  for (Index row = 0; row < recording.rows(); ++row) out[recording.track()[static_cast<std::size_t>(row)]].push_back(row);
  return out;
}

// The part of log_likelihood that does not depend on the model.
struct Places {
  explicit Places(const Tracks& recording)
      : tracks(recording),
        individuals(rows_by_track(recording)),
        centre(recording.pos().colwise().mean().transpose()),
        speed(mean_speed(recording)) {}

  double log_likelihood(const LinearMotion& motion, const Eigen::Array3d& sd) const {
    Transitions transitions(motion, tracks.dt());
    double sum = 0;
    for (const auto& rows : individuals)
      for (int axis = 0; axis < tracks.dims() && !rows.empty(); ++axis) {
        const auto place = [&](std::size_t k) { return tracks.pos()(rows[k], axis) - centre[axis]; };
        const auto frame = [&](std::size_t k) { return tracks.frame()[static_cast<std::size_t>(rows[k])]; };
        Filter filter(motion, place(0), sd[axis] * sd[axis], kUnknownSpeed * speed);
        for (std::size_t k = 1; k < rows.size(); ++k) {
          const double density = filter.next(transitions.over(frame(k) - frame(k - 1)), place(k));
          if (k > 1) sum += density;
        }
      }
    return std::isfinite(sum) ? sum : -INFINITY;
  }

  const Tracks& tracks;
  std::vector<std::vector<Index>> individuals;
  Eigen::Array3d centre;
  double speed;
};

// The likelihood over the unit cube of what is searched, and one more axis for the error of positions.
class Surface {
 public:
  Surface(const SearchSpace& space, const Conditions& conditions) : space_(space), places_(conditions.recording) {
    step_ = places_.speed * conditions.recording.dt();
    const Eigen::Array3d known = measurement_error(conditions);
    const double mean = known.head(conditions.recording.dims()).mean();
    estimate_ = mean / step_;
    shape_ = mean > 0 ? Eigen::Array3d(known / mean) : Eigen::Array3d::Ones();
  }

  int dimensions() const { return space_.dimensions() + 1; }
  // The localisation error, in the mean over the axes [unit]; and where the one that was estimated lies.
  double error(const Point& x) const { return step_ * kLeastError * std::pow(kMostError / kLeastError, x[space_.dimensions()]); }
  double start_of_error() const {
    if (!(estimate_ > 0)) return 0.5;
    return std::clamp(std::log(estimate_ / kLeastError) / std::log(kMostError / kLeastError), 0.0, 1.0);
  }
  std::optional<LinearMotion> motion(const Point& x) const {
    const ModelChoice& model = space_.model();
    return model.spec->linear(model.options, space_.parameters(x.head(space_.dimensions())));
  }
  double operator()(const Point& x) const {
    const auto motion = this->motion(x);
    return motion ? places_.log_likelihood(*motion, shape_ * error(x)) : -INFINITY;
  }

 private:
  const SearchSpace& space_;
  Places places_;
  double step_, estimate_;  // mean step [unit]; error of positions, in mean steps
  Eigen::Array3d shape_;    // the error of each axis over their mean
};

// The best point near `start`.
Point climb(const Surface& surface, Point start) {
  const auto n = static_cast<unsigned>(surface.dimensions());
  nlopt::opt search(nlopt::LN_BOBYQA, n);
  search.set_lower_bounds(0.0);
  search.set_upper_bounds(1.0);
  search.set_initial_step(0.1);
  search.set_xtol_abs(1e-6);
  search.set_maxeval(kEvaluations);
  search.set_max_objective(
      [](const std::vector<double>& x, std::vector<double>&, void* of) {
        const double value = (*static_cast<const Surface*>(of))(Eigen::Map<const Point>(x.data(), static_cast<Index>(x.size())));
        return std::isfinite(value) ? value : -1e300;  // it takes infinity for a reason to stop
      },
      const_cast<Surface*>(&surface));
  std::vector<double> x(start.data(), start.data() + start.size());
  double best = 0;
  try {
    search.optimize(x, best);
  } catch (const nlopt::roundoff_limited&) {  // x is the best so far
  }
  return Eigen::Map<const Point>(x.data(), static_cast<Index>(x.size()));
}

// Second derivatives at an inner point; of a point within a step of the bounds, of the nearest that is not.
Eigen::MatrixXd curvature(const Surface& surface, const Point& at) {
  const Index n = at.size();
  const double h = kCurvatureStep;
  const Point x = at.cwiseMax(2 * h).cwiseMin(1 - 2 * h);
  Eigen::MatrixXd out(n, n);
  const auto value = [&](Index a, double da, Index b, double db) {
    Point p = x;
    p[a] += da;
    p[b] += db;
    return surface(p);
  };
  const double middle = surface(x);
  for (Index a = 0; a < n; ++a) {
    out(a, a) = (value(a, h, a, 0) - 2 * middle + value(a, -h, a, 0)) / (h * h);
    for (Index b = 0; b < a; ++b)
      out(a, b) = out(b, a) = (value(a, h, b, h) - value(a, h, b, -h) - value(a, -h, b, h) + value(a, -h, b, -h)) / (4 * h * h);
  }
  return out;
}

}  // namespace

double log_likelihood(const Tracks& recording, const LinearMotion& motion, const Eigen::Array3d& sd) {
  return Places(recording).log_likelihood(motion, sd);
}

std::optional<MaximumLikelihood> maximum_likelihood(const SearchSpace& space, const Conditions& conditions, const Point& start,
                                                    const Rng& rng) {
  const ModelChoice& model = space.model();
  if (!model.spec->linear || space.dimensions() == 0 || !model.spec->linear(model.options, space.parameters(space.start()))) return {};
  const Surface surface(space, conditions);
  const Index n = space.dimensions();
  Point first = Point::Constant(n + 1, 0.5);
  first[n] = surface.start_of_error();
  std::vector<Point> starts = {first};
  first.head(n) = start;
  starts.push_back(first);
  for (int k = 0; k < kStarts; ++k) {
    Point any = first;
    for (Index a = 0; a < n; ++a) any[a] = rng.uniform2(Stream::probe, static_cast<std::uint64_t>(k), static_cast<std::uint32_t>(a))[0];
    starts.push_back(any);
  }
  Point best = first;
  double most = -INFINITY;
  for (const Point& from : starts) {
    const Point top = climb(surface, from);
    if (const double value = surface(top); value > most) most = value, best = top;
  }
  if (!std::isfinite(most)) return {};

  const Eigen::MatrixXd covariance = inverse(-curvature(surface, best));
  const auto values = space.parameters(best.head(n));
  MaximumLikelihood out{most, {}, surface.error(best)};
  for (Index a = 0; a < n; ++a) {
    const std::size_t row = space.searched()[static_cast<std::size_t>(a)];
    MostLikely one{row, values[row], kNaN, kNaN};
    const bool inside = best[a] > 2 * kCurvatureStep && best[a] < 1 - 2 * kCurvatureStep;
    if (const double variance = covariance(a, a); inside && variance > 0) {
      const auto end = [&](double sign) {
        Point x = best.head(n);
        x[a] = std::clamp(x[a] + sign * kNormal95 * std::sqrt(variance), 0.0, 1.0);
        return space.parameters(x)[row];
      };
      one.lower = end(-1), one.upper = end(1);
    }
    out.parameters.push_back(one);
  }
  return out;
}

}  // namespace swarmfit
