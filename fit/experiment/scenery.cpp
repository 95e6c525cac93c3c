// SPDX-License-Identifier: MIT
#include "fit/experiment/scenery.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "libswarm/mesh.h"
#include "libswarm/scenario/scenario.h"
#include "libtrack/vectors.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using Box = Scenery::Box;
using Solid = Scenery::Solid;

constexpr int kRound = 24;             // corners of a drawn circle
constexpr double kRoomForArena = 1.6;  // an arena that is wider than this many times what is in it would hide it
constexpr double kStrip = 0.04;        // thickness of a drawn line, of the diagonal of the picture

Box nothing() {
  return {Array3d::Constant(std::numeric_limits<double>::infinity()), Array3d::Constant(-std::numeric_limits<double>::infinity())};
}

void hold(Box& box, const Array3d& place, double margin = 0) {
  box.lower = box.lower.min(place - margin);
  box.upper = box.upper.max(place + margin);
}

void hold(Box& box, const Tracks& tracks) {
  for (Index row = 0; row < tracks.rows(); ++row) hold(box, tracks.pos().row(row).transpose());
}

Solid box_solid(const Array3d& lower, const Array3d& upper, int dims) {
  Solid solid;
  if (dims == 2) {
    solid.corners = {{lower[0], lower[1], 0}, {upper[0], lower[1], 0}, {upper[0], upper[1], 0}, {lower[0], upper[1], 0}};
    solid.faces = {{0, 1, 2, 3}};
    return solid;
  }
  for (int corner = 0; corner < 8; ++corner)
    solid.corners.emplace_back((corner & 1) != 0 ? upper[0] : lower[0], (corner & 2) != 0 ? upper[1] : lower[1],
                               (corner & 4) != 0 ? upper[2] : lower[2]);
  solid.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return solid;
}

Solid cylinder_solid(const Obstacle& o) {
  const Axis axis(o);
  const Array3d u = axis.any_normal(), v = cross(axis.unit, u);
  Solid solid;
  std::vector<int> bottom, top;
  for (int k = 0; k < kRound; ++k) {
    const double angle = 2 * std::numbers::pi * k / kRound;
    const Array3d out = o.radius * (std::cos(angle) * u + std::sin(angle) * v);
    solid.corners.push_back(o.lower + out);
    solid.corners.push_back(o.upper + out);
    const int next = (k + 1) % kRound;
    solid.faces.push_back({2 * k, 2 * next, 2 * next + 1, 2 * k + 1});
    bottom.insert(bottom.begin(), 2 * k);
    top.push_back(2 * k + 1);
  }
  solid.faces.push_back(bottom);
  solid.faces.push_back(top);
  return solid;
}

Solid disc_solid(const Scenery::Ball& ball) {
  Solid solid;
  solid.faces.emplace_back();
  for (int k = 0; k < kRound; ++k) {
    const double angle = 2 * std::numbers::pi * k / kRound;
    solid.corners.emplace_back(ball.centre + ball.radius * Array3d(std::cos(angle), std::sin(angle), 0));
    solid.faces.back().push_back(k);
  }
  return solid;
}

// Rings of latitude between two poles.
Solid ball_solid(const Scenery::Ball& ball) {
  constexpr int kRings = kRound / 2 - 1;
  Solid solid;
  for (int ring = 1; ring <= kRings; ++ring)
    for (int k = 0; k < kRound; ++k) {
      const double polar = std::numbers::pi * ring / (kRings + 1), angle = 2 * std::numbers::pi * k / kRound;
      solid.corners.emplace_back(
          ball.centre + ball.radius * Array3d(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar)));
    }
  const int north = static_cast<int>(solid.corners.size()), south = north + 1;
  solid.corners.emplace_back(ball.centre + Array3d(0, 0, ball.radius));
  solid.corners.emplace_back(ball.centre - Array3d(0, 0, ball.radius));
  for (int k = 0; k < kRound; ++k) {
    const int next = (k + 1) % kRound, last = (kRings - 1) * kRound;
    solid.faces.push_back({north, k, next});
    solid.faces.push_back({south, last + next, last + k});
    for (int ring = 0; ring + 1 < kRings; ++ring)
      solid.faces.push_back({ring * kRound + k, (ring + 1) * kRound + k, (ring + 1) * kRound + next, ring * kRound + next});
  }
  return solid;
}

Solid mesh_solid(const Mesh& mesh) {
  Solid solid{mesh.corners(), {}};
  for (const Triangle& t : mesh.triangles())
    solid.faces.push_back({static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2])});
  return solid;
}

// A square about the foot of the box's middle, or in two dimensions a strip of the solid side.
Solid plane_solid(const Obstacle& o, const Box& box, int dims) {
  const Array3d middle = 0.5 * (box.lower + box.upper), across = box.upper - box.lower;
  const double half = 0.5 * std::sqrt((across * across).head(dims).sum());
  const Array3d foot = middle - ((middle - o.centre) * o.normal).head(dims).sum() * o.normal;
  Solid solid;
  if (dims == 2) {
    const Array3d along = half * Array3d(-o.normal[1], o.normal[0], 0), into = -2 * kStrip * half * o.normal;
    solid.corners = {foot - along, foot + along, foot + along + into, foot - along + into};
    solid.faces = {{0, 1, 2, 3}};
    return solid;
  }
  Obstacle axle;
  axle.lower = foot;
  axle.upper = foot + o.normal;
  const Array3d u = half * Axis(axle).any_normal(), v = cross(o.normal, u);
  solid.corners = {foot - u - v, foot + u - v, foot + u + v, foot - u + v};
  solid.faces = {{0, 1, 2, 3}, {3, 2, 1, 0}};
  return solid;
}

// Everything but planes, which have no end.
void add_body(Scenery& scenery, Box& box, const Obstacle& o, const Bounds& bounds, int dims) {
  const bool cut = bounds.kind == Bounds::Kind::box || bounds.kind == Bounds::Kind::periodic;
  switch (o.shape) {
    case Obstacle::Shape::sphere:
      scenery.balls.push_back({o.centre, o.radius});
      hold(box, o.centre, o.radius);
      return;
    case Obstacle::Shape::box: {
      const Array3d lower = cut ? Array3d(o.lower.max(bounds.lower)) : o.lower, upper = cut ? Array3d(o.upper.min(bounds.upper)) : o.upper;
      if ((lower.head(dims) >= upper.head(dims)).any()) return;
      scenery.solids.push_back(box_solid(lower, upper, dims));
      break;
    }
    case Obstacle::Shape::cylinder:
      scenery.solids.push_back(cylinder_solid(o));
      break;
    case Obstacle::Shape::mesh:
      scenery.solids.push_back(mesh_solid(*o.mesh));
      break;
    case Obstacle::Shape::plane:
      return;
  }
  for (const Array3d& corner : scenery.solids.back().corners) hold(box, corner);
}

void add_arena(Scenery& scenery, Box& box, const Bounds& bounds, int dims) {
  if (bounds.kind == Bounds::Kind::open) return;
  const bool sphere = bounds.kind == Bounds::Kind::sphere;
  const Array3d lower = sphere ? Array3d(bounds.centre - bounds.radius) : bounds.lower;
  const Array3d upper = sphere ? Array3d(bounds.centre + bounds.radius) : bounds.upper;
  const Array3d have = box.upper - box.lower, all = upper - lower;
  if (!(all.head(dims).maxCoeff() <= kRoomForArena * have.head(dims).maxCoeff())) return;
  if (sphere) scenery.round_arena = Scenery::Ball{bounds.centre, bounds.radius};
  hold(box, lower);
  hold(box, upper);
}

void finish(Scenery& scenery, Box box, const Bounds& bounds, const std::vector<Obstacle>& obstacles, int dims) {
  for (const Obstacle& o : obstacles) add_body(scenery, box, o, bounds, dims);
  add_arena(scenery, box, bounds, dims);
  for (const Obstacle& o : obstacles)
    if (o.shape == Obstacle::Shape::plane && box.lower[0] <= box.upper[0]) scenery.solids.push_back(plane_solid(o, box, dims));
  if (dims == 2) box.lower[2] = box.upper[2] = 0;
  if (box.lower[0] <= box.upper[0]) scenery.box = box;
}

}  // namespace

Scenery scenery_of(const Scenario& scene, const Film& made) {
  Scenery scenery;
  Box box = nothing();
  hold(box, made.tracks);
  for (const Stimulus& s : scene.stimuli)
    scenery.marks.push_back({s.kind == Stimulus::Kind::attract ? Scenery::Mark::Kind::attract : Scenery::Mark::Kind::repel,
                             s.motion == Stimulus::Motion::ring ? s.radius : 0});
  for (const Goal& g : scene.goals) scenery.marks.push_back({Scenery::Mark::Kind::goal, g.radius});
  if (made.stimuli.rows() > 0) {
    scenery.seen = made.stimuli;
    hold(box, made.stimuli);
  }
  finish(scenery, box, scene.bounds, scene.obstacles, scene.dims);
  return scenery;
}

Scenery scenery_of(const Bounds& bounds, const std::vector<Obstacle>& obstacles, const Tracks& tracks) {
  Scenery scenery;
  Box box = nothing();
  hold(box, tracks);
  finish(scenery, box, bounds, obstacles, tracks.dims());
  return scenery;
}

std::vector<Polyhedron> bodies_of(const Scenery& scenery, int dims) {
  std::vector<Polyhedron> bodies = scenery.solids;
  for (const Scenery::Ball& ball : scenery.balls) bodies.push_back(dims == 2 ? disc_solid(ball) : ball_solid(ball));
  return bodies;
}

}  // namespace swarmfit
