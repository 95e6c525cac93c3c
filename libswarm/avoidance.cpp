// SPDX-License-Identifier: MIT
#include "libswarm/avoidance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "libtrack/hot.h"

namespace swarmfit {
namespace {

using Eigen::Vector3d;

constexpr double kParallel = 1e-12;   // squared sine of the angle between normals that count as parallel
constexpr double kTolerance = 1e-10;  // of the speed limit: a velocity on a plane may miss it by rounding

// What is sought within the half-spaces and the ball |v| <= speed: the point nearest to `target`, or the farthest along it.
struct Aim {
  Vector3d target;
  bool farthest;
  double speed;

  double tolerance() const { return kTolerance * speed; }
};

// Best point of the disc or ball with this centre and radius, the disc's plane containing target's projection.
Vector3d best_around(const Vector3d& centre, double radius, const Vector3d& projected, bool farthest) {
  const Vector3d out = farthest ? projected : Vector3d(projected - centre);
  const double length = out.norm();
  if (!farthest && length <= radius) return projected;
  return length > 0 ? Vector3d(centre + out * (radius / length)) : centre;
}

// Best point on the line where planes a and b meet, under the half-spaces in `others`.
std::optional<Vector3d> solve_on_line(const HalfSpace& a, const HalfSpace& b, std::span<const HalfSpace> others, const Aim& goal) {
  const Vector3d cross = a.normal.cross(b.normal);
  const double sine2 = cross.squaredNorm();
  if (sine2 < kParallel) return std::nullopt;
  const Vector3d direction = cross / std::sqrt(sine2);
  const Vector3d point = (a.bound * b.normal.cross(cross) + b.bound * cross.cross(a.normal)) / sine2;  // the line's nearest to 0
  const double half2 = goal.speed * goal.speed - point.squaredNorm();
  if (half2 < 0) return std::nullopt;
  double high = std::sqrt(half2), low = -high;
  for (const HalfSpace& h : others) {
    const double slope = h.normal.dot(direction), missing = h.depth(point);  // slope · t >= missing
    if (slope * slope < kParallel) {
      if (missing > goal.tolerance()) return std::nullopt;
    } else if (slope > 0) {
      low = std::max(low, missing / slope);
    } else {
      high = std::min(high, missing / slope);
    }
  }
  if (low > high + goal.tolerance()) return std::nullopt;
  const double along = direction.dot(goal.farthest ? goal.target : Vector3d(goal.target - point));
  const double t = goal.farthest ? (along > 0 ? high : low) : std::clamp(along, std::min(low, high), high);
  return point + t * direction;
}

// Best point on one plane, under the half-spaces in `others`.
std::optional<Vector3d> solve_on_plane(const HalfSpace& plane, std::span<const HalfSpace> others, const Aim& goal) {
  const double disc2 = goal.speed * goal.speed - plane.bound * plane.bound;
  if (disc2 < 0) return std::nullopt;
  const double height = plane.normal.dot(goal.target) - (goal.farthest ? 0 : plane.bound);
  const Vector3d projected = goal.target - height * plane.normal;
  Vector3d v = best_around(plane.bound * plane.normal, std::sqrt(disc2), projected, goal.farthest);
  for (std::size_t k = 0; k < others.size(); ++k) {
    if (others[k].depth(v) <= goal.tolerance()) continue;
    const auto on_line = solve_on_line(plane, others[k], others.first(k), goal);
    if (!on_line) return std::nullopt;
    v = *on_line;
  }
  return v;
}

std::optional<Vector3d> solve(std::span<const HalfSpace> allowed, const Aim& goal) {
  Vector3d v = best_around(Vector3d::Zero(), goal.speed, goal.target, goal.farthest);
  for (std::size_t k = 0; k < allowed.size(); ++k) {
    if (allowed[k].depth(v) <= goal.tolerance()) continue;
    const auto on_plane = solve_on_plane(allowed[k], allowed.first(k), goal);
    if (!on_plane) return std::nullopt;
    v = *on_plane;
  }
  return v;
}

// ---- four half-spaces at once; operation by operation reciprocal_half_space -----------------------------------------

// No arrays of lanes: GCC 12 keeps those in memory.
struct Lanes3 {
  Lanes x, y, z;
};

inline __attribute__((always_inline)) void load3(const double (&from)[3][4], Lanes3& to) {
  load(from[0], to.x), load(from[1], to.y), load(from[2], to.z);
}

inline __attribute__((always_inline)) void dot(const Lanes3& a, const Lanes3& b, Lanes& out) { out = (a.x * b.x + a.y * b.y) + a.z * b.z; }

inline __attribute__((always_inline)) void root(const Lanes& a, Lanes& out) {
  for (int l = 0; l < 4; ++l) out[l] = std::sqrt(a[l]);
}

struct FourHalfSpaces {
  Lanes normal[3], bound;
};

struct Encounter {
  double velocity[3], distance, tau, dt;
};

SWARMFIT_HOT void four_half_spaces(const FourNeighbours& four, const Encounter& e, FourHalfSpaces& out) {
  Lanes3 o, r;
  load3(four.offset, o), load3(four.relative, r);
  const Lanes zero{}, one = zero + 1;
  const double touch2 = e.distance * e.distance;
  Lanes apart2, side, w2, b, speed2, cross2, sqrt, length;
  dot(o, o, apart2);
  const LaneMask touching = apart2 <= touch2;
  const Lanes rate = touching ? zero + 1 / e.dt : zero + 1 / e.tau;
  Lanes3 w{r.x - o.x * rate, r.y - o.y * rate, r.z - o.z * rate};
  dot(w, o, side);
  dot(w, w, w2);
  const LaneMask cone = ~touching & ~((side < 0) & (side * side > touch2 * w2));
  const Lanes3 cross{o.y * r.z - o.z * r.y, o.z * r.x - o.x * r.z, o.x * r.y - o.y * r.x};
  dot(o, r, b);
  dot(r, r, speed2);
  dot(cross, cross, cross2);
  const Lanes c = speed2 - cross2 / (apart2 - touch2), under = b * b - apart2 * c;
  root(under > 0 ? under : zero, sqrt);
  const Lanes t = (b + sqrt) / apart2;
  const Lanes cut = cone ? t * e.distance : e.distance * rate;
  w.x = cone ? r.x - t * o.x : w.x;
  w.y = cone ? r.y - t * o.y : w.y;
  w.z = cone ? r.z - t * o.z : w.z;
  dot(w, w, w2);
  root(w2, length);
  const Lanes per_length = 1 / length;
  const Lanes3 normal{length > 0 ? w.x * per_length : one, length > 0 ? w.y * per_length : zero, length > 0 ? w.z * per_length : zero};
  out.normal[0] = normal.x, out.normal[1] = normal.y, out.normal[2] = normal.z;
  dot(normal, {zero + e.velocity[0], zero + e.velocity[1], zero + e.velocity[2]}, out.bound);
  out.bound += 0.5 * (cut - length);
}

}  // namespace

void reciprocal_half_spaces(const FourNeighbours* neighbours, std::size_t n, const Vector3d& velocity, double distance, double tau,
                            double dt, HalfSpace* out) {
  const Encounter encounter{{velocity[0], velocity[1], velocity[2]}, distance, tau, dt};
  FourHalfSpaces h;
  for (std::size_t k = 0; k < n; ++k) {
    const auto l = k % 4;
    if (l == 0) four_half_spaces(neighbours[k / 4], encounter, h);
    out[k] = {{h.normal[0][l], h.normal[1][l], h.normal[2][l]}, h.bound[l]};
  }
}

HalfSpace reciprocal_half_space(const Vector3d& offset, const Vector3d& velocity, const Vector3d& relative, double distance, double tau,
                                double dt, const Vector3d& tie) {
  const double apart2 = offset.squaredNorm(), touch2 = distance * distance;
  const bool touching = apart2 <= touch2;
  const double rate = touching ? 1 / dt : 1 / tau;
  Vector3d w = relative - offset * rate;  // from the centre of the cone's cap to the relative velocity
  const double side = w.dot(offset);
  double cut = distance * rate;  // radius of the ball at whose surface the pair just touches
  if (!touching && !(side < 0 && side * side > touch2 * w.squaredNorm())) {
    // The cone beyond the cap: of all its balls t · offset with radius t · distance the one whose surface is nearest.
    const double b = offset.dot(relative);
    const double c = relative.squaredNorm() - offset.cross(relative).squaredNorm() / (apart2 - touch2);
    const double t = (b + std::sqrt(std::max(0.0, b * b - apart2 * c))) / apart2;
    w = relative - t * offset;
    cut = t * distance;
  }
  const double length = w.norm();
  const Vector3d normal = length > 0 ? Vector3d(w * (1 / length)) : tie;
  return {normal, normal.dot(velocity) + 0.5 * (cut - length)};
}

Avoidance nearest_velocity(std::span<const HalfSpace> allowed, const Vector3d& preferred, double max_speed) {
  const auto v = solve(allowed, {preferred, false, max_speed});
  return {v.value_or(Vector3d::Zero()), v.has_value()};
}

// Van den Berg et al., section 5.3: half-space k bounds the depth from below; where it is the deepest, go as far along its normal as the
// others, being no deeper than k, allow.
Vector3d least_penetration(std::span<const HalfSpace> allowed, const Vector3d& preferred, double max_speed,
                           std::vector<HalfSpace>& no_deeper) {
  Vector3d v = best_around(Vector3d::Zero(), max_speed, preferred, false);
  double deepest = 0;
  for (std::size_t k = 0; k < allowed.size(); ++k) {
    if (allowed[k].depth(v) <= deepest + kTolerance * max_speed) continue;
    no_deeper.clear();
    for (const HalfSpace& other : allowed.first(k)) {
      const Vector3d difference = other.normal - allowed[k].normal;
      const double length = difference.norm();
      if (length * length > kParallel) no_deeper.push_back({difference / length, (other.bound - allowed[k].bound) / length});
    }
    if (const auto better = solve(no_deeper, {allowed[k].normal, true, max_speed})) v = *better;
    deepest = std::max(deepest, allowed[k].depth(v));
  }
  return v;
}

}  // namespace swarmfit
