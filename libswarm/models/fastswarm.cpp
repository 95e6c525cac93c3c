// SPDX-License-Identifier: MIT
//
// fastswarm – every step each agent takes the recorded velocity of lowest energy
// ==============================================================================
// W. Xiang, X. Yao, H. Wang, X. Jin, FASTSWARM: A data-driven framework for real-time flying insect swarm simulation, Comput. Anim. Virtual
// Worlds 31: e1957, 2020 (doi:10.1002/cav.1957).
//
// It needs a recording: `samples` of its velocities v, each with the acceleration a that followed it (the change of velocity from that
// frame to the next), one from each of as many strata of equal size, by speed. A step is a frame of the recording. Eq 1, with unit vectors
// v^ = v / |v| (0 for 0), the prediction p'_i = p_i + v dt of oneself, and p'_j = p_j + v_j dt of others:
//
//   v_i = argmin over the samples of E,   p_i = p_i + v_i dt
//   E = w_rep mean over |p_i - p_j| < d_rep of exp(rho (1 - |p'_i - p'_j| / d_rep))                            repulsion, Eq 4
//     + w_oa  mean over d_att1 <= |p_i - p_j| <= d_att2 of exp(rho (|p'_i - p_j| / d_att1 - 1))                attraction, Eq 6
//     + w_cos exp(rho |v^ - centre^|)      to the centre of the swarm, Eq 7
//     + w_dir exp(rho |v^ - v^_i|)         as before, Eq 9
//     + w_acc (exp(rho |a'^ - a^|) + ||a'| - |a|| / a_ref),   a' = v - v_i,   Eq 10
//     + w_env exp(rho psi)                 psi = |v^ - stimulus^| if it attracts, 1 - |p'_i - p_stimulus| / d_danger if it is a danger
//                                          within d_danger, where nobody is attracted by others or by the centre; Eq 11 and 12
//     + w_n   exp(rho |v^ - noise^|)       curl noise at p_i, fixed in space, Eq 13
//     + w_user exp(rho |v^ - goal^|)       to where a guide says, Eq 14
//
// A mean over nobody is 0, of equal energies the slowest sample wins. Radii are stored as widths: d_att1 = d_rep + inner, d_att2 = d_att1 +
// outer. Only the ratios of weights matter, so fits keep w_dir = 1. Samples are in ten groups of equal size by speed; an agent looks at the
// group of its own speed and `window` groups to either side (groups=all: at all samples).
//
// The paper's |a'| - |a| is in length units, against exponentials that are pure numbers; here it is divided by a_ref, the root mean square
// of |a| (magnitude=literal: not). The paper's grid takes cubes for spheres (neighbours=cubes). Its 300 samples have 300 directions:
// yaw=random turns each about the vertical, for groups that fly alike in all of them. It does not say how the 300 were chosen, nor its
// radii, nor the size of its noise.
//
// A simulation of recorded velocities has the recording's speeds whatever it does: judge it on what it did not learn from (--holdout yes).
#include <algorithm>
#include <cmath>
#include <string>

#include "libswarm/centre.h"
#include "libswarm/exponential.h"
#include "libswarm/guide.h"
#include "libswarm/headings.h"
#include "libswarm/model.h"
#include "libswarm/noise.h"
#include "libswarm/parallel.h"
#include "libswarm/reference_set.h"
#include "libswarm/stimuli.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Rows of the parameter table, in its order.
enum Row : std::size_t { kWRep, kWOa, kWCos, kWDir, kWAcc, kWEnv, kWN, kWUser, kRho, kDRep, kInner, kOuter, kDDanger, kScale, kWindow };

constexpr double kMost = 300;  // of exponents: beyond it all energies are hopeless alike, and sums must stay finite

// A direction and how much it is wished for.
struct Wish {
  double weight;
  Array3d direction;
};

// What an agent weighs apart from its neighbours.
struct Wishes {
  double rho;
  Wish wish[5];
  std::size_t count = 0;
  void add(double weight, const Array3d& direction) {
    if (weight > 0) wish[count++] = {weight, direction};
  }
  double w_acc, per_change, scale;  // of Eq 10; 1 / a_ref; dt / that of the recording
  Array3d velocity;
};

inline __attribute__((always_inline)) void clamped_exponential(const Lanes& x, Lanes& out) {
  const Lanes above = x > -kMost ? x : Lanes{} - kMost;
  exponential(above < kMost ? above : Lanes{} + kMost, out);
}

inline __attribute__((always_inline)) void root(Lanes& x) {
  for (int l = 0; l < 4; ++l) x[l] = std::sqrt(x[l]);
}

// All of Eq 2 that does not depend on places, for the samples from `first` on, by fours.
SWARMFIT_HOT void weigh_directions(const ReferenceSet& set, std::size_t first, std::size_t end, const Wishes& w, double* out) {
  for (std::size_t k = first; k < end; k += 4) {
    Lanes energy{}, e;
    Lanes v[3];
    for (std::size_t axis = 0; axis < 3; ++axis) load(&set.heading()[axis][k], v[axis]);
    for (std::size_t n = 0; n < w.count; ++n) {
      Lanes d2{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Lanes d = v[axis] - w.wish[n].direction[static_cast<Index>(axis)];
        d2 += d * d;
      }
      root(d2);
      clamped_exponential(w.rho * d2, e);
      energy += w.wish[n].weight * e;
    }
    if (w.w_acc > 0) {
      Lanes change[3], size{}, d2{}, recorded;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        load(&set.velocity()[axis][k], change[axis]);
        change[axis] -= w.velocity[static_cast<Index>(axis)];
        size += change[axis] * change[axis];
      }
      root(size);
      const Lanes per = size > 0 ? 1 / size : Lanes{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Lanes turn;
        load(&set.turn()[axis][k], turn);
        const Lanes d = change[axis] * per - turn;
        d2 += d * d;
      }
      root(d2);
      clamped_exponential(w.rho * d2, e);
      load(&set.change()[k], recorded);
      Lanes difference = size - w.scale * recorded;
      difference = difference < 0 ? -difference : difference;
      energy += w.w_acc * (e + w.per_change * difference);
    }
    std::memcpy(out + (k - first), &energy, sizeof energy);
  }
}

// Places of neighbours relative to the agent, by fours, the last ones with weight 0.
struct Crowd {
  std::array<std::vector<double>, 4> column;  // x, y, z, weight
  std::size_t count = 0;
  void clear() {
    for (auto& c : column) c.clear();
    count = 0;
  }
  void add(const Array3d& place) {
    for (std::size_t axis = 0; axis < 3; ++axis) column[axis].push_back(place[static_cast<Index>(axis)]);
    column[3].push_back(1);
    ++count;
  }
  void close() {
    while (column[3].size() % 4 != 0)
      for (auto& c : column) c.push_back(0);
  }
};

// Sum of exp(offset + slope |place - here|) over a crowd.
SWARMFIT_HOT double pressure(const Crowd& crowd, const Array3d& here, double offset, double slope) {
  Lanes sum{};
  for (std::size_t j = 0; j < crowd.column[3].size(); j += 4) {
    Lanes d2{}, weight, e;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Lanes d;
      load(&crowd.column[axis][j], d);
      d -= here[static_cast<Index>(axis)];
      d2 += d * d;
    }
    root(d2);
    clamped_exponential(offset + slope * d2, e);
    load(&crowd.column[3][j], weight);
    sum += weight * e;
  }
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

// What a thread needs for one agent.
struct Scratch {
  std::vector<double> energy;
  std::vector<std::pair<double, std::size_t>> by_energy;
  Crowd near, far;
};

struct Buffers : Workspace {
  explicit Buffers(const Rng& rng) : field(rng), scratch(1) {}
  NoiseField field;
  std::vector<Scratch> scratch;
};

// A stimulus as an agent meets it.
struct Alarm {
  bool attracted = false, startled = false;
  Array3d place = Array3d::Zero();  // of the stimulus, relative to the agent
};

class Fastswarm : public Model {
 public:
  explicit Fastswarm(const Setup& setup)
      : dims_(setup.dims),
        all_(setup.options.at("groups") == "all"),
        literal_(setup.options.at("magnitude") == "literal"),
        cubes_(setup.options.at("neighbours") == "cubes"),
        fixed_centre_(setup.options.at("centre") == "recorded"),
        set_(*setup.reference, {std::stoul(setup.options.at("samples")), 10, setup.options.at("yaw") == "random"}, setup.rng),
        centre_(setup) {}

  std::unique_ptr<Workspace> workspace(const World&, const Rng& rng) const override { return std::make_unique<Buffers>(rng); }

  Step step(const State& now, State& next, const World& world, const StepContext& c) const override {
    Buffers& buffers = *static_cast<Buffers*>(c.work);
    if (buffers.scratch.size() < agent_threads()) buffers.scratch.resize(agent_threads());
    // Neighbours are those strictly nearer than the radius given, the outer shell holds its edge.
    c.near.build(now.pos, world.bounds, (c.p[kDRep] + c.p[kInner] + c.p[kOuter]) * (cubes_ ? std::sqrt(3.0) : 1) * (1 + 1e-12));
    const Array3d centre = fixed_centre_ ? centre_.in(world.bounds) : mean_place(now);
    for_each_agent(now.size(), [&](Index i, std::size_t thread) {
      Scratch& s = buffers.scratch[thread];
      const Array3d v = choose(now, i, world, c, centre, buffers.field, s);
      next.vel.row(i) = v.transpose();
      next.pos.row(i) = now.pos.row(i) + c.dt * v.transpose();
    });
    return Step::done;
  }

 private:
  static Array3d mean_place(const State& now) {
    Array3d sum = Array3d::Zero();
    for (Index i = 0; i < now.size(); ++i) sum += now.pos.row(i).transpose();
    return now.size() > 0 ? Array3d(sum / static_cast<double>(now.size())) : sum;
  }

  Array3d choose(const State& now, Index i, const World& world, const StepContext& c, const Array3d& centre, const NoiseField& field,
                 Scratch& s) const {
    const Alarm alarm = alarm_of(now, i, world, c);
    const Wishes wishes = wishes_of(now, i, world, c, centre, field, alarm);
    gather(now, i, c, alarm.startled ? 0 : c.p[kWOa], s);
    const double speed = std::sqrt(wishes.velocity.square().sum());
    const auto span = all_ ? set_.all() : set_.like(speed, static_cast<std::size_t>(c.p[kWindow]));
    s.energy.resize(span.end - span.first + 4);
    weigh_directions(set_, span.first, span.end, wishes, s.energy.data());
    const std::size_t k = lowest(span, c, alarm, s);
    return {set_.velocity()[0][k], set_.velocity()[1][k], set_.velocity()[2][k]};
  }

  // All terms are at least 0, so neighbours are only asked about samples whose directions alone do not cost more than the best so far.
  std::size_t lowest(ReferenceSet::Span span, const StepContext& c, const Alarm& alarm, Scratch& s) const {
    s.by_energy.clear();
    for (std::size_t k = span.first; k < span.end; ++k) s.by_energy.emplace_back(s.energy[k - span.first], k);
    const auto later = std::greater<>();
    std::make_heap(s.by_energy.begin(), s.by_energy.end(), later);
    std::pair<double, std::size_t> best{INFINITY, s.by_energy.front().second};
    for (auto end = s.by_energy.end(); end != s.by_energy.begin() && s.by_energy.front().first <= best.first; --end) {
      std::pop_heap(s.by_energy.begin(), end, later);
      const auto [energy, k] = *(end - 1);
      best = std::min(best, {energy + of_places(k, c, alarm, s), k});
    }
    return best.second;
  }

  double of_places(std::size_t k, const StepContext& c, const Alarm& alarm, const Scratch& s) const {
    const Array3d ahead = c.dt * Array3d(set_.velocity()[0][k], set_.velocity()[1][k], set_.velocity()[2][k]);
    const double rho = c.p[kRho];
    double energy = 0;
    if (s.near.count > 0) energy += c.p[kWRep] / static_cast<double>(s.near.count) * pressure(s.near, ahead, rho, -rho / c.p[kDRep]);
    if (s.far.count > 0)
      energy += c.p[kWOa] / static_cast<double>(s.far.count) * pressure(s.far, ahead, -rho, rho / (c.p[kDRep] + c.p[kInner]));
    if (alarm.startled) {
      const double distance = std::sqrt((ahead - alarm.place).square().sum());
      energy += c.p[kWEnv] * std::exp(std::clamp(rho * (1 - distance / c.p[kDDanger]), -kMost, kMost));
    }
    return energy;
  }

  // RN, where they will be, and AN, where they are.
  void gather(const State& now, Index i, const StepContext& c, double w_oa, Scratch& s) const {
    s.near.clear();
    s.far.clear();
    const double d_rep = c.p[kDRep], d_att1 = d_rep + c.p[kInner], d_att2 = d_att1 + c.p[kOuter];
    c.near.visit(i, [&](Index j, const Array3d& offset, double distance) {
      const double d = cubes_ ? offset.abs().maxCoeff() : distance;
      if (d < d_rep && c.p[kWRep] > 0) s.near.add(offset + c.dt * now.vel.row(j).transpose());
      if (d >= d_att1 && d <= d_att2 && w_oa > 0) s.far.add(offset);
    });
    s.near.close();
    s.far.close();
  }

  Wishes wishes_of(const State& now, Index i, const World& world, const StepContext& c, const Array3d& centre, const NoiseField& field,
                   const Alarm& alarm) const {
    const Array3d here = now.pos.row(i).transpose();
    Wishes w;
    w.rho = c.p[kRho];
    w.velocity = now.vel.row(i).transpose();
    w.w_acc = c.p[kWAcc];
    w.per_change = literal_ ? 1 : set_.rms_change() > 0 ? 1 / set_.rms_change() : 0;
    w.scale = c.dt / set_.dt();
    w.add(c.p[kWDir], heading_of(w.velocity));
    if (!alarm.startled) w.add(c.p[kWCos], heading_of(world.bounds.separation(here, centre)));
    if (c.p[kWN] > 0) w.add(c.p[kWN], heading_of(dims_ == 2 ? field.curl2(here / c.p[kScale]) : field.curl(here / c.p[kScale])));
    if (alarm.attracted) w.add(c.p[kWEnv], heading_of(alarm.place));
    if (const auto* guide = c.p[kWUser] > 0 ? world.part<Guide>() : nullptr)
      if (const auto goal = guide->goal(now.id[static_cast<std::size_t>(i)]))
        w.add(c.p[kWUser], heading_of(world.bounds.separation(here, *goal)));
    return w;
  }

  static Alarm alarm_of(const State& now, Index i, const World& world, const StepContext& c) {
    const auto* stimuli = c.p[kWEnv] > 0 ? world.part<Stimuli>() : nullptr;
    if (!stimuli) return {};
    const Array3d here = now.pos.row(i).transpose();
    auto near = stimuli->nearest(here, world.bounds, c.p[kDDanger]);
    const bool startled = near.index >= 0 && near.kind == Stimulus::Kind::repel;
    if (!startled) near = stimuli->nearest(here, world.bounds, INFINITY);
    if (near.index < 0) return {};
    return {near.kind == Stimulus::Kind::attract, startled, -near.distance * near.from};
  }

  int dims_;
  bool all_, literal_, cubes_, fixed_centre_;
  ReferenceSet set_;
  SwarmCentre centre_;
};

std::vector<Option> option_table() {
  return {{"samples",
           {"300", "1000"},
           "how many velocities are taken from the recording, k",
           {"300 recorded velocities", "1000 recorded velocities"}},
          {"groups",
           {"ten", "all"},
           "where an agent searches: samples about as fast as it is, or all",
           {"a search among velocities of similar speed", "a search among all recorded velocities"}},
          {"yaw",
           {"recorded", "random"},
           "directions of the samples: as recorded, or each turned about the vertical",
           {"recorded directions", "recorded velocities turned about the vertical at random"}},
          {"magnitude",
           {"scaled", "literal"},
           "the difference of accelerations in multiples of their size, or in the unit of length",
           {"accelerations relative to their size", "accelerations as printed in the paper"}},
          {"neighbours",
           {"spheres", "cubes"},
           "shape of the regions of repulsion and attraction",
           {"spheres of repulsion and attraction", "cubes of repulsion and attraction"}},
          {"centre",
           {"moving", "recorded"},
           "of the swarm as it is, or where the recording was",
           {"attraction to the centre as it is", "attraction to where the recorded centre was"}}};
}

const std::vector<Parameter>& parameter_table() {
  using enum Parameter::Length;
  constexpr const char *table1 = "Table 1, aggregation", *ours = "our choice: the paper has none";
  // Rows longer than a line would be taken apart, one field a line:
  // clang-format off
  static const std::vector<Parameter> table{
      {.row = kWRep, .name = "w_rep", .symbol = "w_rep", .scene = {1, 0, 100}, .fit = {1, 0.01, 100}, .log = true, .fitted = true,
       .meaning = "weight of repulsion", .source = table1},
      {.row = kWOa, .name = "w_oa", .symbol = "w_oa", .scene = {1, 0, 100}, .fit = {1, 0.01, 100}, .log = true, .fitted = true,
       .meaning = "weight of attraction to others", .source = table1},
      {.row = kWCos, .name = "w_cos", .symbol = "w_cos", .scene = {0.05, 0, 100}, .fit = {0.05, 0.001, 10}, .log = true, .fitted = true,
       .meaning = "weight of attraction to the centre", .source = table1},
      {.row = kWDir, .name = "w_dir", .symbol = "w_dir", .scene = {1, 0, 100}, .fit = {1, 0, 100},
       .meaning = "weight of keeping the direction; only ratios of weights matter", .source = table1},
      {.row = kWAcc, .name = "w_acc", .symbol = "w_acc", .scene = {1, 0, 100}, .fit = {1, 0.01, 100}, .log = true, .fitted = true,
       .meaning = "weight of accelerating as recorded", .source = table1},
      {.row = kWEnv, .name = "w_env", .symbol = "w_env", .scene = {0, 0, 10}, .fit = {0, 0, 10}, .needs = "stimuli",
       .meaning = "weight of stimuli", .source = "Table 1: mating 1, escaping 2"},
      {.row = kWN, .name = "w_n", .symbol = "w_n", .scene = {0.2, 0, 100}, .fit = {0.2, 0.005, 10}, .log = true, .fitted = true,
       .meaning = "weight of noise", .source = table1},
      {.row = kWUser, .name = "w_user", .symbol = "w_user", .scene = {0, 0, 10}, .fit = {0, 0, 10}, .needs = "curves",
       .meaning = "weight of the user's curve, or of the end of a gap", .source = "Table 1: shapes 1"},
      {.row = kRho, .name = "rho", .symbol = "ρ", .scene = {2.5, 0.1, 10}, .fit = {2.5, 0.1, 10},
       .meaning = "exponent of all energies", .source = "section 5"},
      {.row = kDRep, .name = "d_rep", .symbol = "d_rep", .unit = {1, 0}, .scene = {0.5, 0.01, 100}, .fit = {0.5, 0.05, 3}, .length = spacing,
       .log = true, .fitted = true, .meaning = "radius of repulsion", .source = ours},
      {.row = kInner, .name = "inner", .symbol = "d_att1 - d_rep", .unit = {1, 0}, .scene = {1, 0, 100}, .fit = {1, 0, 5}, .length = spacing,
       .fitted = true, .meaning = "width of the shell between repulsion and attraction", .source = ours},
      {.row = kOuter, .name = "outer", .symbol = "d_att2 - d_att1", .unit = {1, 0}, .scene = {2.5, 0, 100}, .fit = {2.5, 0, 10},
       .length = spacing, .fitted = true, .meaning = "width of the shell of attraction", .source = ours},
      {.row = kDDanger, .name = "d_danger", .symbol = "d_danger", .unit = {1, 0}, .scene = {5, 0.1, 100}, .fit = {5, 0.1, 20},
       .length = spacing, .meaning = "where a danger is noticed", .source = ours},
      {.row = kScale, .name = "scale", .symbol = "s", .unit = {1, 0}, .scene = {2, 0.01, 100}, .fit = {0.5, 0.05, 3}, .log = true,
       .fitted = true, .meaning = "feature size of the noise; where it is larger than the swarm, all are pushed the same way", .source = ours},
      {.row = kWindow, .name = "window", .scene = {1, 0, 10}, .fit = {1, 0, 10}, .when = "groups=ten",
       .meaning = "groups of speed searched to either side of the agent's own", .source = "section 5.2.1", .integer = true},
  };
  // clang-format on
  return table;
}

}  // namespace

ModelSpec fastswarm_spec() {
  return {.name = "fastswarm",
          .summary = "every step each agent takes the recorded velocity of lowest energy",
          .citation = "Xiang et al. 2020, doi:10.1002/cav.1957",
          .dims = {2, 3},
          .needs_reference = true,
          .fixed_step = true,
          .native_dt = 0.01,
          .quiet = "w_n=0,yaw=recorded,neighbours=spheres",  // cubes do not turn with the swarm
          .options = option_table(),
          .columns = {},
          .parameters = parameter_table(),
          .make = [](const Setup& setup) -> std::unique_ptr<Model> { return std::make_unique<Fastswarm>(setup); }};
}

}  // namespace swarmfit
