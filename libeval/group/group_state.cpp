// SPDX-License-Identifier: MIT
#include "libeval/group/group_state.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "libeval/group/order_formulas.h"
#include "libtrack/nan.h"
#include "libtrack/quantile.h"

namespace swarmfit {
namespace {

using F = StateFeatures;
using H = StateHistory;

// ---- thresholds: ours, chosen where planted states and simulations of the published models part --------------------------------
constexpr double kWhole = 0.7;           // less in the largest component is no one group
constexpr double kTogether = 0.95;       // cohesive
constexpr double kMill = 0.65;           // M of a directed mill
constexpr double kLine = 0.05;           // axis ratio of a chain
constexpr double kParallel = 0.9;        // P of what flies as one
constexpr double kUnordered = 0.4;       // P of a swarm
constexpr double kStill = 0.3;           // P of what rotates in place
constexpr double kTurningLine = 0.1;     // 0.01 rad a step of the reference's 0.5, where a chain is some 10 long
constexpr double kAlongLine = 0.9;       // Ma over that of random headings: who is in the chain runs to and fro along it
constexpr double kFills = 0.5;           // of a periodic box across: a gas, whatever its links; 1/4 of the area, as in Strömbom's programs
constexpr double kHalf = 0.5;            // |M| of either half of a figure of eight
constexpr double kVortexTurning = 0.5;   // a flock that flies straight has less than 0.2, a ring 1
constexpr double kVortexRotation = 1.1;  // Ma over that of random headings
constexpr double kComet = 3;             // rms distance over the median, for the tail
constexpr double kStragglers = 0.05;     // of all: fewer have been lost, and are no tail
constexpr double kCompact = 5.0 / 6;     // rms extent over the link distance: 100 m of 120 m
constexpr double kWasAligned = 0.8;      // at the start of a semi-vortex
constexpr double kWasDense = 1.0 / 3;    // rms extent over the link distance at the start of a compact flock: 35 m of 120 m for R = 50 m

double rotation_of_mill(const F& f) { return f.dims == 2 ? 0.85 : 0.92; }
double random_rotation(const F& f) { return f.dims == 2 ? 0.6366 : 0.7854; }  // 2/π, π/4
double hollow_core(const F& f) { return f.dims == 2 ? 0.05 : 0.025; }         // a uniform disc has 1/8 there, a ball 1/16
bool hollow(const F& f) { return f.core < hollow_core(f); }
bool rotates(const F& f) { return f.rotation >= random_rotation(f); }  // rather than moving in and out
bool circulates(const F& f) { return f.axis_turn > kTurningLine || f.rotation < kAlongLine * random_rotation(f); }
bool split(const F& f) { return f.largest < kWhole && f.parts >= 2; }
bool vortex(const F& f) {
  return f.polarisation < kStill && f.turning > kVortexTurning && f.rotation > kVortexRotation * random_rotation(f);
}
bool flies(const F& f, double share) { return f.polarisation > kParallel && f.largest >= share; }

constexpr auto kGroup = StateWords::group, kFlock = StateWords::flock;

const std::array kStates{
    GroupState{"split", "split", kGroup, "largest component < 70 % of all, two subgroups or more",
               [](const F& f, const H&) { return split(f); }},
    GroupState{"disordered", "disordered", kGroup, "largest component < 70 % of all, and no second subgroup of a tenth",
               [](const F& f, const H&) { return f.largest < kWhole; }},
    GroupState{"moving_chain", "moving chain", kGroup, "axis ratio < 0.05, P ≥ 0.9",
               [](const F& f, const H&) { return f.axis_ratio < kLine && f.polarisation >= kParallel; }},
    GroupState{"figure_of_eight", "figure of eight", kGroup,
               "P < 0.5, halves along the long axis rotate in opposite senses, both |M| > 0.5",
               [](const F& f, const H&) { return f.polarisation < 0.5 && f.halves < -kHalf; }},
    GroupState{"rotating_chain", "rotating chain", kGroup,
               "axis ratio < 0.05, P < 0.9, axis turning by > 0.1 speed/extent, or Ma < 0.9 times that of random headings",
               [](const F& f, const H&) { return f.axis_ratio < kLine && circulates(f); }},
    GroupState{"mill", "directed mill", kGroup, "M > 0.65", [](const F& f, const H&) { return f.net_rotation > kMill; }},
    GroupState{"undirected_mill", "undirected mill", kGroup, "Ma > 0.85 (space 0.92), P < 0.3, < 5 % (2.5 %) within half the median radius",
               [](const F& f, const H&) { return f.rotation > rotation_of_mill(f) && f.polarisation < kStill && hollow(f); }},
    GroupState{"aligned", "aligned", kGroup, "P > 0.9, axis ratio ≥ 0.05",
               [](const F& f, const H&) { return f.polarisation > kParallel && f.axis_ratio >= kLine; }},
    GroupState{"swarm", "swarm", kGroup,
               "P < 0.4, not hollow or Ma < that of random headings, reaching across less than half of a periodic box",
               [](const F& f, const H&) { return f.polarisation < kUnordered && !(hollow(f) && rotates(f)) && f.span < kFills; }},
    GroupState{"disordered", "disordered", kGroup, "none of the above", [](const F&, const H&) { return true; }},

    GroupState{"split", "split", kFlock, "largest component < 70 % of all, two subgroups or more",
               [](const F& f, const H&) { return split(f); }},
    GroupState{"semi_vortex", "semi-vortex", kFlock, "a vortex that began with P > 0.8",
               [](const F& f, const H& h) { return h.aligned && vortex(f); }},
    GroupState{"vortex", "vortex", kFlock, "P < 0.3, Ma > 1.1 times that of random headings, angular speed > 0.5 speed/median radius",
               [](const F& f, const H&) { return vortex(f); }},
    GroupState{"comet", "comet", kFlock,
               "P > 0.9, largest component ≥ 70 %, rms distance of all from its middle > 3 times the median, 5 % farther than that",
               [](const F& f, const H&) { return flies(f, kWhole) && f.tail > kComet && f.straying >= kStragglers; }},
    GroupState{"convergence", "convergence", kFlock,
               "P > 0.9, largest component ≥ 95 %, two subgroups or more before, for a tenth of a window",
               [](const F& f, const H& h) { return h.split && flies(f, kTogether); }},
    GroupState{"compact", "compact", kFlock,
               "P > 0.9, largest component ≥ 95 %, rms extent < 5/6 of the link distance, having begun with < 1/3",
               [](const F& f, const H& h) { return h.dense && flies(f, kTogether) && f.extent < kCompact * f.link; }},
    GroupState{"cohesive", "cohesive", kFlock, "P > 0.9, largest component ≥ 95 %",
               [](const F& f, const H&) { return flies(f, kTogether); }},
    GroupState{"disordered", "disordered", kFlock, "none of the above", [](const F&, const H&) { return true; }},
};

// Mean of what is defined, NaN if nothing is.
template <class Range, class Get>
double mean_of(const Range& range, const Get& get) {
  double sum = 0, count = 0;
  for (const auto& each : range)
    if (const double x = get(each); std::isfinite(x)) sum += x, ++count;
  return count > 0 ? sum / count : kNaN;
}

// Turning of the long axis as a vector, so that a mean over time tells turning from trembling; NaN where there is none.
Eigen::Vector3d turn_of(const Moment& moment) {
  const Motion& m = moment.motion();
  if (m.row.size() < 3) return Eigen::Vector3d::Constant(kNaN);
  const int dims = moment.options().dims;
  const Eigen::Vector3d a = principal_axes(m.from, dims).axis.col(0), b = principal_axes(m.to, dims).axis.col(0);
  const Eigen::Vector3d cross = a.cross(b) * (a.dot(b) < 0 ? -1.0 : 1.0);
  const double sine = cross.norm();
  return sine > 0 ? Eigen::Vector3d(cross / sine * std::asin(std::min(1.0, sine)) / moment.options().dt)
                  : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

// The shortest way round along the axes of a periodic box.
Eigen::Vector3d wrapped(Eigen::Vector3d way, const Eigen::Array3d& period) {
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    if (period[axis] > 0) way[axis] -= period[axis] * std::round(way[axis] / period[axis]);
  return way;
}

// How far the places reach along the periodic axis that they fill most, over its side.
double span_of(const Moment& m) {
  double most = 0;
  const Eigen::Array3d& period = m.options().period;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (!(period[axis] > 0) || m.size() == 0) continue;
    const auto [least, greatest] =
        std::minmax_element(m.offsets().begin(), m.offsets().end(), [&](const auto& a, const auto& b) { return a[axis] < b[axis]; });
    most = std::max(most, ((*greatest)[axis] - (*least)[axis]) / period[axis]);
  }
  return most;
}

// Who lags behind, as seen from the middle of the largest component.
void measure_tail(const Moment& all, const Moment& main, F& f) {
  f.tail = f.straying = kNaN;
  if (all.size() == 0) return;
  std::vector<double> distance;
  double squares = 0, far = 0;
  for (const Eigen::Vector3d& offset : all.offsets()) {
    distance.push_back(wrapped(offset - (main.centre() - all.centre()), all.options().period).norm());
    squares += distance.back() * distance.back();
  }
  const double middle = median(distance), count = static_cast<double>(distance.size());
  for (const double d : distance) far += d > kComet * middle ? 1 : 0;
  if (middle > 0) f.tail = std::sqrt(squares / count) / middle;
  f.straying = far / count;
}

}  // namespace

std::span<const GroupState> state_table() { return kStates; }

const GroupState& state_of(const StateFeatures& features, const StateHistory& history, StateWords words) {
  const auto found =
      std::find_if(kStates.begin(), kStates.end(), [&](const GroupState& s) { return s.words == words && s.holds(features, history); });
  return *found;  // the last of each vocabulary always holds
}

std::vector<StateSpell> spells(const StateCourse& course) {
  std::vector<StateSpell> out;
  for (const StateWindow& w : course.windows) {
    if (out.empty() || out.back().state->key != w.state->key) out.push_back({w.first, w.last, w.state});
    out.back().last = w.last;
  }
  return out;
}

void StateWatch::add(const Moment& all) {
  namespace of = order_formulas;
  if (!frame_.empty() && all.places().frame - frame_.front() >= window_) close();
  StateFeatures f;
  f.dims = all.options().dims;
  f.link = all.link();
  f.parts = of::parts(all);
  f.largest = of::largest(all);
  const bool whole = all.components().size.size() == 1;
  const Places main = whole ? Places{} : largest_component(all);
  const Moment part(all.options(), main);
  const Moment& m = whole ? all : part;
  f.polarisation = of::polarisation(m);
  f.net_rotation = of::net_rotation(m);
  f.rotation = of::rotation(m);
  f.axis_ratio = of::axis_ratio(m);
  f.core = of::core(m);
  f.halves = of::halves(m);
  f.extent = of::extent(m);
  f.median_radius = of::median_radius(m);
  f.turning = of::angular_speed(m);
  f.span = span_of(m);
  measure_tail(all, m, f);
  if (frame_.empty() && course_.windows.empty()) history_.dense = of::extent(all) < kWasDense * all.link();
  seen_.push_back(f);
  speed_.push_back(of::speed(m));
  turn_.push_back(turn_of(m));
  frame_.push_back(all.places().frame);
  if (course_.windows.empty() && frame_.back() - frame_.front() < std::max<std::int64_t>(1, window_ / 10)) early_.push_back(f.polarisation);
  watch_parts(frame_.back(), static_cast<int>(f.parts));
}

void StateWatch::watch_parts(std::int64_t frame, int parts) {
  if (parts_ < 0) parts_ = parts, since_ = frame;
  if (parts != candidate_) candidate_ = parts, since_ = frame;
  if (frame - since_ + 1 < std::max<std::int64_t>(1, window_ / 10)) return;
  history_.split = history_.split || candidate_ >= 2;
  if (candidate_ == parts_) return;
  if (parts_ > 0 && candidate_ > 0) course_.events.push_back({since_, parts_, candidate_});
  parts_ = candidate_;
}

void StateWatch::close() {
  if (frame_.empty()) return;
  const auto mean = [&](double StateFeatures::*part) { return mean_of(seen_, [&](const StateFeatures& f) { return f.*part; }); };
  StateFeatures f = seen_.front();
  for (double StateFeatures::*part :
       {&StateFeatures::link, &StateFeatures::parts, &StateFeatures::largest, &StateFeatures::polarisation, &StateFeatures::net_rotation,
        &StateFeatures::rotation, &StateFeatures::axis_ratio, &StateFeatures::core, &StateFeatures::halves, &StateFeatures::extent,
        &StateFeatures::median_radius, &StateFeatures::turning, &StateFeatures::span, &StateFeatures::tail, &StateFeatures::straying})
    f.*part = mean(part);
  const double speed = mean_of(speed_, [](double x) { return x; });
  Eigen::Vector3d turn;
  for (Eigen::Index axis = 0; axis < 3; ++axis) turn[axis] = mean_of(turn_, [&](const Eigen::Vector3d& t) { return t[axis]; });
  f.axis_turn = turn.norm() * f.extent / speed;
  f.turning *= f.median_radius / speed;
  f.parts = std::round(f.parts);
  if (course_.windows.empty()) history_.aligned = mean_of(early_, [](double x) { return x; }) > kWasAligned;
  course_.windows.push_back({frame_.front(), frame_.back(), &state_of(f, history_, words_), f});
  seen_.clear(), speed_.clear(), turn_.clear(), frame_.clear();
}

StateCourse StateWatch::finish() {
  if (!frame_.empty() && (course_.windows.empty() || 2 * (frame_.back() - frame_.front() + 1) >= window_)) close();
  return std::move(course_);
}

StateCourse state_course(const Tracks& tracks, const MomentOptions& options, StateWords words, std::int64_t window) {
  StateWatch watch(words, window);
  for_each_moment(tracks, options, [&](const Moment& moment) { watch.add(moment); });
  return watch.finish();
}

std::string state_name(const std::string& key) {
  for (const GroupState& state : state_table())
    if (state.key == key) return std::string(state.name);
  return key;
}

}  // namespace swarmfit
