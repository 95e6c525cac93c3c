// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "libswarm/headings.h"
#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using Values = std::map<std::string, double>;
constexpr double kPi = std::numbers::pi;

struct Agent {
  Array3d pos, heading;
};

const Array3d kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);
const Agent kMe{{0, 0, 0}, kX};

Lane lane_of(const Made& made, const std::vector<Agent>& agents, const Values& values) {
  Lane lane = crowd(made, 0, 1, 1);
  for (const auto& [name, value] : values) set(made, lane, name, value);
  for (const Agent& a : agents) lane.state.spawn(0, a.pos, a.heading);
  return lane;
}

// Heading of the first agent after one decision.
Array3d decided(const std::string& options, const std::vector<Agent>& agents, const Values& values = {}) {
  const Made made = make("local_attraction" + options);
  Lane lane = lane_of(made, agents, values);
  run(made, {.frame_dt = 1, .frames = 2}, lane);
  return heading_of(lane.state.vel.row(0).transpose());
}

#define EXPECT_HEADING(actual, x, y, z) EXPECT_LT(((actual)-heading_of(Array3d(x, y, z))).abs().maxCoeff(), 1e-12) << (actual).transpose()

TEST(LocalAttraction, KeepsDirectionAndIsDrawnToTheCentre) {
  EXPECT_HEADING(decided("", {kMe}), 1, 0, 0);
  EXPECT_HEADING(decided("", {kMe, {{0, 3, 0}, kZ}}, {{"c", 0.5}}), 1, 0.5, 0);
  EXPECT_HEADING(decided("", {kMe, {{0, 3, 0}, kZ}, {{0, 0, 1}, kZ}}, {{"c", 2}}), 1, 2 * 3 / std::sqrt(10), 2 / std::sqrt(10));
  EXPECT_HEADING(decided("", {kMe, {{0, 3, 0}, kZ}, {{0, -3, 0}, kZ}}), 1, 0, 0);  // a centre at one's own place has no direction
  EXPECT_HEADING(decided("", {kMe, {{0, 4, 0}, kZ}}), 1, 0, 0);                    // nearer than the radius, not at it
}

TEST(LocalAttraction, BlindBehindTheBack) {
  const auto at = [](double degrees) -> Array3d { return 3 * Array3d(std::cos(degrees * kPi / 180), std::sin(degrees * kPi / 180), 0); };
  const Array3d seen = at(134);
  EXPECT_HEADING(decided("", {kMe, {seen, kZ}}, {{"blind", kPi / 2}}), 1 + seen[0] / 3, seen[1] / 3, 0);
  EXPECT_HEADING(decided("", {kMe, {at(136), kZ}}, {{"blind", kPi / 2}}), 1, 0, 0);
  // Repulsion works all round: 1 / d² = 1 / 9 away from the other.
  const Array3d behind = at(136);
  EXPECT_HEADING(decided("[repulsion=on]", {kMe, {behind, kZ}}, {{"blind", kPi / 2}}), 1 - behind[0] / 27, -behind[1] / 27, 0);
}

TEST(LocalAttraction, RepulsionFallsWithTheSquareOfTheDistance) {
  const Values values{{"inertia", 2}, {"c", 0.5}, {"c_rep", 3}, {"r_rep", 3}};
  EXPECT_HEADING(decided("[repulsion=on]", {kMe, {{0, 2, 0}, kZ}}, values), 2, 0.5 - 3.0 / 4, 0);
  EXPECT_HEADING(decided("[repulsion=on]", {kMe, {{0, 3, 0}, kZ}}, values), 2, 0.5, 0);
  EXPECT_HEADING(decided("[repulsion=on]", {kMe, {{0, 1, 0}, kZ}, {{0, 0, 2}, kZ}}, values), 2, 0.5 / std::sqrt(5) - 3,
                 1 / std::sqrt(5) - 3.0 / 4);  // a sum
}

TEST(LocalAttraction, TopologicalNeighboursAreTheNearestSeenAtAnyDistance) {
  const std::vector<Agent> agents{kMe, {{0, 30, 0}, kZ}, {{0, 0, 40}, kZ}, {{-20, 0, 0}, kZ}, {{50, 0, 0}, kZ}};
  EXPECT_HEADING(decided("[neighbours=topological]", agents, {{"nearest", 1}, {"c", 0.5}}), 0.5, 0, 0);
  EXPECT_HEADING(decided("[neighbours=topological]", agents, {{"nearest", 1}, {"blind", 1}}), 1, 1, 0);  // the nearest is behind
  EXPECT_HEADING(decided("[neighbours=topological]", agents, {{"nearest", 2}, {"blind", 1}}), 1, 0.6, 0.8);
}

// In a sequential step the second sees where the first has gone: one of the two orders, worked out by hand.
TEST(LocalAttraction, SequentialAgentsSeeWhereOthersAreNow) {
  const std::vector<Agent> agents{{{0, 0, 0}, kX}, {{0, 2, 0}, kX}};
  const auto second = [](const Array3d& me, const Array3d& other) -> Array3d { return heading_of(kX + heading_of(other - me)); };
  const Array3d a_first = heading_of(kX + kY), b_first = heading_of(kX - kY);
  int orders[2] = {};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Made made = make("local_attraction[update=sequential]");
    Lane lane = lane_of(made, agents, {});
    lane.rng = {seed};
    run(made, {.frame_dt = 1, .frames = 2}, lane);
    const Array3d a = lane.state.vel.row(0).transpose() / 0.5, b = lane.state.vel.row(1).transpose() / 0.5;
    const bool a_led = (a - a_first).abs().maxCoeff() < 1e-12;
    ++orders[a_led ? 0 : 1];
    const Array3d expected = a_led ? second({0, 2, 0}, 0.5 * a_first) : second({0, 0, 0}, Array3d(0, 2, 0) + 0.5 * b_first);
    EXPECT_LT(((a_led ? b : a) - expected).abs().maxCoeff(), 1e-12);
  }
  EXPECT_GT(orders[0], 0);
  EXPECT_GT(orders[1], 0);
}

// Alone, an agent moves straight on by whole steps, as often as a Poisson process fires: mean and variance of the number of steps are the
// time over tau, to within 5 standard errors, however a simulation steps.
TEST(LocalAttraction, GillespieWaitingTimesAreExponential) {
  const int n = 1900;
  const double tau = 0.5, time = 4;
  for (const int substeps : {1, 7}) {
    const Made made = make("local_attraction[update=gillespie]");
    Lane lane = lane_of(made, {}, {{"tau", tau}});
    for (int k = 0; k < n; ++k) lane.state.spawn(0, {0, 1000.0 * k, 0}, kX);
    run(made, {.frame_dt = time / 2, .substeps = substeps, .frames = 3}, lane);
    double mean = 0, square = 0;
    for (Index i = 0; i < n; ++i) {
      const double steps = lane.state.pos(i, 0) / (0.5 * tau);
      EXPECT_NEAR(steps, std::round(steps), 1e-9);
      mean += steps / n;
      square += steps * steps / n;
    }
    const double expected = time / tau;
    EXPECT_NEAR(mean, expected, 5 * std::sqrt(expected / n));
    EXPECT_NEAR(square - mean * mean, expected, 5 * expected * std::sqrt(2.0 / n + 1 / (n * expected)));
  }
}

TEST(LocalAttraction, FinerStepsChangeNothing) {
  const Made made = make("local_attraction");
  const auto end = [&](int substeps) {
    Lane lane = crowd(made, 30, 4, 0.5);
    set(made, lane, "noise", 0.3);
    run(made, {.frame_dt = 1, .substeps = substeps, .frames = 6}, lane);
    return lane.state;
  };
  EXPECT_LT((end(1).pos - end(8).pos).abs().maxCoeff(), 1e-9);
}

// ---- collective states ----------------------------------------------------------------------------------------------------------

struct Order {
  double polarisation = 0, rotation = 0, absolute_rotation = 0, thinness = 0;  // thinness: smaller over larger variance, in a plane
};

// Of one moment in a plane; rotation about the centre, with rhat at the positions.
Order order_of(const Rows& pos, const Rows& vel, const std::function<Array3d(Index)>& from_centre) {
  Order order;
  const auto n = static_cast<double>(pos.rows());
  Array3d heading = Array3d::Zero();
  double xx = 0, xy = 0, yy = 0;
  for (Index i = 0; i < pos.rows(); ++i) {
    const Array3d u = heading_of(vel.row(i).transpose()), off = from_centre(i), r = heading_of(off);
    const double turn = r[0] * u[1] - r[1] * u[0];
    heading += u / n;
    order.rotation += turn / n;
    order.absolute_rotation += std::abs(turn) / n;
    xx += off[0] * off[0], xy += off[0] * off[1], yy += off[1] * off[1];
  }
  order.polarisation = std::sqrt(heading.square().sum());
  order.rotation = std::abs(order.rotation);
  const double middle = (xx + yy) / 2, half = std::hypot((xx - yy) / 2, xy);
  order.thinness = (middle - half) / (middle + half);
  return order;
}

// Every agent circles the centre at speed tau / c, half of them each way: that is kept exactly, and |r̂ × D| is cos(phi / 2).
TEST(LocalAttraction, AMillHasTheRadiusOfOneStepOverC) {
  for (const double c : {0.3, 1.0, 1.5}) {
    const Made made = make("local_attraction", 2);
    Lane lane = lane_of(made, {}, {{"c", c}});
    const double radius = 0.5 / c, half_turn = std::asin(c / 2);
    const int pairs = 6;
    for (int k = 0; k < pairs; ++k)
      for (const double side : {0.0, kPi}) {
        const double at = side + kPi * (k + 0.3) / pairs, sense = k % 2 == 0 ? 1 : -1;
        const Array3d r(std::cos(at), std::sin(at), 0), t(-std::sin(at), std::cos(at), 0);
        lane.state.spawn(0, radius * r, std::sin(half_turn) * r + sense * std::cos(half_turn) * t);
      }
    run(made, {.frame_dt = 1, .frames = 13}, lane);  // errors of rounding grow
    const Rows& pos = lane.state.pos;
    EXPECT_LT((pos.square().rowwise().sum().sqrt() - radius).abs().maxCoeff(), 1e-9) << c;
    const Order order = order_of(pos, lane.state.vel, [&](Index i) -> Array3d { return pos.row(i).transpose(); });
    EXPECT_NEAR(order.absolute_rotation, std::sqrt(1 - c * c / 4), 1e-9) << c;
    EXPECT_LT(order.polarisation, 1e-9);
  }
}

// Averages over the last 200 of 4000 decisions: 50 agents on a torus of side 10.
Order torus_state(const std::string& update, double c, std::uint64_t seed) {
  const Made made = make("local_attraction[update=" + update + "]", 2);
  Lane lane = crowd(made, 50, 10, 0.5, seed);
  set(made, lane, "c", c);
  lane.world.bounds = {.kind = Bounds::Kind::periodic, .upper = {10, 10, 0}};
  run(made, {.frame_dt = 1, .frames = 3800}, lane);
  Recorded out;
  lane.out = &out;
  run(made, {.frame_dt = 1, .first_frame = 3799, .frames = 200}, lane);
  Order mean;
  for (const auto& m : out.moments) {
    Array3d mid = Array3d::Zero();  // circular mean
    for (Index axis = 0; axis < 2; ++axis) {
      const double angle = std::atan2((m.pos.col(axis) * kPi / 5).sin().mean(), (m.pos.col(axis) * kPi / 5).cos().mean());
      mid[axis] = angle * 5 / kPi;
    }
    const Order o = order_of(m.pos, m.vel, [&](Index i) { return lane.world.bounds.separation(mid, m.pos.row(i).transpose()); });
    mean.polarisation += o.polarisation / 200;
    mean.rotation += o.rotation / 200;
    mean.absolute_rotation += o.absolute_rotation / 200;
  }
  return mean;
}

// An independent implementation gave, at c = 0.1, a polarisation of 0.14 (synchronous) and 1.00 in three of three seeds (sequential);
// undirected mills with |rotation| of cos(phi / 2) for c from 0.3 to 1.5 with both; and swarms at c = 2 (0.02 synchronous, 0.30
// sequential).
TEST(LocalAttraction, PhasesWithSynchronousUpdate) {
  EXPECT_LT(torus_state("synchronous", 0.1, 1).polarisation, 0.35);
  const Order mill = torus_state("synchronous", 0.5, 1), swarm = torus_state("synchronous", 2, 1);
  EXPECT_NEAR(mill.absolute_rotation, std::sqrt(1 - 0.25 / 4), 0.01);
  EXPECT_LT(mill.polarisation, 0.02);
  EXPECT_LT(swarm.polarisation, 0.1);
  EXPECT_LT(swarm.absolute_rotation, 0.1);
}

TEST(LocalAttraction, PhasesWithSequentialUpdate) {
  EXPECT_GT(torus_state("sequential", 0.1, 1).polarisation, 0.99);
  const Order mill = torus_state("sequential", 1, 1), swarm = torus_state("sequential", 2, 1);
  EXPECT_NEAR(mill.absolute_rotation, std::sqrt(1 - 1.0 / 4), 0.02);
  EXPECT_LT(mill.polarisation, 0.05);
  EXPECT_NEAR(swarm.polarisation, 0.30, 0.1);
  EXPECT_NEAR(swarm.absolute_rotation, 0.34, 0.12);
}

// Of the largest group of agents linked within the radius, averaged over the last 200 of 3000 decisions: 70 agents in open space.
Order open_state(const std::string& options, const Values& values, std::uint64_t seed = 1) {
  const Made made = make("local_attraction" + options, 2);
  Lane lane = crowd(made, 70, 12, 1, seed);
  const double radius = 6;
  for (const auto& [name, value] : values) set(made, lane, name, value);
  set(made, lane, "radius", radius), set(made, lane, "speed", 0.4 / 3), set(made, lane, "noise", 0.2);
  run(made, {.frame_dt = 1, .frames = 2800}, lane);
  Recorded out;
  lane.out = &out;
  run(made, {.frame_dt = 1, .first_frame = 2799, .frames = 200}, lane);
  Order mean;
  for (const auto& m : out.moments) {
    std::vector<Index> best;
    std::vector<bool> taken(static_cast<std::size_t>(m.pos.rows()), false);
    for (Index first = 0; first < m.pos.rows(); ++first) {
      if (taken[static_cast<std::size_t>(first)]) continue;
      std::vector<Index> group{first};
      taken[static_cast<std::size_t>(first)] = true;
      for (std::size_t k = 0; k < group.size(); ++k)
        for (Index j = 0; j < m.pos.rows(); ++j)
          if (!taken[static_cast<std::size_t>(j)] && (m.pos.row(j) - m.pos.row(group[k])).square().sum() < radius * radius) {
            taken[static_cast<std::size_t>(j)] = true;
            group.push_back(j);
          }
      if (group.size() > best.size()) best = group;
    }
    const Rows pos = m.pos(best, Eigen::all), vel = m.vel(best, Eigen::all);
    const Array3d mid = pos.colwise().mean().transpose();
    const Order o = order_of(pos, vel, [&](Index i) -> Array3d { return pos.row(i).transpose() - mid; });
    mean.polarisation += o.polarisation / 200;
    mean.rotation += o.rotation / 200;
    mean.absolute_rotation += o.absolute_rotation / 200;
    mean.thinness += o.thinness / 200;
  }
  return mean;
}

// An independent implementation gave polarisation 0.13 and rotation 0.06 without a blind angle, polarisation 0.99 with one of 180° (here it
// creeps up: 0.95 after 3000 decisions, 0.98 after 6000); and
// without repulsion |rotation| of 0.91 at 90°, and thin chains of polarisation 0.99 and axis ratio 0.01 at 180°.
TEST(LocalAttraction, RepulsionAndABlindAngle) {
  const Order swarm = open_state("[repulsion=on]", {{"c", 1}}), moving = open_state("[repulsion=on]", {{"c", 1}, {"blind", kPi}});
  EXPECT_NEAR(swarm.polarisation, 0.13, 0.06);
  EXPECT_LT(swarm.rotation, 0.2);
  EXPECT_GT(moving.polarisation, 0.9);
}

TEST(LocalAttraction, MillsAndChainsWithoutRepulsion) {
  const Order mill = open_state("", {{"c", 1}, {"blind", kPi / 2}}), chain = open_state("", {{"c", 1}, {"blind", kPi}});
  EXPECT_NEAR(mill.absolute_rotation, 0.91, 0.08);
  EXPECT_LT(mill.polarisation, 0.2);
  EXPECT_NEAR(chain.polarisation, 0.99, 0.02);
  EXPECT_LT(chain.thinness, 0.05);
}

}  // namespace
}  // namespace swarmfit
