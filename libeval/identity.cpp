// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "libtrack/quantile.h"

#include "libeval/robust.h"
#include "libeval/suspicions.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
constexpr double kWild = 10;   // robust standard deviations
constexpr double kSudden = 3;  // times the steps around it
constexpr Index kAround = 2;   // steps looked at on either side

class Identities {
 public:
  explicit Identities(const Tracks& tracks) : tracks_(tracks), previous_(static_cast<std::size_t>(tracks.rows()), -1) {
    for (Index row = 0; row < tracks.rows(); ++row)
      if (next(row) >= 0) previous_[static_cast<std::size_t>(next(row))] = row;
  }

  std::vector<IdentityEvent> find() {
    swaps();
    jumps();
    std::sort(events_.begin(), events_.end(), [](const auto& a, const auto& b) { return a.row < b.row; });
    return std::move(events_);
  }

 private:
  Array3d at(Index row) const { return tracks_.pos().row(row).transpose(); }
  Index next(Index row) const { return tracks_.next()[static_cast<std::size_t>(row)]; }
  Index previous(Index row) const { return previous_[static_cast<std::size_t>(row)]; }
  bool inner(Index row) const { return next(row) >= 0 && previous(row) >= 0; }
  double step(Index row) const { return (at(next(row)) - at(row)).matrix().norm(); }

  // How far the next position of `actual` lies from where a straight path would take `row`.
  double miss(Index row, Index actual) const { return (at(next(actual)) - 2 * at(row) + at(previous(row))).matrix().norm(); }

  void swaps() {
    std::vector<double> misses;
    for (Index row = 0; row < tracks_.rows(); ++row)
      if (inner(row)) misses.push_back(miss(row, row));
    if (misses.empty()) return;
    const double limit = robust(std::move(misses)).above(kWild);
    for (const FrameRange& frame : tracks_.frames()) {
      std::vector<Index> strayed;
      for (Index row = frame.first; row < frame.first + frame.count; ++row)
        if (inner(row) && miss(row, row) > limit) strayed.push_back(row);
      for (std::size_t i = 0; i < strayed.size(); ++i)
        for (std::size_t j = i + 1; j < strayed.size(); ++j)
          if (miss(strayed[i], strayed[j]) <= limit && miss(strayed[j], strayed[i]) <= limit) events_.push_back({strayed[i], strayed[j]});
    }
  }

  void jumps() {
    std::vector<double> steps;
    for (Index row = 0; row < tracks_.rows(); ++row)
      if (next(row) >= 0) steps.push_back(step(row));
    if (steps.empty()) return;
    std::vector<double> distances = nearest_neighbours(tracks_).distance;
    std::erase_if(distances, [](double d) { return !std::isfinite(d); });
    const double wild = robust(std::move(steps)).above(kWild);
    const double limit = distances.empty() ? wild : std::max(wild, median(std::move(distances)));
    for (Index row = 0; row < tracks_.rows(); ++row)
      if (next(row) >= 0 && step(row) > limit && sudden(row) && !swapped(row)) events_.push_back({row, -1});
  }

  bool sudden(Index row) const {
    std::vector<double> around;
    Index before = previous(row), after = next(row);
    for (Index k = 0; k < kAround; ++k) {
      if (before >= 0) around.push_back(step(before)), before = previous(before);
      if (next(after) >= 0) around.push_back(step(after)), after = next(after);
    }
    return around.empty() || step(row) > kSudden * median(std::move(around));
  }

  bool swapped(Index row) const {
    return std::any_of(events_.begin(), events_.end(), [row](const auto& e) { return e.other >= 0 && (e.row == row || e.other == row); });
  }

  const Tracks& tracks_;
  std::vector<Index> previous_;
  std::vector<IdentityEvent> events_;
};

}  // namespace

std::vector<IdentityEvent> identity_events(const Tracks& tracks) { return Identities(tracks).find(); }

}  // namespace swarmfit
