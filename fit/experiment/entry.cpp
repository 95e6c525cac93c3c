// SPDX-License-Identifier: MIT
#include "fit/experiment/entry.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "libeval/energy.h"
#include "libtrack/distributions.h"
#include "libtrack/quantile.h"

namespace swarmfit {
namespace {

constexpr std::size_t kMostFrames = 9;
constexpr std::size_t kFewest = 20;  // windows that an error must rest on
constexpr Index kWindows = 20000;    // that are looked at, evenly spread over the recording
constexpr double kShare = 0.95;      // of absolute values

// A derivative at the first of some frames, per frame: sum of w_k x_k.
struct Filter {
  std::vector<double> w;

  double operator()(const Tracks& tracks, const Index* rows, Index axis) const {
    double sum = 0;
    for (std::size_t k = 0; k < w.size(); ++k) sum += w[k] * tracks.pos()(rows[k], axis);
    return sum;
  }
  double norm() const {
    double sum = 0;
    for (const double weight : w) sum += weight * weight;
    return sum;
  }
};

// That of a line or parabola through n frames, least squares: by polynomials orthogonal on the frames, counted from their middle.
Filter derivative(std::size_t n, int degree) {
  const double first = -0.5 * static_cast<double>(n - 1);
  double t2 = 0, q2 = 0;
  for (std::size_t k = 0; k < n; ++k) t2 += (first + static_cast<double>(k)) * (first + static_cast<double>(k));
  const auto bend = [&](std::size_t k) {
    return (first + static_cast<double>(k)) * (first + static_cast<double>(k)) - t2 / static_cast<double>(n);
  };
  for (std::size_t k = 0; k < n; ++k) q2 += bend(k) * bend(k);
  Filter out;
  for (std::size_t k = 0; k < n; ++k) out.w.push_back((first + static_cast<double>(k)) / t2 + (degree == 2 ? 2 * first * bend(k) / q2 : 0));
  return out;
}

// Shortest first: of two that err alike, the one that sees less of what came later.
std::vector<Filter> filters() {
  std::vector<Filter> out{derivative(2, 1)};
  for (const std::size_t n : {std::size_t{3}, std::size_t{4}, std::size_t{5}, std::size_t{7}, kMostFrames})
    for (const int degree : {1, 2}) out.push_back(derivative(n, degree));
  return out;
}

// What the recording says of one filter, on one axis [unit/frame].
struct Judgement {
  double variance = INFINITY;          // of its error; infinite: cannot be told
  double mean = 0, spread = INFINITY;  // of true velocities: mean and variance over all individuals and frames
};

// Runs of rows, each as long as a filter needs on both sides of its middle.
std::vector<std::span<const Index>> windows(const Tracks& tracks, std::size_t length) {
  std::vector<std::span<const Index>> out;
  Index all = 0;
  for_each_segment(tracks, static_cast<Index>(length),
                   [&](std::span<const Index> rows) { all += static_cast<Index>(rows.size() - length + 1); });
  const Index stride = std::max<Index>(1, all / kWindows);
  Index number = 0;
  for_each_segment(tracks, static_cast<Index>(length), [&](std::span<const Index> rows) {
    for (std::size_t k = 0; k + length <= rows.size(); ++k)
      if (number++ % stride == 0) out.push_back(rows.subspan(k, length));
  });
  return out;
}

// From before and from after, the same filter sees the same velocity: half the variance of the difference is that of its error, whether it
// comes from the camera, from curvature or from chance. It counts what happens in a few cases of a hundred, but no wild detections.
// Position errors of the frame in the middle count in both, with opposite signs.
Judgement judge(const Tracks& tracks, const Filter& filter, Index axis, double sigma) {
  const std::size_t n = filter.w.size();
  Filter before = filter;
  std::reverse(before.w.begin(), before.w.end());
  for (double& weight : before.w) weight = -weight;
  std::vector<double> apart;
  Moments velocity;
  for (const auto& rows : windows(tracks, 2 * n - 1)) {
    const double after = filter(tracks, rows.data() + n - 1, axis);
    apart.push_back(std::abs(after - before(tracks, rows.data(), axis)));
    velocity.add(after);
  }
  if (apart.size() < kFewest) return {};
  const double sd = quantile(std::move(apart), kShare) / kNormal95, white = sigma * sigma;
  const double shared = 2 * filter.w.front() * filter.w.front();
  Judgement out;
  out.variance = std::max(white * filter.norm(), (sd * sd - shared * white) / 2);
  out.mean = velocity.mean;
  out.spread = std::max(0.0, velocity.sd() * velocity.sd() - out.variance);
  return out;
}

// Velocity and the variance of its error [unit/frame].
struct Entry {
  double velocity = 0, variance = 0;
};

// One axis of the recording.
class SmoothedAxis {
 public:
  SmoothedAxis(const Tracks& tracks, Index axis, double sigma) : tracks_(tracks), axis_(axis), filters_(filters()) {
    for (const Filter& f : filters_) judgements_.push_back(judge(tracks, f, axis, sigma));
  }

  // At the first of an unbroken run.
  Entry operator()(std::span<const Index> run) const {
    std::size_t best = 0;
    for (std::size_t k = 1; k < filters_.size(); ++k)
      if (filters_[k].w.size() <= run.size() && judgements_[k].variance < judgements_[best].variance) best = k;
    const Judgement& j = judgements_[best];
    if (run.size() < 2) return {j.mean, std::isfinite(j.spread) ? j.spread : 0};
    const double seen = filters_[best](tracks_, run.data(), axis_);
    if (!std::isfinite(j.variance)) return {seen, 0};
    // What is known of any velocity beforehand counts, too: without it, what simulations draw would scatter by the error of what was seen
    // and once more by their own, and start too fast. (For what chance averaged away from a line that is too much, by a hundredth or two of
    // the speed.)
    const double share = j.variance > 0 ? j.spread / (j.spread + j.variance) : 1;
    return {j.mean + share * (seen - j.mean), share * j.variance};
  }

 private:
  const Tracks& tracks_;
  Index axis_;
  std::vector<Filter> filters_;
  std::vector<Judgement> judgements_;  // of each filter
};

// The unbroken run of rows that starts at rows[k].
std::span<const Index> run_from(const Tracks& tracks, std::span<const Index> rows, std::size_t k) {
  std::size_t end = k + 1;
  while (end < rows.size() && tracks.next()[static_cast<std::size_t>(rows[end - 1])] == rows[end]) ++end;
  return rows.subspan(k, end - k);
}

}  // namespace

std::vector<Presence::Visit> recorded_visits(const Tracks& tracks, const Eigen::Array3d& sigma, EntryVelocity how) {
  std::vector<Presence::Visit> visits;
  std::vector<SmoothedAxis> axes;
  const bool all_recorded = tracks.has_velocity() && tracks.vel().isFinite().all();
  const bool estimated = how == EntryVelocity::estimated && !all_recorded;
  for (Index a = 0; a < tracks.dims() && estimated; ++a) axes.emplace_back(tracks, a, sigma[a]);
  const auto frame = tracks.frame();
  const auto episode_of = [&](std::int64_t f) {
    const auto e = tracks.episodes();
    return std::upper_bound(e.begin(), e.end(), f) - e.begin();
  };
  for (std::uint32_t t = 0; t < tracks.track_count(); ++t) {
    const auto rows = tracks.rows_of(t);
    for (std::size_t k = 0; k < rows.size();) {
      const auto frame_of = [&](std::size_t i) { return frame[static_cast<std::size_t>(rows[i])]; };
      std::size_t end = k + 1;
      while (end < rows.size() && episode_of(frame_of(end)) == episode_of(frame_of(k))) ++end;
      const Index first = rows[k];
      Presence::Visit visit{
          t, tracks.kind(first), frame_of(k), frame_of(end - 1), tracks.pos().row(first).transpose(), Eigen::Array3d::Zero()};
      const bool recorded = tracks.has_velocity() && tracks.vel().row(first).isFinite().all();
      if (recorded) visit.vel = tracks.vel().row(first).transpose();
      const auto run = run_from(tracks, rows, k);
      if (!estimated && !recorded && run.size() > 1)
        visit.vel = (tracks.pos().row(run[1]) - tracks.pos().row(run[0])).transpose() / tracks.dt();
      for (std::size_t a = 0; a < axes.size() && !recorded; ++a) {
        const Entry entry = axes[a](run);
        visit.vel[static_cast<Index>(a)] = entry.velocity / tracks.dt();
        visit.vel_error[static_cast<Index>(a)] = std::sqrt(entry.variance) / tracks.dt();
      }
      visits.push_back(visit);
      k = end;
    }
  }
  return visits;
}

}  // namespace swarmfit
