// SPDX-License-Identifier: MIT
#include "libswarm/distance_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libswarm/mesh.h"
#include "libtrack/vectors.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

Surface of_sphere(const Obstacle& o, const Array3d& p, int dims) {
  Array3d r = p - o.centre;
  if (dims == 2) r[2] = 0;
  const double d = std::sqrt(dot(r, r));
  return {d - o.radius, d > 0 ? Array3d(r / d) : Array3d(1, 0, 0)};
}

Surface of_box(const Obstacle& o, const Array3d& p, int dims) {
  double outside2 = 0, deepest = -std::numeric_limits<double>::infinity();
  Index nearest = 0;
  Array3d beyond = Array3d::Zero();
  for (Index k = 0; k < dims; ++k) {
    const double middle = 0.5 * (o.lower[k] + o.upper[k]), excess = std::abs(p[k] - middle) - 0.5 * (o.upper[k] - o.lower[k]);
    if (excess > 0) beyond[k] = p[k] < middle ? -excess : excess;
    outside2 += beyond[k] * beyond[k];
    if (excess > deepest) deepest = excess, nearest = k;
  }
  if (outside2 > 0) return {std::sqrt(outside2), beyond / std::sqrt(outside2)};
  Array3d outward = Array3d::Zero();
  outward[nearest] = p[nearest] < 0.5 * (o.lower[nearest] + o.upper[nearest]) ? -1 : 1;
  return {deepest, outward};
}

Surface of_cylinder(const Obstacle& o, const Array3d& p) {
  const Axis axis(o);
  const Array3d r = p - axis.middle;
  const double along = dot(r, axis.unit);
  const Array3d across = r - along * axis.unit;
  const double far = std::sqrt(dot(across, across)), beside = far - o.radius, above = std::abs(along) - axis.half;
  const Array3d sideways = far > 0 ? Array3d(across / far) : axis.any_normal();
  const Array3d upwards = along < 0 ? Array3d(-axis.unit) : axis.unit;
  if (beside > 0 && above > 0) {
    const double d = std::sqrt(beside * beside + above * above);
    return {d, (beside * sideways + above * upwards) / d};
  }
  return beside > above ? Surface{beside, sideways} : Surface{above, upwards};
}

}  // namespace

Surface surface_of(const Obstacle& obstacle, const Array3d& place, int dims) {
  switch (obstacle.shape) {
    case Obstacle::Shape::sphere:
      return of_sphere(obstacle, place, dims);
    case Obstacle::Shape::box:
      return of_box(obstacle, place, dims);
    case Obstacle::Shape::cylinder:
      return of_cylinder(obstacle, place);
    case Obstacle::Shape::mesh: {
      const Mesh::Near near = obstacle.mesh->nearest(place);
      return {near.distance, near.outward};
    }
    case Obstacle::Shape::plane:
      break;
  }
  return {dot(place - obstacle.centre, obstacle.normal), obstacle.normal};
}

Surface nearest_surface(const std::vector<Obstacle>& obstacles, const Array3d& place, int dims, double within) {
  Surface nearest{std::numeric_limits<double>::infinity(), Array3d::Zero()};
  for (const Obstacle& o : obstacles) {
    if (o.shape == Obstacle::Shape::mesh && o.mesh->clearance(place) > std::min(within, nearest.distance)) continue;
    if (const Surface s = surface_of(o, place, dims); s.distance < nearest.distance) nearest = s;
  }
  return nearest;
}

double repulsion(double distance, double reach) {
  const double r = std::clamp(distance / reach, 0.0, 1.0), r2 = r * r;
  return 1 - r2 * (22 - r2 * (17 - 4 * r2)) / 9;
}

}  // namespace swarmfit
