// SPDX-License-Identifier: MIT
//
// rvo – agents that head for goals and do nothing else but avoid each other
// =========================================================================
// J. van den Berg, S. J. Guy, M. Lin, D. Manocha, Reciprocal n-body collision avoidance, ISRR 2009/2011
// (doi:10.1007/978-3-642-19457-3_1), in three dimensions as in RVO2-3D; a baseline of Ren et al. 2016
// (doi:10.1371/journal.pone.0155698), Tables S17–S20, which fit the range and number of neighbours, the radius and the highest speed.
//
//   v_pref = v_max · unit(goal - p) + jitter
//   v      = velocity nearest to v_pref with |v| <= v_max among those that lead to no collision within tau (avoidance.h)
//   p      = p + v dt
//
// Neighbours: the k nearest within a distance. No agent flies beyond its goal within a step. The jitter, uniform in direction and
// 1e-3 v_max long, breaks the symmetry of head-on encounters. Synchronous; velocities have no inertia.
// The sources do not say where the agents want to go; option `goal`:
//   random     a point uniform in the ball (in two dimensions disc) about the swarm's centre with radius `goal_radius`, replaced when the
//              agent comes nearer to it than two radii, or after `goal_time`
//   center     to the centre from rest and from farther away than `goal_radius`, straight on within
//   antipodal  the point opposite to the place of entry, seen from the centre; once there, the way back
//   inertial   straight on: the direction of flight; from rest in a drawn one
// The centre is the recording's mean position; in scenes the middle of the arena, in the open the origin.
//
// Option `infeasible`, where every velocity leads to a collision: min_penetration, the least bad velocity (section 5.3) | zero | substep:
// redo the step in halves, thrice at most, then zero.
#include <cmath>

#include "libswarm/avoider.h"
#include "libswarm/centre.h"
#include "libswarm/noise.h"
#include "libswarm/parallel.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Rows of the parameter table, in its order.
enum Row : std::size_t { kRange, kNeighbours, kRadius, kMaxSpeed, kTimeHorizon, kGoalRadius, kGoalTime, kJitter };

// Private columns: the goal [unit], and when it was chosen [s].
enum : Index { kGoal, kChosen = kGoal + 3, kColumns };

double length(const Array3d& a) { return std::sqrt(a.square().sum()); }

struct Buffers : Workspace {
  Buffers(int dims, Infeasible infeasible) : avoider(dims, infeasible) {}
  Avoider avoider;
};

class Rvo : public Model {
 public:
  explicit Rvo(const Setup& setup)
      : dims_(setup.dims),
        goal_(parse_goal(setup.options.at("goal"))),
        infeasible_(parse_infeasible(setup.options.at("infeasible"))),
        centre_(setup) {}

  Index columns() const override { return kColumns; }
  std::unique_ptr<Workspace> workspace(const World&, const Rng&) const override { return std::make_unique<Buffers>(dims_, infeasible_); }

  void enter(State& state, Index first, const World& world, const StepContext& c) const override {
    for (Index i = first; i < state.size(); ++i) choose(state, state, i, world.bounds, c);
  }

  Step step(const State& now, State& next, const World& world, const StepContext& c) const override {
    Avoider& avoider = static_cast<Buffers*>(c.work)->avoider;
    avoider.begin(now, world.bounds, {c.p[kRadius], c.p[kMaxSpeed], c.p[kTimeHorizon], c.p[kRange], c.p[kNeighbours]});
    for_each_agent(now.size(), [&](Index i, std::size_t thread) {
      const Array3d v = avoider.velocity(now, i, preferred(now, next, i, world.bounds, c), c, thread);
      next.vel.row(i) = v.transpose();
      next.pos.row(i) = now.pos.row(i) + v.transpose() * c.dt;
    });
    return avoider.end(c);
  }

 private:
  enum class Goal { random, center, antipodal, inertial };

  static Goal parse_goal(std::string_view name) {
    if (name == "random") return Goal::random;
    if (name == "center") return Goal::center;
    return name == "antipodal" ? Goal::antipodal : Goal::inertial;
  }

  Array3d preferred(const State& now, State& next, Index i, const Bounds& bounds, const StepContext& c) const {
    const std::uint32_t id = now.id[static_cast<std::size_t>(i)];
    const Array3d jitter = c.p[kJitter] * c.p[kMaxSpeed] * random_direction(c.rng, Stream::noise, c.tick, id, 0, dims_);
    return heading(now, next, i, bounds, c) + jitter;
  }

  // Towards the goal, or straight on where there is none.
  Array3d heading(const State& now, State& next, Index i, const Bounds& bounds, const StepContext& c) const {
    const Array3d here = now.pos.row(i).transpose();
    if (goal_ == Goal::inertial) return straight_on(now, i, c);
    if (goal_ == Goal::center) {
      const Array3d home = bounds.separation(here, centre_.in(bounds));
      const bool resting = (now.vel.row(i) == 0).all();
      return resting || length(home) > c.p[kGoalRadius] ? towards(home, c) : straight_on(now, i, c);
    }
    Array3d way = bounds.separation(here, goal_of(now, i));
    const bool late = goal_ == Goal::random && c.t - now.own(i, kChosen) >= c.p[kGoalTime];
    if (late || length(way) < 2 * c.p[kRadius]) {
      choose(now, next, i, bounds, c);
      way = bounds.separation(here, goal_of(next, i));
    }
    return towards(way, c);
  }

  Array3d straight_on(const State& now, Index i, const StepContext& c) const {
    const Array3d v = now.vel.row(i).transpose();
    const double speed = length(v);
    if (speed > 0) return c.p[kMaxSpeed] / speed * v;
    return c.p[kMaxSpeed] * random_direction(c.rng, Stream::tie_break, c.tick, now.id[static_cast<std::size_t>(i)], 0, dims_);
  }

  static Array3d towards(const Array3d& way, const StepContext& c) {
    const double distance = length(way);
    return distance > c.p[kMaxSpeed] * c.dt ? Array3d(c.p[kMaxSpeed] / distance * way) : Array3d(way / c.dt);
  }

  static Array3d goal_of(const State& state, Index i) { return state.own.row(i).segment<3>(kGoal).transpose(); }

  // Gives agent i of `next`, which stands where `now` says, a goal.
  void choose(const State& now, State& next, Index i, const Bounds& bounds, const StepContext& c) const {
    const Array3d centre = centre_.in(bounds), here = now.pos.row(i).transpose();
    Array3d goal = centre;
    if (goal_ == Goal::antipodal) goal = centre - bounds.separation(centre, here);
    if (goal_ == Goal::random) {
      const std::uint32_t id = now.id[static_cast<std::size_t>(i)];
      const double u = c.rng.uniform(Stream::goal, c.tick, id, 0);
      const double distance = c.p[kGoalRadius] * (dims_ == 2 ? std::sqrt(u) : std::cbrt(u));
      goal = centre + distance * random_direction(c.rng, Stream::goal, c.tick, id, 1, dims_);
    }
    next.own.row(i).segment<3>(kGoal) = goal.transpose();
    next.own(i, kChosen) = c.t;
  }

  int dims_;
  Goal goal_;
  Infeasible infeasible_;
  SwarmCentre centre_;
};

const std::vector<Parameter>& parameter_table() {
  using enum Parameter::Length;
  constexpr const char* about_centre = "goal=random|center";
  // Rows longer than a line would be taken apart, one field a line:
  // clang-format off
  static const std::vector<Parameter> table{
      {.row = kRange, .name = "neighbour_distance", .symbol = "d_max", .unit = {1, 0}, .scene = {0.4022, 0.01, 40}, .fit = {3, 0.5, 10},
       .length = spacing, .log = true, .fitted = true, .published = true, .meaning = "range of avoidance", .source = "Table S17"},
      {.row = kNeighbours, .name = "max_neighbours", .symbol = "k", .unit = {0, 0}, .scene = {11, 1, 100}, .fit = {10, 1, 30},
       .fitted = true, .published = true, .meaning = "most neighbours avoided at once", .source = "Table S17 10.6452; RVO2-3D 10", .integer = true},
      {.row = kRadius, .name = "radius", .symbol = "r", .unit = {1, 0}, .scene = {0.0718, 0.001, 10}, .fit = {0.05, 0.01, 1},
       .length = spacing, .log = true, .fitted = true, .published = true, .meaning = "radius of an agent", .source = "Table S17"},
      {.row = kMaxSpeed, .name = "max_speed", .symbol = "v_max", .unit = {1, -1}, .scene = {0.2309, 0.01, 100}, .fit = {1, 0.2, 5},
       .log = true, .fitted = true, .published = true, .meaning = "highest and preferred speed", .source = "Table S17"},
      {.row = kTimeHorizon, .name = "time_horizon", .symbol = "τ", .unit = {0, 1}, .scene = {1, 0.01, 20}, .fit = {2, 0.05, 20},
       .log = true, .fitted = true,
       .meaning = "for how long collisions are avoided", .source = "our choice: the sources do not say; RVO2-3D 10"},
      {.row = kGoalRadius, .name = "goal_radius", .unit = {1, 0}, .scene = {2, 0.01, 100}, .fit = {2, 0.1, 10}, .log = true, .fitted = true,
       .when = about_centre,
       .meaning = "goals lie this near the centre; from farther away agents return to it",
       .source = "our choice: twice the extent of the recording"},
      {.row = kGoalTime, .name = "goal_time", .unit = {0, 1}, .scene = {5, 0.1, 100}, .fit = {10, 0.5, 100}, .log = true, .fitted = true,
       .when = "goal=random", .meaning = "after this time a goal is given up", .source = "our choice"},
      {.row = kJitter, .name = "jitter", .unit = {0, 0}, .scene = {1e-3, 0, 0.1}, .fit = {1e-3, 0, 0.1},
       .meaning = "random part of the preferred velocity, in units of the highest speed",
       .source = "our choice, as in the examples of RVO2"},
  };
  // clang-format on
  return table;
}

}  // namespace

ModelSpec rvo_spec() {
  return {
      .name = "rvo",
      .summary = "goals and reciprocal collision avoidance, nothing else",
      .citation = "van den Berg et al. 2011, doi:10.1007/978-3-642-19457-3_1; baseline of Ren et al. 2016",
      .dims = {2, 3},
      .native_dt = 0.01,
      .largest_dt = 1.0 / 40,  // an eighth of the extent per step at the highest of speeds
      .quiet = "goal=center,jitter=0",
      .options = {{"goal",
                   {"random", "center", "antipodal", "inertial"},
                   "where agents want to go",
                   {"random goals", "goals at the centre", "goals opposite to where agents entered", "straight flight instead of goals"}},
                  {"infeasible",
                   {"min_penetration", "zero", "substep"},
                   "what to do when every velocity leads to a collision",
                   {"the least bad velocity where every one leads to a collision", "a halt where every velocity leads to a collision",
                    "steps in halves where every velocity leads to a collision"}}},
      .columns = {"goal_x", "goal_y", "goal_z", "goal_chosen"},
      .parameters = parameter_table(),
      .make = [](const Setup& setup) -> std::unique_ptr<Model> { return std::make_unique<Rvo>(setup); }};
}

}  // namespace swarmfit
