// SPDX-License-Identifier: MIT
// Where agents of a scenario begin.
#include "libswarm/scenario/start.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libswarm/centre.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// A random unit vector: uniform on the sphere, or on the circle in two dimensions (Archimedes' hat-box theorem).
Array3d direction(const std::array<double, 2>& u, int dims) {
  const double angle = 2 * std::numbers::pi * u[0];
  const double z = dims == 3 ? 2 * u[1] - 1 : 0;
  const double radius = std::sqrt(1 - z * z);
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

double quarter_of(const Bounds& bounds, int dims) {
  switch (bounds.kind) {
    case Bounds::Kind::open:
      return 1;
    case Bounds::Kind::sphere:
      return bounds.radius / 2;
    case Bounds::Kind::box:
    case Bounds::Kind::periodic:
      break;
  }
  return (bounds.upper - bounds.lower).head(dims).minCoeff() / 4;
}

// Cells of a grid of at least n cells with sides as equal as it gets.
std::array<Index, 3> cells(const Array3d& sides, Index n, int dims) {
  std::array<Index, 3> count{1, 1, 1};
  const auto total = [&] { return count[0] * count[1] * count[2]; };
  while (total() < n) {
    std::size_t longest = 0;
    for (std::size_t k = 1; k < static_cast<std::size_t>(dims); ++k)
      if (sides[static_cast<Index>(k)] / static_cast<double>(count[k]) >
          sides[static_cast<Index>(longest)] / static_cast<double>(count[longest]) * (1 + 1e-12))
        longest = k;
    ++count[longest];
  }
  return count;
}

Array3d on_grid(const Start& s, Index k, Index n, int dims) {
  const Array3d sides = s.upper - s.lower;
  const auto count = cells(sides, n, dims);
  const std::array<Index, 3> cell{k % count[0], k / count[0] % count[1], k / (count[0] * count[1])};
  Array3d place = s.lower;
  for (Index axis = 0; axis < dims; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    place[axis] += sides[axis] * (static_cast<double>(cell[a]) + 0.5) / static_cast<double>(count[a]);
  }
  return place;
}

Array3d near_points(const Start& s, const Rng& rng, std::uint32_t id, int dims) {
  const auto u = rng.uniform2(Stream::start, 0, id, 1);
  const auto point = static_cast<std::size_t>(rng.uniform(Stream::start, 0, id, 3) * static_cast<double>(s.points.size()));
  return s.points[point] + s.radius * rng.uniform(Stream::start, 0, id, 0) * direction(u, dims);
}

Array3d on_ring(const Start& s, Index k, Index n, int dims) {
  const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
  const double along = s.radius * std::cos(angle), across = s.radius * std::sin(angle);
  return s.centre + (dims == 3 ? Array3d(along, 0, across) : Array3d(along, across, 0));
}

}  // namespace

Start settled(const Start& start, const Bounds& bounds, int dims) {
  Start s = start;
  if (s.shape != Start::Shape::ball || s.radius > 0) return s;
  s.centre = middle_of(bounds);
  s.radius = quarter_of(bounds, dims);
  return s;
}

Beginning beginning(const Start& s, const Rng& rng, std::uint32_t id, Index k, Index n, int dims) {
  Beginning b;
  const auto one = rng.uniform2(Stream::start, 0, id, 1);
  switch (s.shape) {
    case Start::Shape::ball:
      b.pos = s.centre + s.radius * std::pow(rng.uniform(Stream::start, 0, id, 0), 1.0 / dims) * direction(one, dims);
      break;
    case Start::Shape::box:
      b.pos = s.lower + (s.upper - s.lower) * Array3d(one[0], one[1], dims == 3 ? rng.uniform(Stream::start, 0, id, 0) : 0);
      break;
    case Start::Shape::line:
      b.pos = s.lower + (s.upper - s.lower) * (n > 1 ? static_cast<double>(k) / static_cast<double>(n - 1) : 0.5);
      break;
    case Start::Shape::grid:
      b.pos = on_grid(s, k, n, dims);
      break;
    case Start::Shape::curve:
      b.pos = near_points(s, rng, id, dims);
      break;
    case Start::Shape::recorded:
      return {s.points[static_cast<std::size_t>(k)], s.velocities[static_cast<std::size_t>(k)]};
    case Start::Shape::ring:
      b.pos = on_ring(s, k, n, dims);
      break;
  }
  const double length = std::sqrt(s.heading.square().sum());
  const Array3d way = length > 0 ? Array3d(s.heading / length) : direction(rng.uniform2(Stream::start, 0, id, 2), dims);
  b.vel = s.speed * way;
  return b;
}

}  // namespace swarmfit
