// SPDX-License-Identifier: MIT
#include "fit/entry.h"

#include <algorithm>

namespace swarmfit {
namespace {

constexpr std::size_t kFrames = 5;

// Line and parabola through the first frames of a visit, per axis; times in frames from their middle.
struct Start {
  std::size_t n = 0;                                                                // frames
  Eigen::Array3d line = Eigen::Array3d::Zero(), parabola = Eigen::Array3d::Zero();  // derivatives at the first frame [unit/frame]
  Eigen::Array3d residual = Eigen::Array3d::Zero();                                 // sum of squares about the parabola [unit²]
  double line_variance = 0, parabola_variance = 0;                                  // of the derivatives, in variances of a position
};

Start start_of(const Tracks& tracks, std::span<const Index> run) {
  Start s;
  s.n = std::min(run.size(), kFrames);
  if (s.n < 2) return s;
  const double first = -0.5 * static_cast<double>(s.n - 1);
  const auto time = [&](std::size_t k) { return first + static_cast<double>(k); };
  double t2 = 0, q2 = 0;
  for (std::size_t k = 0; k < s.n; ++k) t2 += time(k) * time(k);
  const auto bend = [&](std::size_t k) { return time(k) * time(k) - t2 / static_cast<double>(s.n); };  // orthogonal to 1 and t
  Eigen::Array3d mean = Eigen::Array3d::Zero(), slope = mean, curve = mean;
  const auto pos = [&](std::size_t k) -> Eigen::Array3d { return tracks.pos().row(run[k]).transpose(); };
  for (std::size_t k = 0; k < s.n; ++k) {
    q2 += bend(k) * bend(k);
    mean += pos(k) / static_cast<double>(s.n);
    slope += time(k) * pos(k) / t2;
  }
  s.line = s.parabola = slope;
  s.line_variance = s.parabola_variance = 1 / t2;
  if (s.n < 3) return s;
  for (std::size_t k = 0; k < s.n; ++k) curve += bend(k) * pos(k) / q2;
  s.parabola += 2 * first * curve;
  s.parabola_variance += 4 * first * first / q2;
  for (std::size_t k = 0; k < s.n; ++k) s.residual += (pos(k) - mean - time(k) * slope - bend(k) * curve).square();
  return s;
}

// What all visits say of the two, per axis.
struct Judgement {
  Eigen::Array3d error = Eigen::Array3d::Zero();                    // standard deviation of positions about parabolas [unit]
  Eigen::Array3d bias = Eigen::Array3d::Zero();                     // mean square of the line's [unit²/frame²]
  Eigen::Array<bool, 3, 1> bent = decltype(bent)::Constant(false);  // the parabola errs less
};

Judgement judge(const std::vector<Start>& starts) {
  Judgement out;
  Eigen::Array3d residual = Eigen::Array3d::Zero(), apart = residual;
  double free = 0, chance = 0, bendable = 0;
  for (const Start& s : starts) {
    if (s.n < 3) continue;
    residual += s.residual;
    free += static_cast<double>(s.n - 3);
    apart += (s.parabola - s.line).square();
    chance += s.parabola_variance - s.line_variance;
    bendable += 1;
  }
  if (free == 0) return out;
  const Eigen::Array3d variance = residual / free;
  out.error = variance.sqrt();
  out.bias = (apart - chance * variance).max(0) / bendable;
  out.bent = apart > 2 * chance * variance;
  return out;
}

// The unbroken run of rows that starts at rows[k].
std::span<const Index> run_from(const Tracks& tracks, std::span<const Index> rows, std::size_t k) {
  std::size_t end = k + 1;
  while (end < rows.size() && tracks.next()[static_cast<std::size_t>(rows[end - 1])] == rows[end]) ++end;
  return rows.subspan(k, end - k);
}

}  // namespace

std::vector<Presence::Visit> recorded_visits(const Tracks& tracks) {
  std::vector<Presence::Visit> visits;
  std::vector<Start> starts;
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
      const Eigen::Array3d recorded =
          tracks.has_velocity() ? Eigen::Array3d(tracks.vel().row(first).transpose()) : Eigen::Array3d::Constant(NAN);
      visits.push_back({t, tracks.kind(first), frame_of(k), frame_of(end - 1), tracks.pos().row(first).transpose(), recorded});
      starts.push_back(start_of(tracks, run_from(tracks, rows, k)));
      k = end;
    }
  }
  const Judgement judgement = judge(starts);
  for (std::size_t v = 0; v < visits.size(); ++v) {
    const Start& s = starts[v];
    if (visits[v].vel.isFinite().all()) continue;
    const Eigen::Array3d variance = judgement.error.square();
    const auto& bent = judgement.bent;
    visits[v].vel = bent.select(s.parabola, s.line) / tracks.dt();
    visits[v].vel_error = bent.select(s.parabola_variance * variance, s.line_variance * variance + judgement.bias).sqrt() / tracks.dt();
  }
  return visits;
}

}  // namespace swarmfit
