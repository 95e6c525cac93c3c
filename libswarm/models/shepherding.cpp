// SPDX-License-Identifier: MIT
//
// shepherding – sheep that huddle and flee, and a shepherd that collects and drives them
// =======================================================================================
// D. Strömbom, R. P. Mann, A. M. Wilson, S. Hailes, A. J. Morton, D. J. T. Sumpter, A. J. King, Solving the shepherding problem: heuristics
// for herding autonomous, interacting agents, J. R. Soc. Interface 11: 20140719, 2014 (doi:10.1098/rsif.2014.0719). Kinds of agents: 0
// sheep, 1 shepherd; in a recording the shepherd is the kind called shepherd or dog. Every tau seconds, all at once:
//
//   a sheep at A, with heading H, farther than r_s from every shepherd grazes: with probability `graze` it steps in a random direction.
//   Nearer than r_s to a shepherd at S, the nearest if there are several,
//     H = unit(inertia H + c C + rho_a R + rho_s unit(A - S) + noise E),  A = A + speed tau H
//     R = unit(sum over sheep nearer than r_a of (A - A_j) / |A - A_j|),  C = unit(mean of its `neighbours` nearest sheep - A)
//   E is a random unit vector; neighbours 0: all others.
//
//   a shepherd knows its `shepherd_neighbours` nearest sheep (0: all), N of them, with centre G; F is the one farthest from G.
//     if |F - G| > r_a N^(2/3)      it collects: it goes to a point r_a behind F, as seen from G
//     else                          it drives: it goes to a point r_a sqrt(N) behind G, as seen from the target
//   at speed_s, or at near_speed r_a / tau when a sheep is nearer than 3 r_a, in a direction that is unit(goal - S) + noise E. It does not
//   overshoot its goal.
//
// The target is where the recorded group is on average, or the middle of the arena, or the origin in open space, moved by target_x and
// target_y. The flock is home when its centre is within 10 of the target: libeval/herding.h measures that.
//
// Nobody sees beyond a step: half the tau is another model, and decisions belong to multiples of tau. In fits a tau below the recording's
// frame interval is that interval. Accounts of the paper differ in the shepherd's speed near sheep (0.3 r_a per step, or it stops: set
// near_speed=0), and in whether the shepherd errs (here it does).
//
// Options (first value: default)
//   grazing   apart: sheep that graze take no notice of each other | spaced: they step away from those nearer than r_a
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "libswarm/centre.h"
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
enum Row : std::size_t {
  kSpeed,
  kNeighbours,
  kRS,
  kRA,
  kRhoA,
  kC,
  kRhoS,
  kInertia,
  kNoise,
  kGraze,
  kSpeedS,
  kNearSpeed,
  kShepherdNeighbours,
  kTargetX,
  kTargetY,
  kTau
};

// Private columns: a heading outlasts standing still, and the velocity the decision it belongs to.
enum : Index { kHeading, kCollects = 2, kColumns };

constexpr double kNear = 3;  // a shepherd slows down for sheep nearer than this times r_a

// Who is what, and where all sheep are on average.
struct Flock : Workspace {
  std::vector<Index> sheep, shepherds;
  Array3d sum = Array3d::Zero();
  std::vector<std::vector<std::tuple<double, std::uint32_t, Index>>> nearest;  // distance², id, row; by thread
};

class Shepherding : public Model {
 public:
  explicit Shepherding(const Setup& setup)
      : frame_(setup.reference ? setup.reference->dt() : 0), centre_(setup), spaced_(setup.options.at("grazing") == "spaced") {
    if (!setup.reference) return;
    const auto& kinds = setup.reference->meta().kinds;
    for (std::size_t k = 0; k < kinds.size(); ++k)
      if (kinds[k] == "shepherd" || kinds[k] == "dog") shepherd_ = static_cast<std::uint8_t>(k);
  }

  Index columns() const override { return kColumns; }

  std::unique_ptr<Workspace> workspace(const World&, const Rng&) const override { return std::make_unique<Flock>(); }

  void enter(State& state, Index first, const World&, const StepContext& c) const override {
    for (Index i = first; i < state.size(); ++i) {
      const Array3d heading = own_heading(state, i, c.rng, 2);
      state.own.row(i).segment<2>(kHeading) = heading.head<2>().transpose();
    }
  }

  Step step(const State& now, State& next, const World& world, const StepContext& c) const override {
    const double interval = std::max(c.p[kTau], frame_);
    const auto decision = decision_due(c, interval);
    auto& flock = static_cast<Flock&>(*c.work);
    if (decision) muster(now, flock);
    for_each_agent(now.size(), [&](Index i, std::size_t thread) {
      next.vel.row(i) = now.vel.row(i);
      if (decision && is_shepherd(now, i)) lead({now, world.bounds, c, flock, *decision, interval, thread}, i, next);
      if (decision && !is_shepherd(now, i)) flee({now, world.bounds, c, flock, *decision, interval, thread}, i, next);
      next.pos.row(i) = now.pos.row(i) + c.dt * next.vel.row(i);
    });
    return Step::done;
  }

 private:
  // What everybody who decides looks at.
  struct View {
    const State& now;
    const Bounds& bounds;
    const StepContext& c;
    Flock& flock;
    std::uint64_t decision;
    double interval;
    std::size_t thread;
    Array3d from_to(Index i, Index j) const { return bounds.separation(now.pos.row(i).transpose(), now.pos.row(j).transpose()); }
    std::uint32_t id(Index i) const { return now.id[static_cast<std::size_t>(i)]; }
    Array3d error(Index i, std::uint32_t draw) const { return random_direction(c.rng, Stream::noise, decision, id(i), draw, 2); }
  };

  bool is_shepherd(const State& now, Index i) const { return now.kind[static_cast<std::size_t>(i)] == shepherd_; }

  void muster(const State& now, Flock& flock) const {
    flock.sheep.clear();
    flock.shepherds.clear();
    flock.nearest.resize(std::max(flock.nearest.size(), agent_threads()));
    flock.sum = Array3d::Zero();
    for (Index i = 0; i < now.size(); ++i) {
      (is_shepherd(now, i) ? flock.shepherds : flock.sheep).push_back(i);
      if (!is_shepherd(now, i)) flock.sum += now.pos.row(i).transpose();
    }
  }

  // Rows of the k sheep nearest to i, which is none of them. Valid until the thread's next call.
  std::span<std::tuple<double, std::uint32_t, Index>> nearest(const View& v, Index i, std::size_t k) const {
    auto& found = v.flock.nearest[v.thread];
    found.clear();
    for (const Index j : v.flock.sheep)
      if (j != i) found.emplace_back(v.from_to(i, j).square().sum(), v.id(j), j);
    k = std::min(k, found.size());
    std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(k), found.end());
    return {found.data(), k};
  }

  // From i to the mean of its n nearest sheep; 0: of all others.
  Array3d to_centre(const View& v, Index i, std::size_t n) const {
    Array3d sum = Array3d::Zero();
    const auto others = static_cast<double>(v.flock.sheep.size()) - (is_shepherd(v.now, i) ? 0 : 1);
    if (others < 1) return sum;
    const bool all = n == 0 || static_cast<double>(n) >= others;
    if (all && v.bounds.kind != Bounds::Kind::periodic) {
      const Array3d here = v.now.pos.row(i).transpose();
      return (v.flock.sum - (is_shepherd(v.now, i) ? Array3d(Array3d::Zero()) : here)) / others - here;
    }
    const auto found = nearest(v, i, all ? v.flock.sheep.size() : n);
    for (const auto& [d2, id, j] : found) sum += v.from_to(i, j);
    return sum / static_cast<double>(found.size());
  }

  Array3d repulsion(const View& v, Index i) const {
    Array3d away = Array3d::Zero();
    const double r2 = v.c.p[kRA] * v.c.p[kRA];
    for (const Index j : v.flock.sheep) {
      if (j == i) continue;
      const Array3d offset = v.from_to(i, j);
      const double d2 = offset.square().sum();
      if (d2 >= r2) continue;
      away -=
          d2 < kCoincident * kCoincident ? -parting_direction(v.c.rng, v.decision, v.id(i), v.id(j), 2) : Array3d(offset / std::sqrt(d2));
    }
    return heading_of(away);
  }

  // Away from the nearest shepherd that it notices; 0: it notices none.
  Array3d threat(const View& v, Index i) const {
    Array3d away = Array3d::Zero();
    double least = v.c.p[kRS] * v.c.p[kRS];
    for (const Index s : v.flock.shepherds) {
      const Array3d offset = v.from_to(s, i);
      if (offset.square().sum() > least) continue;
      least = offset.square().sum();
      away = offset;
    }
    return heading_of(away);
  }

  void flee(const View& v, Index i, State& next) const {
    const auto& p = v.c.p;
    Array3d heading(v.now.own(i, kHeading), v.now.own(i, kHeading + 1), 0);
    double speed = p[kSpeed];
    if (const Array3d away = threat(v, i); (away != 0).any()) {
      const Array3d centre = heading_of(to_centre(v, i, static_cast<std::size_t>(std::lround(p[kNeighbours]))));
      const Array3d goal =
          heading_of(p[kInertia] * heading + p[kC] * centre + p[kRhoA] * repulsion(v, i) + p[kRhoS] * away + p[kNoise] * v.error(i, 0));
      if ((goal != 0).any()) heading = goal;
    } else if (const Array3d apart = spaced_ ? repulsion(v, i) : Array3d(Array3d::Zero()); (apart != 0).any()) {
      heading = apart;
    } else if (v.c.rng.uniform(Stream::noise, v.decision, v.id(i), 1) < p[kGraze]) {
      heading = v.error(i, 2);
    } else {
      speed = 0;
    }
    next.own.row(i).segment<2>(kHeading) = heading.head<2>().transpose();
    next.vel.row(i) = speed * heading.transpose();
  }

  void lead(const View& v, Index s, State& next) const {
    const auto& p = v.c.p;
    next.vel.row(s).setZero();
    const auto wanted = static_cast<std::size_t>(std::lround(p[kShepherdNeighbours]));
    const auto seen = nearest(v, s, wanted == 0 ? v.flock.sheep.size() : wanted);
    if (seen.empty()) return;
    const auto n = static_cast<double>(seen.size());
    Array3d centre = Array3d::Zero();
    for (const auto& [d2, id, j] : seen) centre += v.from_to(s, j) / n;
    Array3d farthest = Array3d::Zero();  // from the centre
    for (const auto& [d2, id, j] : seen)
      if (const Array3d off = v.from_to(s, j) - centre; off.square().sum() > farthest.square().sum()) farthest = off;
    const double spread = std::sqrt(farthest.square().sum());
    const bool collects = spread > p[kRA] * std::cbrt(n * n);
    const Array3d here = v.now.pos.row(s).transpose();
    const Array3d target = centre_.in(v.bounds) + Array3d(p[kTargetX], p[kTargetY], 0);
    const Array3d goal = collects ? Array3d(centre + farthest + p[kRA] * heading_of(farthest))
                                  : Array3d(centre + p[kRA] * std::sqrt(n) * heading_of(v.bounds.separation(target, here + centre)));
    const bool close = std::get<0>(seen.front()) < std::pow(kNear * p[kRA], 2);
    const double most = close ? p[kNearSpeed] * p[kRA] / v.interval : p[kSpeedS];
    const double speed = std::min(most, std::sqrt(goal.square().sum()) / v.interval);
    const Array3d heading = heading_of(heading_of(goal) + p[kNoise] * v.error(s, 0));
    next.vel.row(s) = speed * heading.transpose();
    if ((heading != 0).any()) next.own.row(s).segment<2>(kHeading) = heading.head<2>().transpose();
    next.own(s, kCollects) = collects ? 1 : 0;
  }

  double frame_;  // frame interval of the recording, or 0
  SwarmCentre centre_;
  bool spaced_;
  std::uint8_t shepherd_ = 1;
};

const std::vector<Parameter>& parameter_table() {
  using enum Parameter::Length;
  // Rows longer than a line would be taken apart, one field a line:
  // clang-format off
  static const std::vector<Parameter> table{
      {.row = kSpeed, .name = "speed", .symbol = "δ", .unit = {1, -1}, .scene = {1, 0.001, 100}, .fit = {1.5, 0.3, 6}, .log = true,
       .fitted = true, .meaning = "speed of a sheep that moves", .source = "2014, Table 1"},
      {.row = kNeighbours, .name = "neighbours", .symbol = "n", .unit = {0, 0}, .scene = {0, 0, 1000}, .fit = {0, 0, 100},
       .meaning = "nearest sheep that a sheep is drawn to; 0: all", .source = "2014, Table 1", .integer = true},
      {.row = kRS, .name = "r_s", .symbol = "r_s", .unit = {1, 0}, .scene = {65, 0.01, 1000}, .fit = {3, 0.1, 20}, .log = true,
       .fitted = true, .meaning = "distance at which sheep notice a shepherd", .source = "2014, Table 1"},
      {.row = kRA, .name = "r_a", .symbol = "r_a", .unit = {1, 0}, .scene = {2, 0.01, 100}, .fit = {1, 0.1, 5}, .length = spacing,
       .log = true, .fitted = true, .meaning = "distance at which sheep make room for each other", .source = "2014, Table 1"},
      {.row = kRhoA, .name = "rho_a", .symbol = "ρ_a", .unit = {0, 0}, .scene = {2, 0, 100}, .fit = {2, 0, 10}, .fitted = true,
       .meaning = "weight of making room", .source = "2014, Table 1"},
      {.row = kC, .name = "c", .symbol = "c", .unit = {0, 0}, .scene = {1.05, 0, 100}, .fit = {1.05, 0, 10}, .fitted = true,
       .meaning = "weight of attraction to neighbours", .source = "2014, Table 1"},
      {.row = kRhoS, .name = "rho_s", .symbol = "ρ_s", .unit = {0, 0}, .scene = {1, 0, 100}, .fit = {1, 0, 10}, .fitted = true,
       .meaning = "weight of flight from the shepherd", .source = "2014, Table 1"},
      {.row = kInertia, .name = "inertia", .symbol = "h", .unit = {0, 0}, .scene = {0.5, 0, 100}, .fit = {0.5, 0, 10},
       .meaning = "weight of keeping direction", .source = "2014, Table 1; only ratios of weights matter"},
      {.row = kNoise, .name = "noise", .symbol = "e", .unit = {0, 0}, .scene = {0.3, 0, 10}, .fit = {0.3, 0, 3}, .fitted = true,
       .meaning = "weight of the error", .source = "2014, Table 1"},
      {.row = kGraze, .name = "graze", .symbol = "p", .unit = {0, 0}, .scene = {0.05, 0, 1}, .fit = {0.5, 0, 1}, .fitted = true,
       .meaning = "probability of moving while grazing, per decision", .source = "2014, Table 1"},
      {.row = kSpeedS, .name = "speed_s", .symbol = "δ_s", .unit = {1, -1}, .scene = {1.5, 0.001, 100}, .fit = {2, 0.3, 10}, .log = true,
       .fitted = true, .meaning = "speed of a shepherd", .source = "2014, Table 1"},
      {.row = kNearSpeed, .name = "near_speed", .unit = {0, 0}, .scene = {0.3, 0, 10}, .fit = {0.3, 0, 3},
       .meaning = "step of a shepherd near sheep, in r_a; 0: it stops", .source = "2014, text"},
      {.row = kShepherdNeighbours, .name = "shepherd_neighbours", .symbol = "n_s", .unit = {0, 0}, .scene = {0, 0, 1000},
       .fit = {0, 0, 100}, .meaning = "nearest sheep that a shepherd knows of; 0: all", .source = "2014, local shepherd", .integer = true},
      {.row = kTargetX, .name = "target_x", .unit = {1, 0}, .scene = {0, -1000, 1000}, .fit = {0, -10, 10},
       .meaning = "where the shepherd drives them to, from the middle", .source = "2014, text: the origin"},
      {.row = kTargetY, .name = "target_y", .unit = {1, 0}, .scene = {0, -1000, 1000}, .fit = {0, -10, 10},
       .meaning = "and along the other axis", .source = "2014, text: the origin"},
      {.row = kTau, .name = "tau", .symbol = "ts", .unit = {0, 1}, .scene = {1, 1e-4, 100}, .fit = {0.05, 0.01, 1}, .log = true,
       .fitted = true, .meaning = "time between decisions; at least the recording's frame interval", .source = "2014, the time step"},
  };
  // clang-format on
  return table;
}

}  // namespace

ModelSpec shepherding_spec() {
  return {.name = "shepherding",
          .summary = "sheep that huddle and flee, and a shepherd that collects and drives them",
          .citation = "Strömbom et al. 2014, doi:10.1098/rsif.2014.0719",
          .dims = {2},
          .native_dt = 1,
          .map = "always",
          .quiet = "noise=0,graze=0",
          .options = {{"grazing",
                       {"apart", "spaced"},
                       "sheep that graze take no notice of each other, or keep their distance",
                       {"grazing sheep that take no notice of each other", "grazing sheep that keep their distance"}}},
          .columns = {"heading_x", "heading_y", "collects"},
          .kinds = {"sheep", "shepherd"},
          .parameters = parameter_table(),
          .make = [](const Setup& setup) -> std::unique_ptr<Model> { return std::make_unique<Shepherding>(setup); }};
}

}  // namespace swarmfit
