// SPDX-License-Identifier: MIT
#include "libeval/suspicions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "libtrack/quantile.h"

namespace swarmfit {
namespace {

constexpr std::size_t kExamples = 3;
constexpr Index kFrozen = 10;           // frames on the same spot
constexpr double kCoincident = 1e-9;    // [unit], as in the metrics
constexpr double kFewIndividuals = 10;  // per frame
constexpr double kFramesForJerk = 4;    // a segment needs them for alpha and mu

using Suspected = std::optional<Suspicion>;

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

// "1 track", "3 tracks"
std::string counted(std::size_t n, std::string_view thing) { return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s"); }

// Collects places to look at.
class Places {
 public:
  explicit Places(const Tracks& tracks) : tracks_(tracks) {}
  void add(Index row) {
    if (++count_ > kExamples) return;
    const auto k = static_cast<std::size_t>(row);
    if (!text_.empty()) text_ += "; ";
    text_ += fmt::format("track {}, frame {}", tracks_.names()[tracks_.track()[k]], tracks_.frame()[k]);
  }
  std::size_t count() const { return count_; }
  std::string text() const { return text_; }

 private:
  const Tracks& tracks_;
  std::size_t count_ = 0;
  std::string text_;
};

Suspected swaps(const Tracks& tracks, const std::vector<IdentityEvent>& events) {
  Places places(tracks);
  for (const auto& e : events)
    if (e.other >= 0) places.add(e.row);
  if (places.count() == 0) return {};
  return Suspicion{
      "identity swap",
      fmt::format("{}: two tracks that continue smoothly only if their names are exchanged; correct the names, or cut the tracks there.",
                  counted(places.count(), "identity swap")),
      places.text()};
}

Suspected jumps(const Tracks& tracks, const Summary& s, const std::vector<IdentityEvent>& events) {
  Places places(tracks);
  for (const auto& e : events)
    if (e.other < 0) places.add(e.row);
  if (places.count() == 0) return {};
  return Suspicion{
      "identity jump",
      fmt::format("{} far beyond all others (the median step is {:.3g} {}), as when a track goes over to another individual; cut the "
                  "tracks there.",
                  counted(places.count(), "step"), s.speed.median * tracks.dt(), tracks.meta().unit),
      places.text()};
}

Suspected double_detections(const Tracks& tracks) {
  const Nearest nearest = nearest_neighbours(tracks);
  Places places(tracks);
  for (Index row = 0; row < tracks.rows(); ++row)
    if (nearest.distance[static_cast<std::size_t>(row)] < kCoincident && nearest.row[static_cast<std::size_t>(row)] > row) places.add(row);
  if (places.count() == 0) return {};
  return Suspicion{"double detection",
                   fmt::format("{} in exactly the same place; remove doubled tracks, they make the nearest-neighbour distance 0.",
                               counted(places.count(), "pair")),
                   places.text()};
}

Suspected frozen(const Tracks& tracks, const Summary& s) {
  if (!(s.speed.median > 0)) return {};
  Places places(tracks);
  std::vector<bool> seen(tracks.track_count(), false);
  for_each_segment(tracks, kFrozen, [&](std::span<const Index> rows) {
    Index still = 1;
    for (std::size_t k = 1; k < rows.size(); ++k) {
      const bool same = (tracks.pos().row(rows[k]) == tracks.pos().row(rows[k - 1])).all();
      still = same ? still + 1 : 1;
      const auto track = tracks.track()[static_cast<std::size_t>(rows[k])];
      if (still < kFrozen || seen[track]) continue;
      seen[track] = true;
      places.add(rows[k - static_cast<std::size_t>(kFrozen) + 1]);
    }
  });
  if (places.count() == 0) return {};
  return Suspicion{
      "frozen track",
      fmt::format("{} of {} with exactly the same position for {} frames or more while others move, as when a tracker holds on to the "
                  "background; leave them out unless the animals rest.",
                  places.count(), counted(s.tracks, "track"), kFrozen),
      places.text()};
}

bool near(double x, double target) { return std::abs(std::log(x / target)) < std::log(1.25); }

std::string unit_advice(double ratio, double dt) {
  if (near(ratio, dt)) return "they look like lengths per frame instead of per second";
  for (const double power : {1000.0, 100.0, 10.0, 0.1, 0.01, 0.001})
    if (near(ratio, power)) return fmt::format("the factor {:g} looks like two different length units", power);
  return "the frame rate may be wrong (--fps)";
}

// Recorded velocities must be the derivative of the positions.
Suspected unit(const Tracks& tracks) {
  if (!tracks.has_velocity()) return {};
  std::vector<double> ratios;
  for (Index row = 0; row < tracks.rows(); ++row) {
    const Index next = tracks.next()[static_cast<std::size_t>(row)];
    if (next < 0) continue;
    const double difference = (tracks.pos().row(next) - tracks.pos().row(row)).matrix().norm() / tracks.dt();
    const double ratio = tracks.vel().row(row).matrix().norm() / difference;
    if (std::isfinite(ratio)) ratios.push_back(ratio);
  }
  const double ratio = median(std::move(ratios));
  if (!(ratio > 0) || near(ratio, 1)) return {};
  return Suspicion{"unit",
                   fmt::format("Recorded velocities are {:.3g} times the differences of positions over the frame interval of {:.4g} s: {}.",
                               ratio, tracks.dt(), unit_advice(ratio, tracks.dt())),
                   ""};
}

Suspected constant_columns(const Tracks& tracks) {
  std::string names;
  const auto look = [&](const Rows& rows, std::string_view prefix) {
    for (Index axis = 0; axis < tracks.dims() && rows.rows() > 1; ++axis)
      if ((rows.col(axis) == rows(0, axis)).all()) names += fmt::format("{}{}{}", names.empty() ? "" : ", ", prefix, "xyz"[axis]);
  };
  look(tracks.pos(), "");
  look(tracks.vel(), "v");
  look(tracks.acc(), "a");
  if (names.empty()) return {};
  return Suspicion{"constant column", fmt::format("The same value in every row of {}; check the column mapping (--columns).", names), ""};
}

std::string sigma_text(const Tracks& tracks, const Localisation& l) {
  std::string text;
  for (Index axis = 0; axis < tracks.dims(); ++axis) text += fmt::format("{}{:.2g}", axis ? ", " : "", l.sigma[axis]);
  return fmt::format("{} {} ({})", text, tracks.meta().unit, tracks.dims() == 3 ? "x, y, z" : "x, y");
}

Suspected measurement_error(const Tracks& tracks, const Summary& s) {
  const Localisation& l = s.localisation;
  if (l.samples == 0 || !(l.acceleration_share > 0.5 || l.jerk_share > 0.5) || !(l.white || l.rounding)) return {};
  return Suspicion{"measurement error",
                   fmt::format("{} of {} explains {} of the squared median acceleration and {} of the squared median jerk: these mostly "
                               "measure the {}; simulate the error too (--obs-noise estimate), or compare over longer lags (--lags).",
                               l.rounding ? "Rounding of the positions" : "A measurement error", sigma_text(tracks, l),
                               percent(l.acceleration_share), percent(l.jerk_share), l.rounding ? "file's last digit" : "camera"),
                   ""};
}

// Simulated motion is exact, and known to be.
Suspected smoothed(const Tracks& tracks, const Summary& s) {
  const Localisation& l = s.localisation;
  if (l.samples == 0 || l.white || tracks.meta().from.format == "simulated") return {};
  return Suspicion{"smoothed positions",
                   "The errors of positions do not look independent from frame to frame, as those of a camera are: positions were "
                   "smoothed, interpolated or simulated, or the motion itself is this rough. If they were smoothed, smooth simulations in "
                   "the same way before comparing.",
                   ""};
}

Suspected short_segments(const Summary& s) {
  if (s.segments == 0 || !(s.segment_length.median < 2 * kFramesForJerk)) return {};
  return Suspicion{"short segments",
                   fmt::format("Half of the {} are no longer than {:g} frames, and {:g} are needed for one value of angular acceleration "
                               "or jerk: these metrics come from the few individuals that were tracked for long.",
                               counted(s.segments, "unbroken segment"), s.segment_length.median, kFramesForJerk),
                   ""};
}

Suspected few_individuals(const Summary& s) {
  if (!(s.individuals.median <= kFewIndividuals)) return {};
  return Suspicion{"few individuals",
                   fmt::format("{:g} individuals in the median frame: if only part of the group was tracked, nearest-neighbour distances "
                               "are too long (say how many there were with --population).",
                               s.individuals.median),
                   ""};
}

}  // namespace

std::vector<Suspicion> suspicions(const Tracks& tracks, const Summary& s) {
  const auto events = identity_events(tracks);
  std::vector<Suspicion> out;
  for (Suspected& found : std::array<Suspected, 10>{swaps(tracks, events), jumps(tracks, s, events), double_detections(tracks),
                                                    frozen(tracks, s), unit(tracks), constant_columns(tracks), measurement_error(tracks, s),
                                                    smoothed(tracks, s), short_segments(s), few_individuals(s)})
    if (found) out.push_back(std::move(*found));
  return out;
}

}  // namespace swarmfit
