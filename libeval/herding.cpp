// SPDX-License-Identifier: MIT
#include "libeval/herding.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "libtrack/vectors.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

struct HerdMoment {
  std::int64_t frame;
  Array3d centre = Array3d::Zero(), shepherd = Array3d::Constant(Herding::kNone);
  double spread = 0, farthest = 0, polarisation = Herding::kNone, sheep = 0;
};

HerdMoment moment_of(const Tracks& tracks, const FrameRange& frame, const HerdingOptions& options) {
  HerdMoment m{.frame = frame.number};
  Array3d headings = Array3d::Zero();
  double moving = 0;
  bool led = false;
  for (Index row = frame.first; row < frame.first + frame.count; ++row) {
    const Array3d here = tracks.pos().row(row).transpose();
    if (tracks.kind(row) == options.shepherd && !led) m.shepherd = here, led = true;
    if (tracks.kind(row) != options.sheep) continue;
    m.centre += here, m.sheep += 1;
    const Index next = tracks.next()[static_cast<std::size_t>(row)];
    const Array3d step = next < 0 ? Array3d(Array3d::Zero()) : Array3d(tracks.pos().row(next).transpose() - here);
    if (const double moved = length(step); moved > 0) headings += step / moved, moving += 1;
  }
  m.centre /= m.sheep;
  if (moving > 1) m.polarisation = length(headings) / moving;
  for (Index row = frame.first; row < frame.first + frame.count; ++row) {
    if (tracks.kind(row) != options.sheep) continue;
    const double off = length(tracks.pos().row(row).transpose() - m.centre);
    m.spread += off / m.sheep;
    m.farthest = std::max(m.farthest, off);
  }
  return m;
}

// Of the finite values.
struct Mean {
  double sum = 0, count = 0;
  void add(double x) {
    if (std::isfinite(x)) sum += x, count += 1;
  }
  double value() const { return count > 0 ? sum / count : Herding::kNone; }
};

// Signed distance of the shepherd from the line, positive to the left of the way home.
double side_of(const HerdMoment& m, const Array3d& target) {
  const Array3d way = target - m.centre, off = m.shepherd - m.centre;
  const double distance = std::hypot(way[0], way[1]);
  return distance > 0 ? (way[0] * off[1] - way[1] * off[0]) / distance : Herding::kNone;
}

double autocorrelation(const std::vector<double>& x, std::size_t lag) {
  double mean = 0, product = 0, square = 0;
  for (const double value : x) mean += value / static_cast<double>(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) square += (x[k] - mean) * (x[k] - mean) / static_cast<double>(x.size());
  for (std::size_t k = 0; k + lag < x.size(); ++k) product += (x[k] - mean) * (x[k + lag] - mean) / static_cast<double>(x.size() - lag);
  return square > 0 ? product / square : Herding::kNone;
}

// The drives: unbroken runs of frames in which the shepherd is there and no sheep is too far out.
void measure_sides(const std::vector<std::vector<double>>& drives, double dt, Herding& out) {
  Mean square;
  double frames = 0, changes = 0;
  std::vector<double> longest;
  for (const auto& drive : drives) {
    for (const double x : drive) square.add(x * x);
    frames += static_cast<double>(drive.size()) - 1;
    for (std::size_t k = 1; k < drive.size(); ++k) changes += (drive[k] < 0) != (drive[k - 1] < 0);
    if (drive.size() > longest.size()) longest = drive;
  }
  out.side = std::sqrt(square.value());
  if (changes > 0) out.side_period = 2 * frames * dt / changes;
  for (std::size_t lag = 1; lag <= longest.size() / 2; ++lag) {
    const double r = autocorrelation(longest, lag);
    if (std::isnan(out.side_least) || r < out.side_least) out.side_least = r;
  }
}

}  // namespace

Herding herding(const Tracks& tracks, const HerdingOptions& options) {
  if (!(options.home > 0) || !(options.repulsion > 0)) throw std::invalid_argument("herding: home and repulsion must be positive");
  std::vector<HerdMoment> moments;
  for (const FrameRange& frame : tracks.frames())
    if (const HerdMoment m = moment_of(tracks, frame, options); m.sheep > 0) moments.push_back(m);
  Herding out;
  if (moments.empty()) return out;
  const Array3d target = options.target.value_or(moments.back().centre);
  const auto home =
      std::find_if(moments.begin(), moments.end(), [&](const HerdMoment& m) { return length(m.centre - target) < options.home; });
  if (home != moments.end()) {
    out.time = static_cast<double>(home->frame - moments.front().frame) * tracks.dt();
    moments.erase(home + 1, moments.end());
  }
  Mean collecting, spread, speed, polarisation;
  std::vector<std::vector<double>> drives(1);
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const HerdMoment& m = moments[k];
    const bool collects = m.farthest > options.repulsion * std::cbrt(m.sheep * m.sheep);
    const bool follows = k > 0 && m.frame == moments[k - 1].frame + 1;
    collecting.add(collects ? 1 : 0), spread.add(m.spread), polarisation.add(m.polarisation);
    if (follows && m.sheep == moments[k - 1].sheep) speed.add(length(m.centre - moments[k - 1].centre) / tracks.dt());
    const double side = side_of(m, target);
    if (!follows || collects || !std::isfinite(side)) drives.emplace_back();
    if (!collects && std::isfinite(side)) drives.back().push_back(side);
  }
  std::erase_if(drives, [](const auto& drive) { return drive.empty(); });
  out.collecting = collecting.value(), out.spread = spread.value(), out.speed = speed.value(), out.polarisation = polarisation.value();
  if (!drives.empty()) measure_sides(drives, tracks.dt(), out);
  return out;
}

}  // namespace swarmfit
