// SPDX-License-Identifier: MIT
#include "libswarm/walls.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libswarm/distance_field.h"
#include "libswarm/mesh.h"
#include "libtrack/vectors.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

constexpr int kMostBounces = 8;  // in one step
constexpr double kSkin = 1e-9;   // of the radius: as deep as rounding may put somebody who is at the surface

// Where a path meets a surface: the share of the path before it, the place, and the unit vector out of the obstacle.
struct Hit {
  double share = std::numeric_limits<double>::infinity();
  Array3d place, outward;
  Bounds::Wall wall{};
};

Array3d from_centre(const Obstacle& o, const Array3d& p, int dims) {
  Array3d r = p - o.centre;
  if (dims == 2) r[2] = 0;
  return r;
}

bool inside(const Obstacle& o, const Array3d& p, int dims) {
  if (o.shape == Obstacle::Shape::mesh) return o.mesh->inside(p);
  if (o.shape == Obstacle::Shape::sphere) {
    const Array3d r = from_centre(o, p, dims);
    const double radius = o.radius * (1 - kSkin);
    return dot(r, r) < radius * radius;
  }
  if (o.shape == Obstacle::Shape::cylinder) return surface_of(o, p, dims).distance < -kSkin * o.radius;
  if (o.shape == Obstacle::Shape::plane) {
    const Array3d r = p - o.centre;
    return dot(r, o.normal) < -kSkin * std::max(1.0, std::sqrt(dot(r, r)));
  }
  bool within = true;
  for (Index axis = 0; axis < dims; ++axis) within = within && o.lower[axis] < p[axis] && p[axis] < o.upper[axis];
  return within;
}

// The nearest point of the surface; from the very centre of a sphere that along x.
Array3d put_out(const Obstacle& o, const Array3d& p, int dims) {
  Array3d out = p;
  if (o.shape == Obstacle::Shape::sphere) {
    const Array3d r = from_centre(o, p, dims);
    const double distance = std::sqrt(dot(r, r));
    const Array3d direction = distance > 0 ? Array3d(r / distance) : Array3d(1, 0, 0);
    for (Index axis = 0; axis < dims; ++axis) out[axis] = o.centre[axis] + o.radius * direction[axis];
    return out;
  }
  if (o.shape == Obstacle::Shape::mesh) {
    const Mesh::Near near = o.mesh->nearest(p);
    return near.place + o.mesh->skin() * near.outward;
  }
  if (o.shape != Obstacle::Shape::box) {
    const Surface s = surface_of(o, p, dims);
    return p - s.distance * s.outward;
  }
  Index axis = 0;
  double least = std::numeric_limits<double>::infinity(), face = 0;
  for (Index k = 0; k < dims; ++k)
    for (const double at : {o.lower[k], o.upper[k]})
      if (std::abs(p[k] - at) < least) least = std::abs(p[k] - at), axis = k, face = at;
  out[axis] = face;
  return out;
}

Hit meet_sphere(const Obstacle& o, const Array3d& start, const Array3d& way, int dims) {
  const Array3d r = from_centre(o, start, dims);
  Array3d d = way;
  if (dims == 2) d[2] = 0;
  const double length2 = dot(d, d), along = dot(r, d), disc = along * along - length2 * (dot(r, r) - o.radius * o.radius);
  if (!(along < 0) || !(disc > 0)) return {};  // away from it, or past it
  Hit hit;
  hit.share = std::max(0.0, (-along - std::sqrt(disc)) / length2);
  hit.place = put_out(o, start + hit.share * way, dims);
  hit.outward = from_centre(o, hit.place, dims) / o.radius;
  return hit;
}

Hit meet_box(const Obstacle& o, const Array3d& start, const Array3d& way, int dims) {
  double enters = -std::numeric_limits<double>::infinity(), leaves = -enters, face = 0;
  Index through = 0;
  for (Index k = 0; k < dims; ++k) {
    if (way[k] == 0) {
      if (start[k] <= o.lower[k] || start[k] >= o.upper[k]) return {};
      continue;
    }
    const double front = way[k] > 0 ? o.lower[k] : o.upper[k], back = way[k] > 0 ? o.upper[k] : o.lower[k];
    if (const double share = (front - start[k]) / way[k]; share > enters) enters = share, through = k, face = front;
    leaves = std::min(leaves, (back - start[k]) / way[k]);
  }
  if (enters < 0 || enters >= leaves) return {};
  Hit hit;
  hit.share = enters;
  hit.place = start + enters * way;
  hit.place[through] = face;
  hit.outward.setZero();
  hit.outward[through] = way[through] > 0 ? -1 : 1;
  return hit;
}

Hit meet_plane(const Obstacle& o, const Array3d& start, const Array3d& way) {
  const double above = dot(start - o.centre, o.normal), towards = -dot(way, o.normal);
  if (!(towards > 0)) return {};
  Hit hit;
  hit.share = std::max(0.0, above) / towards;
  hit.place = start + hit.share * way;
  hit.place -= dot(hit.place - o.centre, o.normal) * o.normal;
  hit.outward = o.normal;
  return hit;
}

Hit meet_side(const Obstacle& o, const Axis& axis, const Array3d& start, const Array3d& way) {
  const Array3d r = start - axis.middle, across = r - dot(r, axis.unit) * axis.unit, d = way - dot(way, axis.unit) * axis.unit;
  const double length2 = dot(d, d), along = dot(across, d), disc = along * along - length2 * (dot(across, across) - o.radius * o.radius);
  if (!(along < 0) || !(disc > 0)) return {};
  Hit hit;
  hit.share = std::max(0.0, (-along - std::sqrt(disc)) / length2);
  const Array3d there = r + hit.share * way;
  const double height = dot(there, axis.unit);
  if (std::abs(height) > axis.half) return {};
  hit.outward = there - height * axis.unit;
  hit.outward /= std::sqrt(dot(hit.outward, hit.outward));
  if (dot(across, across) < o.radius * o.radius * (1 - kSkin)) return {};  // above or below it: the end is met first
  hit.place = axis.middle + height * axis.unit + o.radius * hit.outward;
  return hit;
}

Hit meet_end(const Obstacle& o, const Axis& axis, const Array3d& start, const Array3d& way) {
  const Array3d r = start - axis.middle;
  const double height = dot(r, axis.unit), side = height < 0 ? -1 : 1, above = side * height - axis.half;
  const double towards = -side * dot(way, axis.unit);
  if (!(towards > 0) || above < -kSkin * o.radius) return {};
  Hit hit;
  hit.share = std::max(0.0, above) / towards;
  const Array3d there = r + hit.share * way, across = there - dot(there, axis.unit) * axis.unit;
  if (dot(across, across) >= o.radius * o.radius) return {};
  hit.place = axis.middle + across + side * axis.half * axis.unit;
  hit.outward = side * axis.unit;
  return hit;
}

Hit meet_cylinder(const Obstacle& o, const Array3d& start, const Array3d& way) {
  const Axis axis(o);
  const Hit side = meet_side(o, axis, start, way), end = meet_end(o, axis, start, way);
  return side.share < end.share ? side : end;
}

Hit meet_mesh(const Obstacle& o, const Array3d& start, const Array3d& way) {
  const auto met = o.mesh->first_hit(start, way);
  return met ? Hit{met->share, met->place, met->outward} : Hit{};
}

Hit meet(const Obstacle& o, const Array3d& start, const Array3d& way, int dims) {
  switch (o.shape) {
    case Obstacle::Shape::sphere:
      return meet_sphere(o, start, way, dims);
    case Obstacle::Shape::box:
      return meet_box(o, start, way, dims);
    case Obstacle::Shape::cylinder:
      return meet_cylinder(o, start, way);
    case Obstacle::Shape::mesh:
      return meet_mesh(o, start, way);
    case Obstacle::Shape::plane:
      break;
  }
  return meet_plane(o, start, way);
}

Hit first_hit(const std::vector<Obstacle>& obstacles, const Array3d& start, const Array3d& way, int dims) {
  Hit first;
  for (const Obstacle& o : obstacles) {
    Hit hit = meet(o, start, way, dims);
    hit.wall = o.wall;
    if (hit.share <= 1 && hit.share < first.share) first = hit;
  }
  return first;
}

// Takes the part that points inwards away, once (slip) or twice (reflect).
void turn(Array3d& a, const Hit& hit) {
  const double inward = dot(a, hit.outward);
  if (inward < 0) a -= (hit.wall == Bounds::Wall::reflect ? 2 : 1) * inward * hit.outward;
}

}  // namespace

Axis::Axis(const Obstacle& cylinder) : middle(0.5 * (cylinder.lower + cylinder.upper)), unit(cylinder.upper - cylinder.lower) {
  const double length = std::sqrt(dot(unit, unit));
  half = 0.5 * length;
  unit /= length;
}

Array3d Axis::any_normal() const {
  Index least = 0;
  for (Index k = 1; k < 3; ++k)
    if (std::abs(unit[k]) < std::abs(unit[least])) least = k;
  Array3d across = -unit[least] * unit;
  across[least] += 1;
  return across / std::sqrt(dot(across, across));
}

bool Walls::hold(const Array3d& position, int dims) const {
  return std::any_of(obstacles_.begin(), obstacles_.end(), [&](const Obstacle& o) { return inside(o, position, dims); });
}

void Walls::constrain(const World& world, const State& before, State& after) const {
  const int dims = world.dims;
  for (Index i = 0; i < after.size(); ++i) {
    Array3d start = before.pos.row(i).transpose();
    Array3d way = world.bounds.separation(start, after.pos.row(i).transpose()), v = after.vel.row(i).transpose();
    bool moved = false;
    for (const Obstacle& o : obstacles_)
      if (inside(o, start, dims)) start = put_out(o, start, dims), moved = true;
    const Array3d last_good = start;
    for (int bounce = 0; bounce <= kMostBounces; ++bounce) {
      const Hit hit = first_hit(obstacles_, start, way, dims);
      if (hit.share > 1) break;
      moved = true;
      start = hit.place;
      way *= bounce < kMostBounces ? 1 - hit.share : 0;
      turn(way, hit);
      turn(v, hit);
    }
    if (moved) {
      after.pos.row(i) = (start + way).transpose();
      after.vel.row(i) = v.transpose();
      world.bounds.confine(after, dims, i);
    }
    if (!hold(after.pos.row(i).transpose(), dims)) continue;
    after.pos.row(i) = last_good.transpose();
    after.vel.row(i) = -v.transpose();
  }
}

}  // namespace swarmfit
