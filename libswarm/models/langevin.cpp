// SPDX-License-Identifier: MIT
//
// langevin – independent agents about a common centre: the null model without any interaction
// ===========================================================================================
// A. Okubo, Dynamical aspects of animal grouping: swarms, schools, flocks, and herds, Adv. Biophys. 22: 1–94, 1986
// (doi:10.1016/0065-227X(86)90003-1); with coloured noise as in A. M. Reynolds, M. Sinhuber, N. T. Ouellette, Are midge swarms bound
// together by an effective velocity-dependent gravity?, Eur. Phys. J. E 40: 46, 2017 (doi:10.1140/epje/i2017-11531-7).
//
//   dr   = v dt
//   dv   = (-v / tau_v - k (r - r_c) + eta) dt
//   deta = -eta / tau_eta dt + sigma_eta sqrt(2 / tau_eta) dW          per component, with standard deviation sigma_eta
//
// r_c is the recording's mean position; in scenes the middle of the arena, in the open the origin.
//
// With a = 1 / tau_eta, g = 1 / tau_v, s = sigma_eta² / (k + a g + a²), every component has the stationary moments
//   <v²> = s a / g     <x²> = s (a / g + 1) / k     <v eta> = s a     <x eta> = s     <x v> = 0          (x = r - r_c)
// Agents enter with an eta drawn from the stationary law given their place and velocity, so that a swarm that starts stationary stays so;
// without noise, where nothing moves in that law, with none.
//
// All of it is linear, so a step of any length is exact: (x, v, eta) of every component is multiplied by a matrix, and gets a normal error
// of known covariance (libswarm/linear_noise.h).
#include <algorithm>
#include <cmath>

#include "libswarm/centre.h"
#include "libswarm/linear_noise.h"
#include "libswarm/noise.h"
#include "libswarm/parallel.h"
#include "libtrack/normals.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Rows of the parameter table, in its order.
enum Row : std::size_t { kTauV, kK, kTauEta, kSigma };

constexpr Index kColumns = 3;  // eta

struct Buffers : Workspace {
  GaussianNoise noise[3];
  std::array<double, 5> of{};  // step and parameters of the transition
  LinearNoise<3> transition;
};

// An agent enters with eta = on_x · x + on_v · v + rest · (a normal number), the stationary law given x and v.
struct Entering {
  double on_x, on_v, rest;
};

Entering entering(std::span<const double> p) {
  if (p[kSigma] == 0) return {0, 0, 0};
  const double a = 1 / p[kTauEta], g = 1 / p[kTauV], k = p[kK];
  const double on_v = g, on_x = k * g / (a + g);
  const double explained = (on_v * a + on_x) / (k + a * g + a * a);  // of the variance of eta
  return {on_x, on_v, p[kSigma] * std::sqrt(std::max(0.0, 1 - explained))};
}

LinearMotion motion_of(std::span<const double> p) {
  const auto [on_x, on_v, rest] = entering(p);
  return {{{{0, 1, 0}, {-p[kK], -1 / p[kTauV], 1}, {0, 0, -1 / p[kTauEta]}}},
          {0, 0, p[kSigma] * std::sqrt(2 / p[kTauEta])},
          {on_x, on_v},
          rest};
}

class Langevin : public Model {
 public:
  explicit Langevin(const Setup& setup) : dims_(setup.dims), centre_(setup) {}

  Index columns() const override { return kColumns; }
  std::unique_ptr<Workspace> workspace(const World&, const Rng&) const override { return std::make_unique<Buffers>(); }

  void enter(State& state, Index first, const World& world, const StepContext& c) const override {
    const auto [on_x, on_v, rest] = entering(c.p);
    const Array3d centre = centre_.in(world.bounds);
    for (Index i = first; i < state.size(); ++i) {
      const Array3d x = world.bounds.separation(centre, state.pos.row(i).transpose()), v = state.vel.row(i).transpose();
      const Array3d eta = on_v * v + on_x * x + rest * three_normals(c.rng, Stream::hidden, c.tick, state.id[static_cast<std::size_t>(i)]);
      state.own.row(i) = flat(eta).transpose();
    }
  }

  Step step(const State& now, State& next, const World& world, const StepContext& c) const override {
    Buffers& buffers = *static_cast<Buffers*>(c.work);
    if (const std::array now_of{c.dt, c.p[kTauV], c.p[kK], c.p[kTauEta], c.p[kSigma]}; buffers.of != now_of) {
      buffers.of = now_of;
      const LinearMotion motion = motion_of(c.p);
      buffers.transition = LinearNoise<3>(motion.drift, motion.noise, c.dt);
    }
    constexpr Stream streams[] = {Stream::noise, Stream::noise_path, Stream::noise_path_2};
    for (std::size_t k = 0; k < 3; ++k) buffers.noise[k].draw(c.rng, streams[k], c.tick, now.id);
    const Array3d centre = centre_.in(world.bounds);
    const auto &keep = buffers.transition.keep, &draw = buffers.transition.draw;
    for_each_agent(now.size(), [&](Index i, std::size_t) {
      const Array3d here = now.pos.row(i).transpose(), x = world.bounds.separation(centre, here);
      const Array3d state[] = {x, now.vel.row(i).transpose(), now.own.row(i).transpose()};
      const Array3d normal[] = {buffers.noise[0][i], buffers.noise[1][i], buffers.noise[2][i]};
      Array3d after[3];
      for (std::size_t r = 0; r < 3; ++r) {
        after[r] = keep[r][0] * state[0] + keep[r][1] * state[1] + keep[r][2] * state[2];
        for (std::size_t k = 0; k <= r; ++k) after[r] += draw[r][k] * flat(normal[k]);
      }
      next.pos.row(i) = (here + after[0] - x).transpose();
      next.vel.row(i) = after[1].transpose();
      next.own.row(i) = after[2].transpose();
    });
    return Step::done;
  }

 private:
  Array3d flat(const Array3d& a) const { return dims_ == 2 ? Array3d(a[0], a[1], 0) : a; }

  int dims_;
  SwarmCentre centre_;
};

const std::vector<Parameter>& parameter_table() {
  using enum Parameter::Length;
  constexpr const char *okubo = "Okubo 1986", *reynolds = "Reynolds et al. 2017";
  // Rows longer than a line would be taken apart, one field a line:
  // clang-format off
  static const std::vector<Parameter> table{
      {.row = kTauV, .name = "tau_v", .symbol = "τ_v", .unit = {0, 1}, .scene = {1, 0.01, 100}, .fit = {1, 0.1, 10}, .log = true,
       .fitted = true, .meaning = "time of friction", .source = okubo},
      {.row = kK, .name = "k", .symbol = "k", .unit = {0, -2}, .scene = {1, 0, 20}, .fit = {1, 0, 5}, .fitted = true,
       .meaning = "stiffness of the confinement", .source = okubo},
      {.row = kTauEta, .name = "tau_eta", .symbol = "τ_η", .unit = {0, 1}, .scene = {0.1, 0.001, 10}, .fit = {0.2, 0.02, 2}, .log = true,
       .fitted = true, .meaning = "memory of the noise", .source = reynolds},
      {.row = kSigma, .name = "sigma_eta", .symbol = "σ_η", .unit = {1, -2}, .scene = {5, 0, 100}, .fit = {3, 0, 10}, .fitted = true,
       .meaning = "standard deviation of the noise acceleration, per component", .source = reynolds},
  };
  // clang-format on
  return table;
}

}  // namespace

ModelSpec langevin_spec() {
  return {.name = "langevin",
          .summary = "null model: independent damped oscillators about the swarm's centre, driven by coloured noise",
          .citation = "Okubo 1986, doi:10.1016/0065-227X(86)90003-1; Reynolds et al. 2017, doi:10.1140/epje/i2017-11531-7",
          .dims = {2, 3},
          .native_dt = 0.01,
          .largest_dt = INFINITY,  // steps are exact
          .quiet = "sigma_eta=0",
          .options = {},
          .columns = {"eta_x", "eta_y", "eta_z"},
          .parameters = parameter_table(),
          .make = [](const Setup& setup) -> std::unique_ptr<Model> { return std::make_unique<Langevin>(setup); },
          .linear = [](const Options&, std::span<const double> p) -> std::optional<LinearMotion> { return motion_of(p); },
          .force = ForceLike{.silent = {kSigma}, .memory = "always"}};
}

}  // namespace swarmfit
