// SPDX-License-Identifier: MIT
#include "fit/experiment/expect.h"

#include "libeval/behaviour.h"
#include "libswarm/scenario/scenario.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr double kSlack = 1e-9;  // of a radius or a side: what rounding may do to somebody at a wall

Questions questions_of(const Expectation& e) { return {e.arguments.begin(), e.arguments.end()}; }

bool beyond(const Bounds& b, const Eigen::Array3d& p, int dims) {
  if (b.kind == Bounds::Kind::open) return false;
  if (b.kind == Bounds::Kind::sphere) return (p - b.centre).square().sum() > b.radius * b.radius * (1 + kSlack);
  const Eigen::Array3d slack = kSlack * (b.upper - b.lower);
  bool outside = false;
  for (Index axis = 0; axis < dims; ++axis)
    outside = outside || p[axis] < b.lower[axis] - slack[axis] || p[axis] > b.upper[axis] + slack[axis];
  return outside;
}

}  // namespace

void check_expectations(const Scenario& scene) {
  for (const Expectation& e : scene.expectations) try {
      check_question(e.measure, questions_of(e));
    } catch (const InputError& error) {
      throw InputError(e.place + error.what());
    }
}

std::vector<Finding> findings(const Scenario& scene, const Film& made) {
  check_expectations(scene);
  const Walls walls(scene.obstacles);
  const auto steps = static_cast<double>(std::max<std::uint64_t>(1, made.count.agent_steps)),
             enforced = static_cast<double>(made.count.enforced);
  const Witness seen{.agents = made.tracks,
                     .stimuli = &made.stimuli,
                     .forbidden = [&](const Eigen::Array3d& p) { return walls.hold(p, scene.dims) || beyond(scene.bounds, p, scene.dims); },
                     .enforced = enforced / steps,
                     .curve = scene.curve ? &scene.curve->curve : nullptr,
                     .reach = scene.curve ? scene.curve->reach : 0};
  std::vector<Finding> all;
  for (const Expectation& e : scene.expectations)
    all.push_back({e.name, e.measure, observed(e.measure, seen, questions_of(e)), e.above, e.below, e.published});
  return all;
}

}  // namespace swarmfit
