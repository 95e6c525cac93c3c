// SPDX-License-Identifier: MIT
//
// ant_traffic – leaf-cutting ants that meet on a bridge: who gives way to whom
// =============================================================================
// D. Strömbom, A. Dussutour, Self-organized traffic via priority rules in leaf-cutting ants Atta colombica, PLoS Comput. Biol. 14:
// e1006523, 2018 (doi:10.1371/journal.pcbi.1006523); rules and numbers are those of the authors' published program. Kinds of ants: 0
// outbound, 1 laden and 2 unladen on their way home. libswarm/bridge.h is the bridge, with arrivals and exits; an ant walks the way it
// entered, and lengths are in cm. Everybody looks at the next ant ahead, if it is within `range` along the way, and all decide at once,
// every tau seconds:
//
//   bridge=narrow                        what is ahead
//     outbound    outbound: stop.  laden: stop, and begin to wait for X unladen ants, a second each.  unladen: stop, or walk on if not
//     waiting unladen     outbound that waits: walk, past it.  anybody else: stop laden       laden: stop.  anybody else: walk X is drawn
//     anew for every step in which the laden ant is ahead, from the counts of unladen ants that follow a laden one: at most 15
//   bridge=wide                          what is ahead, and less than half an ant's length aside
//     outbound    outbound or laden: turn.  unladen: walk
//     unladen     anybody: turn
//     laden       always walks
//     to turn is to step aside by one step's length, away from the other, and to go on as before
//   bridge=control   as wide, but ants stop where they would turn
//
// So laden ants come first, then unladen ones that follow them, outbound ants, and unladen ones by themselves: four roles, of which the
// second and the last are one kind. The private column `role` tells them apart: 0 outbound, 1 laden, 2 unladen and led past a waiting ant,
// 3 unladen and not. Ants pass through each other where one walks. The bridge leads along the common axis of all headings; who is next
// along it is the next ant ahead, however far aside. Nobody looks across the edge of a periodic arena.
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "libswarm/decision_clock.h"
#include "libswarm/headings.h"
#include "libswarm/noise.h"
#include "libswarm/own_heading.h"
#include "libswarm/parallel.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Rows of the parameter table, in its order.
enum Row : std::size_t { kOutbound, kLaden, kUnladen, kRange, kLength, kWait, kTau };

enum Kind : std::uint8_t { outbound, laden, unladen };
enum class Action { walk, stop, turn };

// Private columns: the way it walks, how long it waits still [s], and its role.
enum : Index { kHeading, kWaiting = 2, kRole, kColumns };

// Probability that so many unladen ants follow a laden one: 0 .. 15. That of 10 is 0 by a slip of the published program.
constexpr std::array<double, 16> kFollowers{.01, .25, .13, .13, .11, .09, .06, .05, .03, .053, 0, .025, .025, .012, .013, .012};

// All ants in the order in which they are on the bridge.
struct Line : Workspace {
  struct Place {
    double at;
    std::uint32_t id;
    Index row;
  };
  Array3d axis = Array3d::Zero();
  std::vector<Place> order;
  std::vector<std::size_t> place;  // in that order, by row
};

// The other that an ant sees.
struct Ahead {
  Index row = -1;      // -1: nobody within the range
  bool first = false;  // and nobody beyond it either
  Array3d aside = Array3d::Zero();
};

class AntTraffic : public Model {
 public:
  explicit AntTraffic(const Setup& setup)
      : frame_(setup.reference ? setup.reference->dt() : 0),
        narrow_(setup.options.at("bridge") == "narrow"),
        turns_(setup.options.at("bridge") == "wide") {}

  Index columns() const override { return kColumns; }

  std::unique_ptr<Workspace> workspace(const World&, const Rng&) const override { return std::make_unique<Line>(); }

  void enter(State& state, Index first, const World&, const StepContext& c) const override {
    for (Index i = first; i < state.size(); ++i) {
      const Array3d heading = own_heading(state, i, c.rng, 2);
      state.own.row(i).segment<2>(kHeading) = heading.head<2>().transpose();
      const auto kind = state.kind[static_cast<std::size_t>(i)];
      state.own(i, kRole) = kind == unladen ? 3 : kind;
    }
  }

  // Outbound ants first: those that come home see who waits from now on.
  Step step(const State& now, State& next, const World&, const StepContext& c) const override {
    const double interval = std::max(c.p[kTau], frame_);
    const auto decision = decision_due(c, interval);
    auto& line = static_cast<Line&>(*c.work);
    if (decision) line_up(now, line);
    for (const bool out : {true, false})
      for_each_agent(now.size(), [&](Index i, std::size_t) {
        if (out != (now.kind[static_cast<std::size_t>(i)] == outbound)) return;
        if (decision)
          decide(now, next, i, line, c, interval, *decision);
        else
          next.vel.row(i) = now.vel.row(i);
        next.pos.row(i) = now.pos.row(i) + c.dt * next.vel.row(i);
      });
    return Step::done;
  }

 private:
  // The way it walks; turned about when a wall has sent it back.
  static Array3d heading_at(const State& now, Index i) {
    const Array3d heading(now.own(i, kHeading), now.own(i, kHeading + 1), 0);
    return (now.vel.row(i).transpose() * heading).sum() < 0 ? Array3d(-heading) : heading;
  }

  // The axis of all headings, whichever way they point: half the angle of the sum of headings with doubled angles.
  static void line_up(const State& now, Line& line) {
    double sine = 0, cosine = 0;
    for (Index i = 0; i < now.size(); ++i) {
      const double x = now.own(i, kHeading), y = now.own(i, kHeading + 1);
      cosine += x * x - y * y, sine += 2 * x * y;
    }
    const double angle = std::atan2(sine, cosine) / 2;
    line.axis = {std::cos(angle), std::sin(angle), 0};
    line.order.clear();
    for (Index i = 0; i < now.size(); ++i)
      line.order.push_back({now.pos(i, 0) * line.axis[0] + now.pos(i, 1) * line.axis[1], now.id[static_cast<std::size_t>(i)], i});
    std::sort(line.order.begin(), line.order.end(),
              [](const Line::Place& a, const Line::Place& b) { return std::tie(a.at, a.id) < std::tie(b.at, b.id); });
    line.place.resize(line.order.size());
    for (std::size_t k = 0; k < line.order.size(); ++k) line.place[static_cast<std::size_t>(line.order[k].row)] = k;
  }

  void decide(const State& now, State& next, Index i, const Line& line, const StepContext& c, double interval,
              std::uint64_t decision) const {
    const auto kind = now.kind[static_cast<std::size_t>(i)];
    const Array3d heading = heading_at(now, i);
    const Ahead ahead = look(now, i, heading, line, c.p[kRange]);
    const Action action = narrow_ ? on_narrow(now, next, i, ahead, c, interval, decision) : on_wide(now, i, ahead, c);
    const double speed = c.p[kind == outbound ? kOutbound : kind == laden ? kLaden : kUnladen];
    Array3d way = action == Action::walk ? heading : Array3d(Array3d::Zero());
    if (action == Action::turn) {
      way = -heading_of(ahead.aside);
      if ((way == 0).all()) way = -perpendicular(heading, 0, 2);
    }
    next.vel.row(i) = speed * way.transpose();
    next.own.row(i).segment<2>(kHeading) = heading.head<2>().transpose();
  }

  static Ahead look(const State& now, Index i, const Array3d& heading, const Line& line, double range) {
    const bool up = (heading * line.axis).sum() >= 0;
    const std::size_t k = line.place[static_cast<std::size_t>(i)];
    if (up ? k + 1 == line.order.size() : k == 0) return {.first = true};
    const Line::Place& other = line.order[up ? k + 1 : k - 1];
    if (std::abs(other.at - line.order[k].at) > range) return {};
    const Array3d offset = (now.pos.row(other.row) - now.pos.row(i)).transpose();
    return {other.row, false, offset - (offset * line.axis).sum() * line.axis};
  }

  static Action on_narrow(const State& now, State& next, Index i, const Ahead& ahead, const StepContext& c, double interval,
                          std::uint64_t decision) {
    const auto kind = now.kind[static_cast<std::size_t>(i)];
    const int other = ahead.row < 0 ? -1 : now.kind[static_cast<std::size_t>(ahead.row)];
    if (kind == laden) return other == laden ? Action::stop : Action::walk;
    if (kind == unladen) {
      const bool led = other == outbound && next.own(ahead.row, kWaiting) > 0;
      next.own(i, kRole) = led ? 2 : 3;
      return other < 0 || led ? Action::walk : Action::stop;
    }
    double waiting = now.own(i, kWaiting);
    const Action action = other < 0 || (other == unladen && waiting == 0) ? Action::walk : Action::stop;
    if (other == laden) waiting = c.p[kWait] * followers(c.rng.uniform(Stream::noise, decision, now.id[static_cast<std::size_t>(i)]));
    if (!ahead.first) waiting -= interval;
    next.own(i, kWaiting) = waiting > 1e-6 * interval ? waiting : 0;
    return action;
  }

  Action on_wide(const State& now, Index i, const Ahead& ahead, const StepContext& c) const {
    const auto kind = now.kind[static_cast<std::size_t>(i)];
    if (ahead.row < 0 || ahead.aside.square().sum() >= std::pow(c.p[kLength] / 2, 2)) return Action::walk;
    if (kind == laden || (kind == outbound && now.kind[static_cast<std::size_t>(ahead.row)] == unladen)) return Action::walk;
    return turns_ ? Action::turn : Action::stop;
  }

  static double followers(double u) {
    std::size_t n = 0;
    for (double sum = kFollowers[0]; u >= sum && n + 1 < kFollowers.size(); sum += kFollowers[n]) ++n;
    return static_cast<double>(n);
  }

  double frame_;  // frame interval of the recording, or 0
  bool narrow_, turns_;
};

const std::vector<Parameter>& parameter_table() {
  using enum Parameter::Length;
  // Rows longer than a line would be taken apart, one field a line:
  // clang-format off
  static const std::vector<Parameter> table{
      {.row = kOutbound, .name = "outbound", .unit = {1, -1}, .scene = {2.3, 0.01, 100}, .fit = {1.2, 0.3, 4}, .log = true, .fitted = true,
       .meaning = "speed of ants on their way out", .source = "2018, Methods"},
      {.row = kLaden, .name = "laden", .unit = {1, -1}, .scene = {1.9, 0.01, 100}, .fit = {0.8, 0.1, 4}, .log = true, .fitted = true,
       .meaning = "speed of ants that carry a leaf home", .source = "2018, Methods"},
      {.row = kUnladen, .name = "unladen", .unit = {1, -1}, .scene = {2.3, 0.01, 100}, .fit = {1.2, 0.3, 4}, .log = true, .fitted = true,
       .meaning = "speed of ants that come home without", .source = "2018, Methods"},
      {.row = kRange, .name = "range", .unit = {1, 0}, .scene = {1.46, 0.01, 100}, .fit = {0.1, 0.01, 0.3}, .length = spacing, .log = true,
       .fitted = true, .meaning = "gap at which ants take notice", .source = "2018, Methods: an ant and two steps"},
      {.row = kLength, .name = "length", .symbol = "al", .unit = {1, 0}, .scene = {1, 0.01, 100}, .fit = {0.2, 0.02, 2},
       .length = spacing, .log = true, .fitted = true, .when = "bridge=wide|control",
       .meaning = "length of an ant; half of it aside is clear", .source = "2018, Methods"},
      {.row = kWait, .name = "wait", .unit = {0, 1}, .scene = {1, 0, 100}, .fit = {0.1, 0, 5}, .fitted = true, .when = "bridge=narrow",
       .meaning = "wait for each ant that follows a laden one", .source = "2018, program"},
      {.row = kTau, .name = "tau", .unit = {0, 1}, .scene = {0.1, 1e-4, 10}, .fit = {0.02, 0.01, 1}, .log = true,
       .meaning = "time between decisions; at least the recording's frame interval", .source = "2018, program"},
  };
  // clang-format on
  return table;
}

}  // namespace

ModelSpec ant_traffic_spec() {
  return {.name = "ant_traffic",
          .summary = "ants that meet on a bridge and give way by kind and load",
          .citation = "Strömbom and Dussutour 2018, doi:10.1371/journal.pcbi.1006523",
          .dims = {2},
          .native_dt = 0.1,
          .map = "always",
          .quiet = {},
          .options = {{"bridge",
                       {"narrow", "wide", "control"},
                       "ants queue, or turn aside, or stop where they would turn",
                       {"a narrow bridge, where ants queue", "a wide bridge, where ants turn aside",
                        "ants that stop where they would turn aside"}}},
          .columns = {"heading_x", "heading_y", "waiting", "role"},
          .kinds = {"outbound", "laden", "unladen"},
          .parameters = parameter_table(),
          .make = [](const Setup& setup) -> std::unique_ptr<Model> { return std::make_unique<AntTraffic>(setup); }};
}

}  // namespace swarmfit
