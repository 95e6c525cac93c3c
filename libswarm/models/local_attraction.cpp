// SPDX-License-Identifier: MIT
//
// local_attraction – groups held together by attraction to the local centre of mass, and nothing else
// ====================================================================================================
// D. Strömbom, Collective motion from local attraction, J. Theor. Biol. 283, 145-151, 2011 (doi:10.1016/j.jtbi.2011.05.019); with repulsion
// and a blind angle D. Strömbom, M. Siljestam, J. Park, D. J. T. Sumpter, The shape and dynamics of local attraction, Eur. Phys. J. Spec.
// Top. 224, 3311-3323, 2015 (doi:10.1140/epjst/e2015-50082-8). The papers' text gives no constants: formulas and defaults are those of the
// author's later published programs.
//
//   Every tau seconds an agent at P with heading D takes the unit vector C to the mean position of those it sees nearer than radius, and
//     D = unit(D + c C + noise E)                                           repulsion=off
//     D = unit(inertia D + c C + c_rep F + noise E)                         repulsion=on
//     F = sum over all nearer than r_rep of (P - P_j) / |P - P_j|³
//     P = P + speed tau D
//   E is a random unit vector. Whoever sees nobody has C = 0. `blind` is the blind angle behind the agent; repulsion works
//   all round. F is not a mean and not a unit vector; distances below 0.001 count as 0.001.
//
// One exact result. Agents that circle a common centre, all seen by all and blind to nobody, turn by phi per decision with c = 2
// sin(phi/2): the radius of the mill is speed tau / c, for 2 speed tau / radius <= c < 2. Nobody agrees on a sense of rotation. With a
// larger c agents swarm about the centre, with a smaller one the mill does not fit into the radius.
//
// With the step length delta = speed tau this is a map: half the tau is another model, and decisions and their random numbers belong to
// multiples of tau however finely a simulation steps. In fits a tau below the recording's frame interval is that interval.
//
// Options (first value: default)
//   update      synchronous: all at once | sequential: one after the other in random order, each seeing where the others are now |
//               gillespie: each by itself after exponential waiting times of mean tau, a step of length speed tau at a time; it stays in
//               place until its next. The phases depend on this: with weak attraction, groups move aligned only if sequential
//   neighbours  metric: those nearer than radius | topological: the `nearest` of those it sees, at any distance
//   repulsion   off: paper of 2011 | on: paper of 2015
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "libswarm/decision_clock.h"
#include "libswarm/headings.h"
#include "libswarm/noise.h"
#include "libswarm/own_heading.h"
#include "libswarm/parallel.h"
#include "libswarm/zones.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Rows of the parameter table, in its order.
enum Row : std::size_t { kSpeed, kC, kRadius, kNearest, kBlind, kNoise, kInertia, kCRep, kRRep, kTau };

enum class Scheme { synchronous, sequential, gillespie };

constexpr double kNearestDistance = 1e-3;  // repulsion does not grow below it [unit]
constexpr double kCentred = 1e-12;         // a mean position nearer than this has no direction [unit]

// One agent's turn: who, and which of its random numbers.
struct Turn {
  Index row;
  std::uint64_t tick;
  std::uint32_t draw;
};

struct Seen {
  double distance2;
  std::uint32_t id;
  Array3d offset;
};

struct Buffers : Workspace {
  struct Act {
    double t;
    std::uint32_t id;
    Turn turn;
  };
  std::vector<Act> acts;                // of gillespie
  std::vector<std::vector<Seen>> seen;  // of topological neighbours, by thread
};

class LocalAttraction : public Model {
 public:
  explicit LocalAttraction(const Setup& setup)
      : dims_(setup.dims),
        frame_(setup.reference ? setup.reference->dt() : 0),
        scheme_(setup.options.at("update") == "synchronous"  ? Scheme::synchronous
                : setup.options.at("update") == "sequential" ? Scheme::sequential
                                                             : Scheme::gillespie),
        topological_(setup.options.at("neighbours") == "topological"),
        repels_(setup.options.at("repulsion") == "on") {}

  std::unique_ptr<Workspace> workspace(const World&, const Rng&) const override { return std::make_unique<Buffers>(); }

  Step step(const State& now, State& next, const World& world, const StepContext& c) const override {
    auto& buffers = static_cast<Buffers&>(*c.work);
    buffers.seen.resize(std::max(buffers.seen.size(), agent_threads()));
    if (scheme_ == Scheme::gillespie) {
      act(now, next, world, c, buffers);
      return Step::done;
    }
    const auto decision = decision_due(c, std::max(c.p[kTau], frame_));
    const bool sequential = scheme_ == Scheme::sequential;
    const double reach = reach_of(c) + (sequential ? 2 * c.p[kSpeed] * c.dt : 0);
    if (decision) c.near.build(now.pos, world.bounds, reach);
    const auto move = [&](Index i, std::size_t thread) {
      Array3d heading = own_heading(now, i, c.rng, dims_);
      if (decision) heading = decide(sequential ? next : now, {i, *decision, 0}, reach, world.bounds, c, buffers.seen[thread]);
      next.vel.row(i) = c.p[kSpeed] * heading.transpose();
      next.pos.row(i) = now.pos.row(i) + c.dt * next.vel.row(i);
    };
    if (sequential)
      for (const Index i : c.order) move(i, 0);
    else
      for_each_agent(now.size(), move);
    return Step::done;
  }

 private:
  double reach_of(const StepContext& c) const {
    const double seen = topological_ ? 0 : c.p[kRadius];
    return repels_ ? std::max(seen, c.p[kRRep]) : seen;
  }

  // Everybody acts as often as waiting times allow within the step, in the order of these moments; each sees the others where they are.
  void act(const State& now, State& next, const World& world, const StepContext& c, Buffers& buffers) const {
    buffers.acts.clear();
    std::uint32_t most = 0;
    for (Index i = 0; i < now.size(); ++i) {
      next.vel.row(i) = c.p[kSpeed] * own_heading(now, i, c.rng, dims_).transpose();
      const std::uint32_t id = now.id[static_cast<std::size_t>(i)];
      double t = 0;
      for (std::uint32_t k = 0;; ++k) {
        t -= c.p[kTau] * std::log(1 - c.rng.uniform(Stream::order, c.tick, id, k + 1));  // waiting has no memory: it may begin anew here
        if (t >= c.dt) break;
        buffers.acts.push_back({t, id, {i, c.tick, k}});
        most = std::max(most, k + 1);
      }
    }
    std::sort(buffers.acts.begin(), buffers.acts.end(),
              [](const Buffers::Act& a, const Buffers::Act& b) { return std::tie(a.t, a.id) < std::tie(b.t, b.id); });
    const double length = c.p[kSpeed] * c.p[kTau], reach = reach_of(c) + 2 * most * length;
    c.near.build(now.pos, world.bounds, reach);
    for (const auto& [t, id, turn] : buffers.acts) {
      const Array3d heading = decide(next, turn, reach, world.bounds, c, buffers.seen[0]);
      next.vel.row(turn.row) = c.p[kSpeed] * heading.transpose();
      next.pos.row(turn.row) += length * heading.transpose();
    }
  }

  // The new heading of one agent among the others of `state`; c.near was built with `reach`, from where they were at the start of the step.
  Array3d decide(const State& state, const Turn& turn, double reach, const Bounds& bounds, const StepContext& c,
                 std::vector<Seen>& seen) const {
    const Index i = turn.row;
    const std::uint32_t id = state.id[static_cast<std::size_t>(i)];
    const Array3d heading = own_heading(state, i, c.rng, dims_), here = state.pos.row(i).transpose();
    // Least cosine of the angle to the heading; without a blind angle rounding hides nobody who is straight behind.
    const double seen_from = c.p[kBlind] > 0 ? -std::cos(c.p[kBlind] / 2) : -2;
    const double radius2 = topological_ ? INFINITY : c.p[kRadius] * c.p[kRadius], rep2 = repels_ ? c.p[kRRep] * c.p[kRRep] : 0;
    Array3d sum = Array3d::Zero(), push = Array3d::Zero();
    double count = 0;
    seen.clear();
    const auto meet = [&](Index j) {
      if (j == i) return;
      const Array3d offset = bounds.separation(here, state.pos.row(j).transpose());
      const double d2 = offset.square().sum();
      if (d2 < rep2) push += repulsion(offset, std::sqrt(d2), turn, id, state.id[static_cast<std::size_t>(j)], c);
      if (!(d2 < radius2) || (offset * heading).sum() < seen_from * std::sqrt(d2)) return;
      if (topological_) return seen.push_back({d2, state.id[static_cast<std::size_t>(j)], offset});
      sum += offset;
      count += 1;
    };
    if (topological_) {
      for (Index j = 0; j < state.size(); ++j) meet(j);
      std::tie(sum, count) = nearest_of(seen, static_cast<std::size_t>(std::lround(c.p[kNearest])));
    } else {
      c.near.for_each_run(i, reach, [&](Index first, Index end) {
        for (Index slot = first; slot < end; ++slot) meet(c.near.row(slot));
      });
    }
    const bool centred = sum.square().sum() <= std::pow(kCentred * count, 2);
    Array3d wish = (repels_ ? c.p[kInertia] : 1.0) * heading;
    if (!centred) wish += c.p[kC] * heading_of(sum);
    if (repels_) wish += c.p[kCRep] * push;
    if (c.p[kNoise] > 0) wish += c.p[kNoise] * random_direction(c.rng, Stream::noise, turn.tick, id, turn.draw, dims_);
    const Array3d direction = heading_of(wish);
    return (direction == 0).all() ? heading : direction;
  }

  // Sum of the offsets of the k nearest, in that order, and their number.
  static std::pair<Array3d, double> nearest_of(std::vector<Seen>& seen, std::size_t k) {
    k = std::min(k, seen.size());
    std::partial_sort(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(k), seen.end(),
                      [](const Seen& a, const Seen& b) { return std::tie(a.distance2, a.id) < std::tie(b.distance2, b.id); });
    Array3d sum = Array3d::Zero();
    for (std::size_t n = 0; n < k; ++n) sum += seen[n].offset;
    return {sum, static_cast<double>(k)};
  }

  Array3d repulsion(const Array3d& offset, double d, const Turn& turn, std::uint32_t id, std::uint32_t other, const StepContext& c) const {
    const double counted = std::max(d, kNearestDistance);
    const Array3d away = d < kCoincident ? parting_direction(c.rng, turn.tick, id, other, dims_) : Array3d(-offset / d);
    return away / (counted * counted);
  }

  int dims_;
  double frame_;  // frame interval of the recording, or 0
  Scheme scheme_;
  bool topological_, repels_;
};

const std::vector<Parameter>& parameter_table() {
  using enum Parameter::Length;
  constexpr double circle = 2 * std::numbers::pi;
  // Rows longer than a line would be taken apart, one field a line:
  // clang-format off
  static const std::vector<Parameter> table{
      {.row = kSpeed, .name = "speed", .symbol = "δ/τ", .unit = {1, -1}, .scene = {0.5, 0.001, 100}, .fit = {1, 0.1, 4}, .log = true,
       .fitted = true, .meaning = "constant speed", .source = "author's programs", .shown = Parameter::Shown::speed},
      {.row = kC, .name = "c", .symbol = "c", .unit = {0, 0}, .scene = {1, 0.001, 10}, .fit = {0.3, 0.01, 3}, .log = true,
       .fitted = true, .meaning = "attraction, relative to keeping direction", .source = "2011, scanned from 0 to 2"},
      {.row = kRadius, .name = "radius", .symbol = "R", .unit = {1, 0}, .scene = {4, 0.01, 100}, .fit = {3, 0.3, 20}, .length = spacing,
       .log = true, .fitted = true, .when = "neighbours=metric", .meaning = "radius of attraction", .source = "author's programs"},
      {.row = kNearest, .name = "nearest", .symbol = "n", .unit = {0, 0}, .scene = {7, 1, 1000}, .fit = {7, 1, 30}, .fitted = true,
       .when = "neighbours=topological", .meaning = "number of neighbours", .source = "thesis, section 1.2.1", .integer = true},
      {.row = kBlind, .name = "blind", .symbol = "β", .unit = {0, 0}, .scene = {0, 0, circle}, .fit = {1.5, 0, circle}, .fitted = true,
       .meaning = "blind angle behind the agent [rad]", .source = "2015"},
      {.row = kNoise, .name = "noise", .symbol = "e", .unit = {0, 0}, .scene = {0, 0, 10}, .fit = {0.2, 0, 2}, .fitted = true,
       .meaning = "length of the error, relative to keeping direction", .source = "2011; 2015: 0.2"},
      {.row = kInertia, .name = "inertia", .symbol = "d", .unit = {0, 0}, .scene = {1, 0, 10}, .fit = {1, 0, 10}, .when = "repulsion=on",
       .meaning = "weight of keeping direction", .source = "author's programs; only ratios of weights matter"},
      {.row = kCRep, .name = "c_rep", .symbol = "r", .unit = {2, 0}, .scene = {1, 0.001, 100}, .fit = {0.3, 0.01, 10}, .length = spacing,
       .log = true, .fitted = true, .when = "repulsion=on", .meaning = "repulsion", .source = "author's programs"},
      {.row = kRRep, .name = "r_rep", .symbol = "R_r", .unit = {1, 0}, .scene = {6, 0.01, 100}, .fit = {2, 0.1, 10}, .length = spacing,
       .log = true, .fitted = true, .when = "repulsion=on", .meaning = "radius of repulsion", .source = "author's programs"},
      {.row = kTau, .name = "tau", .symbol = "τ", .unit = {0, 1}, .scene = {1, 1e-4, 100}, .fit = {0.05, 0.01, 1}, .log = true,
       .fitted = true, .meaning = "time between decisions", .source = "the papers' time step"},
  };
  // clang-format on
  return table;
}

}  // namespace

ModelSpec local_attraction_spec() {
  return {.name = "local_attraction",
          .summary = "attraction to the local centre of mass alone, with a blind angle and optional repulsion",
          .citation = "Strömbom 2011, doi:10.1016/j.jtbi.2011.05.019; Strömbom et al. 2015, doi:10.1140/epjst/e2015-50082-8",
          .dims = {2, 3},
          .update = Update::sequential,  // of the options; the synchronous one does not look
          .native_dt = 1,
          .map = "always",
          .quiet = "noise=0",
          .options = {{"update",
                       {"synchronous", "sequential", "gillespie"},
                       "all at once, one after the other, or at random moments",
                       {"agents that move all at once", "agents that move one after the other", "agents that move at random moments"}},
                      {"neighbours",
                       {"metric", "topological"},
                       "those within a radius, or a number of them",
                       {"attraction to those within a radius", "attraction to a number of neighbours"}},
                      {"repulsion",
                       {"off", "on"},
                       "attraction alone, or repulsion at short range too",
                       {"attraction alone", "repulsion at short range"}}},
          .columns = {},
          .parameters = parameter_table(),
          .make = [](const Setup& setup) -> std::unique_ptr<Model> { return std::make_unique<LocalAttraction>(setup); }};
}

}  // namespace swarmfit
