// SPDX-License-Identifier: MIT
//
// boids – Reynolds' flocking rules at constant speed
// ===================================================
// C. W. Reynolds, Flocks, herds and schools: a distributed behavioral model, SIGGRAPH 1987 (doi:10.1145/37401.37406), in the two-parameter
// form (speed, radius) that Ren et al. 2016 (doi:10.1371/journal.pone.0155698) fit in their Tables S17–S20.
//
//   S = sum over j nearer than radius / 2 of (p_i - p_j) / d²      separation
//   A = mean over j nearer than radius of v_j - v_i                alignment
//   C = mean over j nearer than radius of p_j - p_i                cohesion
//   v = speed · unit(v + (speed / tau) dt (1.5 unit(S) + unit(A) + unit(C)))
//   p = p + v dt
//
// unit(0) = 0. Synchronous, semi-implicit Euler. Without a neighbour an agent flies straight on. tau is the turning time; speed / tau is
// the steering acceleration, so the path does not depend on the time step. In a world with goals the way to one (paths.h), a unit vector,
// is added in the brackets.
//
// Options (first value: default)
//   noise   none    as above
//           perlin  p is carried by a wind, too: Perlin noise of x / scale, of root-mean-square length `agitation`
//           white   the same with a velocity uniform on a cube, drawn anew for each agent every `hold` seconds
//           with noise and goals: a baseline of X. Wang et al. 2014 (doi:10.1111/cgf.12277), section 7.1
#include <cmath>

#include "libswarm/agitation.h"
#include "libswarm/decision_clock.h"
#include "libswarm/flock_sums.h"
#include "libswarm/model.h"
#include "libswarm/parallel.h"
#include "libswarm/paths.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Rows of the parameter table, in its order.
enum Row : std::size_t { kSpeed, kRadius, kTau, kAgitation, kScale, kHold };

constexpr double kSeparation = 1.5, kAlignment = 1, kCohesion = 1, kGoal = 1;

Array3d unit(const Array3d& a) {
  const double length = std::sqrt(a.square().sum());
  return length > 0 ? Array3d(a * (1 / length)) : Array3d(Array3d::Zero());
}

struct Buffers : Workspace {
  explicit Buffers(const Rng& rng) : noise(rng) {}
  SlotVelocities velocities;
  NoiseField noise;
};

class Boids : public Model {
 public:
  explicit Boids(const Setup& setup) : dims_(setup.dims), agitation_(setup.options.at("noise"), setup.dims) {}

  std::unique_ptr<Workspace> workspace(const World&, const Rng& rng) const override { return std::make_unique<Buffers>(rng); }

  Step step(const State& now, State& next, const World& world, const StepContext& c) const override {
    auto& work = *static_cast<Buffers*>(c.work);
    const auto* paths = world.part<Paths>();
    c.near.build(now.pos, world.bounds, c.p[kRadius]);
    work.velocities.take(c.near, now.vel);
    const double speed = c.p[kSpeed], turn = speed / c.p[kTau] * c.dt;
    const std::uint64_t draw = decision_tick(c, c.p[kHold]);
    for_each_agent(now.size(), [&](Index i, std::size_t) {
      const Array3d before = now.vel.row(i).transpose();
      const Array3d x = now.pos.row(i).transpose();
      Array3d steering = steered(flock_sums(c.near, work.velocities, i, c.p[kRadius] / 2, c.p[kRadius]));
      if (paths) steering += kGoal * paths->direction(x);
      Array3d heading = unit(before + turn * steering);
      if ((heading == 0).all()) heading = at_rest(now, i, c);
      const Array3d v = speed * heading;
      next.vel.row(i) = v.transpose();
      next.pos.row(i) = now.pos.row(i) + v.transpose() * c.dt;
      if (!agitation_) return;
      const Array3d wind =
          agitation_.velocity(work.noise, x, c.p[kAgitation], c.p[kScale], c.rng, draw, now.id[static_cast<std::size_t>(i)]);
      next.pos.row(i) += wind.transpose() * c.dt;
    });
    return Step::done;
  }

 private:
  static Array3d steered(const FlockSums& sums) {
    return kSeparation * unit(sums.separation) + kAlignment * unit(sums.alignment) + kCohesion * unit(sums.cohesion);
  }

  // An agent without any velocity flies in a direction of its own.
  Array3d at_rest(const State& now, Index i, const StepContext& c) const {
    return random_direction(c.rng, Stream::tie_break, c.tick, now.id[static_cast<std::size_t>(i)], 0, dims_);
  }

  int dims_;
  Agitation agitation_;
};

const std::vector<Parameter>& parameter_table() {
  using enum Parameter::Length;
  // Rows longer than a line would be taken apart, one field a line:
  // clang-format off
  static const std::vector<Parameter> table{
      {.row = kSpeed, .name = "speed", .symbol = "v", .unit = {1, -1}, .scene = {7.5, 0.1, 10}, .fit = {1, 0.1, 4}, .log = true,
       .fitted = true, .published = true, .meaning = "constant speed", .source = "Table S17", .shown = Parameter::Shown::speed},
      {.row = kRadius, .name = "radius", .symbol = "r", .unit = {1, 0}, .scene = {0.26, 0.01, 10}, .fit = {1.5, 0.1, 10}, .length = spacing,
       .log = true, .fitted = true, .published = true, .meaning = "radius of perception", .source = "Table S17"},
      {.row = kTau, .name = "tau", .symbol = "τ", .unit = {0, 1}, .scene = {0.2, 0.01, 10}, .fit = {0.5, 0.05, 10}, .log = true,
       .fitted = true, .meaning = "turning time", .source = "our choice"},
      {.row = kAgitation, .name = "agitation", .unit = {1, -1}, .scene = {0.3, 0, 100}, .fit = {0.3, 0.03, 1}, .log = true, .fitted = true,
       .when = "noise=perlin|white", .meaning = "root-mean-square velocity of the wind", .source = "Wang et al., section 7.1"},
      {.row = kScale, .name = "scale", .unit = {1, 0}, .scene = {0.4, 0.01, 100}, .fit = {0.5, 0.05, 5}, .log = true, .fitted = true,
       .when = "noise=perlin", .meaning = "feature size of the wind", .source = "Wang et al., section 7.1"},
      {.row = kHold, .name = "hold", .symbol = "τ_h", .unit = {0, 1}, .scene = {1.0 / 60, 1e-4, 10}, .fit = {0.05, 0.001, 10}, .log = true,
       .when = "noise=white", .meaning = "how long a random velocity of the wind lasts", .source = "our choice: the paper's frame"},
  };
  // clang-format on
  return table;
}

}  // namespace

ModelSpec boids_spec() {
  return {.name = "boids",
          .summary = "separation, alignment and cohesion at constant speed",
          .citation = "Reynolds 1987, doi:10.1145/37401.37406; two-parameter form of Ren et al. 2016, doi:10.1371/journal.pone.0155698",
          .dims = {2, 3},
          .native_dt = 0.01,
          .largest_dt = 1.0 / 20,
          .quiet = "noise=none",
          .options = {{"noise",
                       {"none", "perlin", "white"},
                       "a wind",
                       {"no wind", "a smooth wind that all share", "a random wind of its own for each agent"}}},
          .columns = {},
          .parameters = parameter_table(),
          .make = [](const Setup& setup) -> std::unique_ptr<Model> { return std::make_unique<Boids>(setup); }};
}

}  // namespace swarmfit
