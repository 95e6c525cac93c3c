// SPDX-License-Identifier: MIT
#include "libswarm/flock_sums.h"

#include <gtest/gtest.h>

#include <cmath>

#include "libtrack/rng.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

Rows drawn(Index n, double from, double to, Stream stream) {
  Rows out(n, 3);
  for (Index i = 0; i < n; ++i)
    for (Index axis = 0; axis < 3; ++axis)
      out(i, axis) = from + (to - from) * Rng{7}.uniform(stream, static_cast<std::uint64_t>(axis), static_cast<std::uint32_t>(i));
  return out;
}

// Every pair by itself, as the rules are printed.
FlockSums by_pairs(const Rows& pos, const Rows& vel, const Bounds& bounds, Index i, double inner, double outer) {
  FlockSums out{Array3d::Zero(), Array3d::Zero(), Array3d::Zero()};
  for (Index j = 0; j < pos.rows(); ++j) {
    if (j == i) continue;
    const Array3d offset = bounds.separation(pos.row(i).transpose(), pos.row(j).transpose());
    const double distance = std::sqrt(offset.square().sum());
    if (distance > 0 && distance < inner) out.separation -= offset / (distance * distance);
    if (distance >= outer) continue;
    out.alignment += (vel.row(j) - vel.row(i)).transpose();
    out.cohesion += offset;
  }
  return out;
}

void expect_near(const Array3d& a, const Array3d& b) {
  for (Index axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], 1e-11 * (1 + std::abs(b[axis])));
}

void expect_sums_of_pairs(Index n, const Bounds& bounds) {
  Rows pos = drawn(n, 0, 10, Stream::start);
  const Rows vel = drawn(n, -1, 1, Stream::noise);
  if (n > 3) pos.row(3) = pos.row(0);  // two at one place: no direction apart
  Neighbours near;
  near.build(pos, bounds, 3);
  SlotVelocities velocities;
  velocities.take(near, vel);
  for (Index i = 0; i < n; ++i) {
    const FlockSums sums = flock_sums(near, velocities, i, 1.5, 3), pairs = by_pairs(pos, vel, bounds, i, 1.5, 3);
    expect_near(sums.separation, pairs.separation);
    expect_near(sums.alignment, pairs.alignment);
    expect_near(sums.cohesion, pairs.cohesion);
  }
}

TEST(FlockSums, AreThoseOfAllPairs) {
  for (const Index n : {1, 2, 4, 7, 50, 600}) expect_sums_of_pairs(n, {});
}

TEST(FlockSums, InAPeriodicBoxToo) {
  Bounds box;
  box.kind = Bounds::Kind::periodic;
  box.lower = Array3d::Zero();
  box.upper = Array3d::Constant(10);
  for (const Index n : {5, 50, 600}) expect_sums_of_pairs(n, box);
}

}  // namespace
}  // namespace swarmfit
