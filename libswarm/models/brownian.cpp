// SPDX-License-Identifier: MIT
//
// brownian – active Brownian particles
// ====================================
// F. Schweitzer, W. Ebeling, B. Tilch, Complex motion of Brownian particles with energy depots, Phys. Rev. Lett. 80: 5044, 1998
// (doi:10.1103/PhysRevLett.80.5044), with the repulsion of M. R. D'Orsogna et al., Phys. Rev. Lett. 96: 104302, 2006
// (doi:10.1103/PhysRevLett.96.104302); a baseline of Ren et al. 2016 (doi:10.1371/journal.pone.0155698), whose Tables S17–S20 print fitted
// r1, r2, D and Cr. That r1 and r2 are gamma1 and gamma2, and the form below, is our reading.
//
//   dr/dt = v
//   dv/dt = f(v) v - k (r - r_c) + F + sqrt(2 D) xi          xi: Gaussian white noise of unit strength, independent per component
//   F     = sum over j of (C_r / l_r e^(-d / l_r) - C_a / l_a e^(-d / l_a)) (r_i - r_j) / d,   d = |r_i - r_j|
//   f(v)  = gamma1 - gamma2 |v|²                             friction=rayleigh
//   f(v)  = d2 e - g0,   de/dt = q0 - c e - d2 |v|² e        friction=depot: each agent has a store of energy e, filled at the rate q0
//
// r_c is the recording's mean position; in scenes the middle of the arena, in the open the origin.
// Half a step of drift, forces at the places reached there, half a step of drift; friction by the midpoint rule, halved while
// gamma2 |v|² dt > 0.2 for anybody; e follows its exact solution for constant |v|. Where the noise takes an agent within a step is drawn,
// too: given both velocities, the path of a Brownian velocity has an area of variance 2 D dt³ / 12 beside the trapezoid's. So the
// statistics of positions are those of the continuous process at any step that resolves friction and forces: second differences have two
// thirds of the variance that kicks once per step would give them, and neighbouring ones a correlation of 1/4. Agents enter with e = q0 /
// (c + d2 |v|²), at which it stays while the speed does. Agents at the same place part in a drawn direction. Forces beyond 30 times the
// longest range, a factor 1e-13, are left out.
//
// A free particle with Rayleigh friction has the stationary speeds P(v) ~ v^(dims-1) exp(-(gamma2 v^4 / 4 - gamma1 v² / 2) / D). With the
// printed parameters noise dominates: the mean speed of S17 is 0.83, sqrt(gamma1 / gamma2) is 0.24.
//
// Options (first value: default)
//   friction      rayleigh | depot
//   confinement   harmonic | none: k = 0
//   interaction   repulsion: C_a = 0 | morse | none: F = 0
#include <algorithm>
#include <cmath>

#include "libswarm/centre.h"
#include "libswarm/exponential.h"
#include "libswarm/noise.h"
#include "libswarm/parallel.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Rows of the parameter table, in its order.
enum Row : std::size_t { kGamma1, kGamma2, kD, kCr, kK, kLr, kCa, kLa, kQ0, kC, kD2, kG0 };

constexpr double kLargestChange = 0.2;  // gamma2 |v|² dt
constexpr double kRanges = 30;          // as far as forces reach

// Small groups are taken pair by pair: places and what the others do to each, with room for a last block that is not full.
struct Buffers : Workspace {
  GaussianNoise noise, area;
  Rows midway;  // places after half a step of drift
  Rows place, force;
};

struct Strength {
  double c_r, l_r, c_a, l_a;  // c_a = 0: repulsion only
  double radius2, period[3];
};

inline __attribute__((always_inline)) void wrap(Lanes& d, double period) {
  const double half = 0.5 * period;
  const Lanes less = d - period, more = d + period;
  d = d > half ? less : (d < -half ? more : d);
}

// What those from `first` on do to agent i, and i to them. Returns whether anybody is at the same place, who is left out.
SWARMFIT_HOT bool pull(Rows& place, Rows& force, Index i, const Strength& s) {
  const Index n = place.rows() - 4;
  Lanes sum[3]{};
  LaneMask same{};
  // Blocks begin at multiples of four, so that what one agent stores the next can load without waiting.
  LaneMask later{0, 1, 2, 3};
  later += (i + 1) / 4 * 4 - i;
  for (Index j = (i + 1) / 4 * 4; j < n; j += 4, later += 4) {
    Lanes d[3], d2{}, e, minus;
#pragma GCC unroll 3
    for (Index k = 0; k < 3; ++k) {
      load(&place(j, k), d[k]);
      d[k] -= place(i, k);
      wrap(d[k], s.period[k]);
      d2 += d[k] * d[k];
    }
    Lanes distance;
    for (int l = 0; l < 4; ++l) distance[l] = std::sqrt(d2[l]);
    minus = distance / -s.l_r;
    exponential(minus > -700 ? minus : Lanes{} - 700, e);
    Lanes f = s.c_r / s.l_r * e;
    if (s.c_a != 0) {
      minus = distance / -s.l_a;
      exponential(minus > -700 ? minus : Lanes{} - 700, e);
      f -= s.c_a / s.l_a * e;
    }
    same |= (d2 == 0) & (later > 0);
    f = ((d2 < s.radius2) & (d2 > 0) & (later > 0)) ? f / distance : Lanes{};
#pragma GCC unroll 3
    for (Index k = 0; k < 3; ++k) {
      Lanes theirs;
      load(&force(j, k), theirs);
      const Lanes push = f * d[k];
      theirs += push;
      std::memcpy(&force(j, k), &theirs, sizeof theirs);
      sum[k] += push;
    }
  }
  for (Index k = 0; k < 3; ++k) force(i, k) -= (sum[k][0] + sum[k][1]) + (sum[k][2] + sum[k][3]);
  return (same[0] | same[1] | same[2] | same[3]) != 0;
}

class Brownian : public Model {
 public:
  explicit Brownian(const Setup& setup)
      : dims_(setup.dims),
        depot_(setup.options.at("friction") == "depot"),
        confined_(setup.options.at("confinement") == "harmonic"),
        repulsion_(setup.options.at("interaction") != "none"),
        attraction_(setup.options.at("interaction") == "morse"),
        centre_(setup) {}

  Index columns() const override { return 1; }
  std::unique_ptr<Workspace> workspace(const World&, const Rng&) const override { return std::make_unique<Buffers>(); }

  void enter(State& state, Index first, const World&, const StepContext& c) const override {
    if (!depot_) return;
    for (Index i = first; i < state.size(); ++i) state.own(i, 0) = c.p[kQ0] / (c.p[kC] + c.p[kD2] * speed2(state, i));
  }

  Step step(const State& now, State& next, const World& world, const StepContext& c) const override {
    if (!depot_ && c.can_halve && too_fast(now, c)) return Step::halve_dt;
    Buffers& buffers = *static_cast<Buffers*>(c.work);
    buffers.midway = now.pos + 0.5 * c.dt * now.vel;
    if (repulsion_) c.near.build(buffers.midway, world.bounds, reach(c));
    const bool pairs = repulsion_ && now.size() < Neighbours::kAllPairsBelow;
    if (pairs) pair_forces(now, c, buffers);
    buffers.noise.draw(c.rng, Stream::noise, c.tick, now.id);
    buffers.area.draw(c.rng, Stream::noise_path, c.tick, now.id);
    const Array3d centre = centre_.in(world.bounds);
    const double kick = std::sqrt(2 * c.p[kD] * c.dt), astray = kick * c.dt / std::sqrt(12.0);
    for_each_agent(now.size(), [&](Index i, std::size_t) {
      const Array3d before = now.vel.row(i).transpose(), midway = buffers.midway.row(i).transpose();
      Array3d force = Array3d::Zero();
      if (confined_) force += c.p[kK] * world.bounds.separation(midway, centre);
      if (repulsion_) force += pairs ? Array3d(buffers.force.row(i).transpose()) : interaction(now, i, c);
      const Propulsion propulsion(*this, now, next, i, c);
      const Array3d kicked = kick * flat(buffers.noise[i]);
      const Array3d half = before + 0.5 * (c.dt * (propulsion(before) + force) + kicked);
      const Array3d v = before + c.dt * (propulsion(half) + force) + kicked;
      next.vel.row(i) = v.transpose();
      next.pos.row(i) = (midway + 0.5 * c.dt * v + astray * flat(buffers.area[i])).transpose();
    });
    return Step::done;
  }

 private:
  static double speed2(const State& now, Index i) {
    return now.vel(i, 0) * now.vel(i, 0) + now.vel(i, 1) * now.vel(i, 1) + now.vel(i, 2) * now.vel(i, 2);
  }

  static bool too_fast(const State& now, const StepContext& c) {
    double fastest2 = 0;
    for (Index i = 0; i < now.size(); ++i) fastest2 = std::max(fastest2, speed2(now, i));
    return c.p[kGamma2] * fastest2 * c.dt > kLargestChange;
  }

  Array3d flat(const Array3d& a) const { return dims_ == 2 ? Array3d(a[0], a[1], 0) : a; }

  // f(v) v of one agent; the store is emptied once per step, into `next`.
  class Propulsion {
   public:
    Propulsion(const Brownian& model, const State& now, State& next, Index i, const StepContext& c)
        : linear_(c.p[kGamma1]), cubic_(c.p[kGamma2]) {
      if (!model.depot_) return;
      const double rate = c.p[kC] + c.p[kD2] * speed2(now, i), balance = c.p[kQ0] / rate, energy = now.own(i, 0);
      next.own(i, 0) = balance + (energy - balance) * std::exp(-rate * c.dt);
      linear_ = c.p[kD2] * energy - c.p[kG0];
      cubic_ = 0;
    }
    Array3d operator()(const Array3d& v) const { return (linear_ - cubic_ * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2])) * v; }

   private:
    double linear_, cubic_;
  };

  // What j at this distance does to i, along the line from j to i.
  double strength(double distance, const StepContext& c) const {
    double f = c.p[kCr] / c.p[kLr] * std::exp(-distance / c.p[kLr]);
    if (attraction_) f -= c.p[kCa] / c.p[kLa] * std::exp(-distance / c.p[kLa]);
    return f;
  }

  Array3d interaction(const State& now, Index i, const StepContext& c) const {
    Array3d force = Array3d::Zero();
    c.near.visit(i, [&](Index j, const Array3d& offset, double distance) {
      if (distance > 0) {
        force -= strength(distance, c) / distance * offset;
      } else {
        const std::uint32_t self = now.id[static_cast<std::size_t>(i)], other = now.id[static_cast<std::size_t>(j)];
        force += strength(0, c) * parting_direction(c.rng, c.tick, self, other, dims_);
      }
    });
    return force;
  }

  // The same for everybody in a small group, each pair once: action and reaction are equal.
  void pair_forces(const State& now, const StepContext& c, Buffers& buffers) const {
    constexpr double far = 1e150;  // fills the last block: nobody is out there
    const Index n = now.size();
    Rows &place = buffers.place, &force = buffers.force;
    place.setConstant(n + 4, 3, far);
    force.setZero(n + 4, 3);
    for (std::size_t k = 0; k < 3; ++k) std::copy_n(c.near.coordinate(k), n, place.col(static_cast<Index>(k)).data());
    const double range = reach(c);
    const Strength strengths{c.p[kCr], c.p[kLr],      attraction_ ? c.p[kCa] : 0.0,
                             c.p[kLa], range * range, {c.near.period(0), c.near.period(1), c.near.period(2)}};
    for (Index i = 0; i < n; ++i)
      if (pull(place, force, i, strengths)) part(now, i, c, force);
  }

  // Those at the same place as i, after it.
  void part(const State& now, Index i, const StepContext& c, Rows& force) const {
    c.near.visit_later(i, [&](Index j, const Array3d&, double distance) {
      if (distance > 0) return;
      const std::uint32_t one = now.id[static_cast<std::size_t>(i)], other = now.id[static_cast<std::size_t>(j)];
      const Array3d apart = strength(0, c) * parting_direction(c.rng, c.tick, one, other, dims_);
      force.row(i) += apart.transpose();
      force.row(j) -= apart.transpose();
    });
  }

  double reach(const StepContext& c) const { return kRanges * std::max(c.p[kLr], attraction_ ? c.p[kLa] : 0.0); }

  int dims_;
  bool depot_, confined_, repulsion_, attraction_;
  SwarmCentre centre_;
};

const std::vector<Parameter>& parameter_table() {
  using enum Parameter::Length;
  constexpr const char *rayleigh = "friction=rayleigh", *depot = "friction=depot", *morse = "interaction=morse";
  constexpr const char* repulsion = "interaction=repulsion|morse";
  // Rows longer than a line would be taken apart, one field a line:
  // clang-format off
  static const std::vector<Parameter> table{
      {.row = kGamma1, .name = "gamma1", .symbol = "γ_1", .unit = {0, -1}, .scene = {0.2156, -20, 20}, .fit = {1, -5, 5}, .fitted = true, .published = true,
       .when = rayleigh, .meaning = "propulsion of a slow agent; negative: friction", .source = "Table S17, there r1"},
      {.row = kGamma2, .name = "gamma2", .symbol = "γ_2", .unit = {-2, 1}, .scene = {3.8959, 0, 100}, .fit = {1, 0, 10}, .fitted = true, .published = true,
       .when = rayleigh, .meaning = "cubic friction", .source = "Table S17, there r2"},
      {.row = kD, .name = "D", .symbol = "D", .unit = {2, -3}, .scene = {0.9585, 0, 20}, .fit = {0.5, 0, 5}, .fitted = true, .published = true,
       .meaning = "intensity of the noise", .source = "Table S17"},
      {.row = kCr, .name = "C_r", .symbol = "C_r", .unit = {2, -2}, .scene = {0.0368, 0, 20}, .fit = {0.1, 0, 2}, .fitted = true, .published = true,
       .when = repulsion, .meaning = "energy of repulsion", .source = "Table S17"},
      {.row = kK, .name = "k", .symbol = "k", .unit = {0, -2}, .scene = {1, 0, 20}, .fit = {1, 0, 5}, .fitted = true,
       .when = "confinement=harmonic",
       .meaning = "stiffness of the confinement", .source = "our choice; the midges of Sinhuber et al. 2019 have 4.9 s^-2"},
      {.row = kLr, .name = "l_r", .symbol = "l_r", .unit = {1, 0}, .scene = {0.5, 0.01, 20}, .fit = {0.5, 0.05, 5}, .length = spacing,
       .log = true, .when = repulsion, .meaning = "range of repulsion", .source = "our choice"},
      {.row = kCa, .name = "C_a", .symbol = "C_a", .unit = {2, -2}, .scene = {0.0368, 0, 20}, .fit = {0.1, 0, 2}, .fitted = true,
       .when = morse, .meaning = "energy of attraction", .source = "our choice"},
      {.row = kLa, .name = "l_a", .symbol = "l_a", .unit = {1, 0}, .scene = {2, 0.01, 20}, .fit = {3, 0.05, 20}, .length = spacing,
       .log = true, .when = morse, .meaning = "range of attraction", .source = "our choice"},
      {.row = kQ0, .name = "q0", .symbol = "q_0", .unit = {2, -3}, .scene = {2, 0, 100}, .fit = {2, 0, 5}, .fitted = true, .when = depot,
       .meaning = "intake of energy", .source = "our choice"},
      {.row = kC, .name = "c", .symbol = "c", .unit = {0, -1}, .scene = {1, 0.01, 100}, .fit = {1, 0.1, 10}, .log = true, .when = depot,
       .meaning = "loss of stored energy", .source = "our choice"},
      {.row = kD2, .name = "d2", .symbol = "d_2", .unit = {-2, 1}, .scene = {1, 0, 100}, .fit = {1, 0, 10}, .fitted = true, .when = depot,
       .meaning = "conversion of stored energy to motion", .source = "our choice"},
      {.row = kG0, .name = "g0", .symbol = "γ_0", .unit = {0, -1}, .scene = {1, 0.01, 20}, .fit = {1, 0.3, 10}, .log = true, .fitted = true,
       .when = depot, .meaning = "linear friction", .source = "our choice"},
  };
  // clang-format on
  return table;
}

}  // namespace

ModelSpec brownian_spec() {
  return {.name = "brownian",
          .summary = "active Brownian particles: propulsion, noise, confinement and soft repulsion",
          .citation = "Schweitzer et al. 1998, doi:10.1103/PhysRevLett.80.5044; baseline of Ren et al. 2016",
          .dims = {2, 3},
          .native_dt = 0.01,
          .largest_dt = 1.0 / 40,  // gamma2 |v|² dt = 0.25 at the upper bound of gamma2 and the recorded speed
          .quiet = "D=0",
          .options = {{"friction",
                       {"rayleigh", "depot"},
                       "propulsion as a function of speed, or from stored energy",
                       {"propulsion as a function of speed", "propulsion from a store of energy"}},
                      {"confinement",
                       {"harmonic", "none"},
                       "force towards the centre",
                       {"a force towards the centre", "no force towards the centre"}},
                      {"interaction",
                       {"repulsion", "morse", "none"},
                       "forces between agents",
                       {"repulsion between agents", "repulsion and attraction between agents (Morse)", "no forces between agents"}}},
          .columns = {"energy"},
          .parameters = parameter_table(),
          .make = [](const Setup& setup) -> std::unique_ptr<Model> { return std::make_unique<Brownian>(setup); },
          .force = ForceLike{.silent = {kD}}};
}

}  // namespace swarmfit
