// SPDX-License-Identifier: MIT
#include "libswarm/avoidance.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <optional>

#include "libswarm/neighbours.h"
#include "libswarm/noise.h"

namespace swarmfit {
namespace {

using Eigen::Vector3d;

Vector3d draw(std::uint32_t k, std::uint32_t which, int dims) {
  return random_direction(Rng{1}, Stream::probe, which, k, 0, dims).matrix();
}
double uniform(std::uint32_t k, std::uint32_t which) { return Rng{2}.uniform(Stream::probe, which, k); }

// ---- the oracle ---------------------------------------------------------------------------------------------------------------

// The minimum lies on some set of planes and perhaps on the ball: try every set of at most three, keep the best that is allowed.
std::optional<Vector3d> by_enumeration(const std::vector<HalfSpace>& h, const Vector3d& preferred, double speed) {
  std::optional<Vector3d> best;
  const auto consider = [&](const Vector3d& v) {
    if (v.norm() > speed * (1 + 1e-9)) return;
    for (const HalfSpace& one : h)
      if (one.depth(v) > 1e-9 * speed) return;
    if (!best || (v - preferred).norm() < (*best - preferred).norm()) best = v;
  };
  const auto on_ball = [&](const Vector3d& centre, const Vector3d& toward) {  // best point of a circle around centre, in direction toward
    const double r2 = speed * speed - centre.squaredNorm();
    if (r2 >= 0 && toward.norm() > 0) consider(centre + toward.normalized() * std::sqrt(r2));
  };
  const std::size_t n = h.size();
  consider(preferred);
  on_ball(Vector3d::Zero(), preferred);
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3d foot = preferred + h[i].depth(preferred) * h[i].normal, centre = h[i].bound * h[i].normal;
    consider(foot);
    on_ball(centre, foot - centre);
    for (std::size_t j = 0; j < i; ++j) {
      const Vector3d direction = h[i].normal.cross(h[j].normal);
      if (direction.norm() < 1e-9) continue;
      Eigen::Matrix3d a;
      a << h[i].normal.transpose(), h[j].normal.transpose(), direction.transpose();
      const Vector3d nearest = a.partialPivLu().solve(Vector3d(h[i].bound, h[j].bound, direction.dot(preferred)));
      const Vector3d origin = a.partialPivLu().solve(Vector3d(h[i].bound, h[j].bound, 0));
      consider(nearest);
      on_ball(origin, direction);
      on_ball(origin, -direction);
      for (std::size_t k = 0; k < j; ++k) {
        a.row(2) = h[k].normal.transpose();
        if (std::abs(a.determinant()) > 1e-9) consider(a.partialPivLu().solve(Vector3d(h[i].bound, h[j].bound, h[k].bound)));
      }
    }
  }
  return best;
}

struct Problem {
  std::vector<HalfSpace> allowed;
  Vector3d preferred;
};

Problem problem(std::uint32_t seed, int dims) {
  Problem p{{}, 1.6 * uniform(seed, 0) * draw(seed, 1, dims)};
  const auto planes = 1 + static_cast<std::uint32_t>(8 * uniform(seed, 2));
  for (std::uint32_t k = 0; k < planes; ++k) p.allowed.push_back({draw(seed, 10 + k, dims), 0.9 * uniform(seed, 100 + k) - 0.5});
  return p;
}

TEST(NearestVelocity, EqualsEnumerationOfActiveSets) {
  for (const int dims : {2, 3}) {
    int infeasible = 0;
    for (std::uint32_t seed = 0; seed < 3000; ++seed) {
      const Problem p = problem(seed, dims);
      const auto expected = by_enumeration(p.allowed, p.preferred, 1);
      const auto found = nearest_velocity(p.allowed, p.preferred, 1);
      ASSERT_EQ(found.feasible, expected.has_value()) << "seed " << seed;
      if (!expected) {
        ++infeasible;
        continue;
      }
      ASSERT_LT((found.velocity - *expected).norm(), 1e-7) << "seed " << seed;
      if (dims == 2) {
        ASSERT_NEAR(found.velocity.z(), 0, 1e-9);
      }
    }
    EXPECT_GT(infeasible, 100);  // both kinds must have been met
    EXPECT_LT(infeasible, 2900);
  }
}

TEST(NearestVelocity, AloneIsTheClippedPreference) {
  EXPECT_EQ(nearest_velocity({}, {0.3, 0.4, 0}, 1).velocity, Vector3d(0.3, 0.4, 0));
  EXPECT_LT((nearest_velocity({}, {3, 4, 0}, 1).velocity - Vector3d(0.6, 0.8, 0)).norm(), 1e-15);
}

// No step in any of many directions makes the largest depth smaller: the depth is convex, so a local minimum is the minimum.
TEST(LeastPenetration, IsALocalMinimum) {
  std::vector<HalfSpace> scratch;
  int tried = 0;
  for (const int dims : {2, 3})
    for (std::uint32_t seed = 0; seed < 3000; ++seed) {
      const Problem p = problem(seed, dims);
      if (nearest_velocity(p.allowed, p.preferred, 1).feasible) continue;
      ++tried;
      const auto deepest = [&](const Vector3d& v) {
        double depth = -1e9;
        for (const HalfSpace& h : p.allowed) depth = std::max(depth, h.depth(v));
        return depth;
      };
      const Vector3d v = least_penetration(p.allowed, p.preferred, 1, scratch);
      ASSERT_LE(v.norm(), 1 + 1e-9);
      for (std::uint32_t k = 0; k < 200; ++k) {
        Vector3d other = v + 1e-3 * draw(k, 500, dims);
        if (other.norm() > 1) other.normalize();
        ASSERT_GE(deepest(other), deepest(v) - 1e-7) << "seed " << seed;
      }
    }
  EXPECT_GT(tried, 200);
}

// ---- half-spaces --------------------------------------------------------------------------------------------------------------

// Smallest distance of two agents within tau when their relative velocity is `relative`.
double closest(const Vector3d& offset, const Vector3d& relative, double tau) {
  const double speed2 = relative.squaredNorm();
  const double t = speed2 > 0 ? std::clamp(offset.dot(relative) / speed2, 0.0, tau) : 0.0;
  return (offset - t * relative).norm();
}

// If both take half of u, their new relative velocity lies on the edge of the velocity obstacle: they just touch within tau, and not less.
TEST(ReciprocalHalfSpace, HalfTheChangeEachJustAvoidsTheCollision) {
  const double distance = 1, tau = 2;
  for (std::uint32_t k = 0; k < 5000; ++k) {
    const Vector3d offset = (1.1 + 5 * uniform(k, 0)) * draw(k, 1, 3), relative = 3 * uniform(k, 2) * draw(k, 3, 3);
    const HalfSpace h = reciprocal_half_space(offset, Vector3d::Zero(), relative, distance, tau, 0.1, Vector3d::UnitX());
    const Vector3d u = 2 * h.bound * h.normal;
    ASSERT_NEAR(closest(offset, relative + u, tau), distance, 1e-6) << k;
    const bool collides = closest(offset, relative, tau) < distance;
    ASSERT_EQ(h.bound > 0, collides) << k;
    for (std::uint32_t m = 0; m < 20; ++m)  // no smaller change does it
      if (collides) {
        ASSERT_LT(closest(offset, relative + 0.99 * u.norm() * draw(m, 600, 3), tau), distance + 1e-9);
      }
  }
}

TEST(ReciprocalHalfSpace, OverlapEndsWithinOneStep) {
  const Vector3d offset(0.4, 0, 0), relative(1, 0, 0);
  const HalfSpace h = reciprocal_half_space(offset, Vector3d::Zero(), relative, 1, 2, 0.1, Vector3d::UnitX());
  EXPECT_LT((h.normal - Vector3d(-1, 0, 0)).norm(), 1e-12);
  EXPECT_NEAR(offset.x() - 0.1 * (relative.x() - 2 * h.bound), 1, 1e-12);
}

TEST(ReciprocalHalfSpace, SamePlaceAndVelocityPartAlongTheTie) {
  const HalfSpace h = reciprocal_half_space(Vector3d::Zero(), Vector3d(1, 2, 3), Vector3d::Zero(), 1, 2, 0.1, Vector3d::UnitZ());
  EXPECT_EQ(h.normal, Vector3d::UnitZ());
  EXPECT_NEAR(h.bound, 3 + 0.5 * 1 / 0.1, 1e-12);
}

// ---- crowds -------------------------------------------------------------------------------------------------------------------

struct Crowd {
  std::vector<Vector3d> pos, vel, goal;
  double radius, cruise, speed, tau, dt, range;
  int most;
};

// All agents head for their goals with speed `cruise` and may fly at `speed` to avoid others; returns the smallest distance of any two so
// far.
double step(Crowd& crowd) {
  const std::size_t n = crowd.pos.size();
  std::vector<Vector3d> next(n);
  Rows rows(static_cast<Index>(n), 3);
  for (std::size_t i = 0; i < n; ++i) rows.row(static_cast<Index>(i)) = crowd.pos[i].transpose().array();
  Neighbours near;
  near.build(rows, {}, crowd.range);
  Neighbours::Scratch scratch;
  std::vector<HalfSpace> allowed, spare;
  double closest2 = 1e18;
  for (std::size_t i = 0; i < n; ++i) {
    double hint = 0;
    allowed.clear();
    for (const auto& found : near.nearest(static_cast<Index>(i), static_cast<std::size_t>(crowd.most), crowd.range, hint, scratch)) {
      const auto j = static_cast<std::size_t>(near.row(found.slot));
      closest2 = std::min(closest2, found.distance2);
      allowed.push_back(reciprocal_half_space(crowd.pos[j] - crowd.pos[i], crowd.vel[i], crowd.vel[i] - crowd.vel[j], 2 * crowd.radius,
                                              crowd.tau, crowd.dt, Vector3d::UnitX()));
    }
    Vector3d preferred = crowd.goal[i] - crowd.pos[i];
    if (preferred.norm() > crowd.cruise) preferred *= crowd.cruise / preferred.norm();
    const auto result = nearest_velocity(allowed, preferred, crowd.speed);
    next[i] = result.feasible ? result.velocity : least_penetration(allowed, preferred, crowd.speed, spare);
  }
  for (std::size_t i = 0; i < n; ++i) {
    crowd.vel[i] = next[i];
    crowd.pos[i] += crowd.dt * next[i];
  }
  return std::sqrt(closest2);
}

TEST(Crowd, TwoHeadOnPass) {
  for (const int dims : {2, 3}) {
    Crowd crowd{{{-5, 0, 0}, {5, 0.01, dims == 3 ? 0.02 : 0}}, {{0, 0, 0}, {0, 0, 0}}, {{5, 0, 0}, {-5, 0, 0}}, 0.5, 1, 1, 2, 0.05, 10, 10};
    double closest = 1e9;
    for (int k = 0; k < 400; ++k) closest = std::min(closest, step(crowd));
    EXPECT_GT(closest, 1 - 1e-6);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_LT((crowd.pos[i] - crowd.goal[i]).norm(), 0.05);
    if (dims == 2) {
      EXPECT_EQ(crowd.pos[0].z(), 0);
    }
  }
}

// Everybody changes places with the agent opposite, as in the "Sphere" example of RVO2-3D. Its 800 agents all meet in the centre at once,
// where no velocity is free any more: from evenly spread starts RVO2-3D itself (version of 2025, single precision) overlaps by 0.180 there,
// and this code by 0.200. Here fewer agents start at different distances, so that they cross one after the other.
TEST(Crowd, AntipodalSphere) {
  Crowd crowd{{}, {}, {}, 1, 1, 2, 5, 0.125, 15, 10};
  const std::uint32_t n = 100;
  for (std::uint32_t i = 0; i < n; ++i) {  // evenly: a spiral with the golden angle
    const double z = 1 - (2 * i + 1.0) / n, angle = 2.399963229728653 * i, rho = std::sqrt(1 - z * z);
    crowd.pos.push_back((50 + 150 * uniform(i, 0)) * Vector3d(rho * std::cos(angle), rho * std::sin(angle), z));
    crowd.vel.push_back(Vector3d::Zero());
    crowd.goal.push_back(-crowd.pos.back());
  }
  double closest = 1e9, farthest = 0;
  for (int k = 0; k < 3600; ++k) closest = std::min(closest, step(crowd));
  for (std::uint32_t i = 0; i < n; ++i) farthest = std::max(farthest, (crowd.goal[i] - crowd.pos[i]).norm());
  EXPECT_GT(closest, 2 * crowd.radius - 1e-3);
  EXPECT_LT(closest, 2 * crowd.radius + 0.1);  // they did have to give way
  EXPECT_LT(farthest, 0.1);
}

// Four at a time: the same bits as one by one, apart, touching, approaching and parting, in space and in the plane.
TEST(ReciprocalHalfSpaces, EqualOneByOneToTheBit) {
  for (std::uint32_t n = 0; n < 400; ++n) {
    FourNeighbours four[2];
    std::vector<Vector3d> offset, relative;
    const auto number = [n](std::uint32_t k, std::uint32_t draw) { return 2 * Rng{31}.uniform(Stream::probe, n, k, draw) - 1; };
    for (std::uint32_t k = 0; k < 7; ++k) {
      offset.emplace_back(number(k, 0), number(k, 1), n % 2 ? number(k, 2) : 0);
      relative.emplace_back(number(k, 3), number(k, 4), n % 2 ? number(k, 5) : 0);
      for (Index axis = 0; axis < 3; ++axis) {
        four[k / 4].offset[axis][k % 4] = offset[k][axis];
        four[k / 4].relative[axis][k % 4] = relative[k][axis];
      }
    }
    const Vector3d own(number(8, 0), number(8, 1), n % 2 ? number(8, 2) : 0);
    HalfSpace together[7];
    reciprocal_half_spaces(four, 7, own, 0.6, 1.5, 0.1, together);
    for (std::size_t k = 0; k < 7; ++k) {
      const HalfSpace alone = reciprocal_half_space(offset[k], own, relative[k], 0.6, 1.5, 0.1, Vector3d::UnitX());
      ASSERT_EQ(together[k].normal, alone.normal);
      ASSERT_EQ(together[k].bound, alone.bound);
    }
  }
}

}  // namespace
}  // namespace swarmfit
