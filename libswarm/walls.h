// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "libswarm/world.h"

namespace swarmfit {

class Mesh;

// A solid body that nobody passes through. In two dimensions a sphere is a disc, a box a rectangle, a plane a line; there are neither
// cylinders nor meshes.
struct Obstacle {
  enum class Shape { box, sphere, cylinder, plane, mesh };
  Shape shape = Shape::sphere;
  Eigen::Array3d lower = Eigen::Array3d::Zero(), upper = Eigen::Array3d::Zero();  // box; cylinder: the centres of its ends
  Eigen::Array3d centre = Eigen::Array3d::Zero();                                 // sphere; plane: a point of it
  double radius = 0;                                                              // sphere, cylinder, > 0 [unit]
  Bounds::Wall wall = Bounds::Wall::reflect;
  Eigen::Array3d normal = {1, 0, 0};      // plane: unit vector to the side where agents are; the other side is solid
  std::shared_ptr<const Mesh> mesh = {};  // mesh: its surface, shared by all copies
};

// Of a cylinder.
struct Axis {
  explicit Axis(const Obstacle& cylinder);
  Eigen::Array3d any_normal() const;  // a unit vector across it
  Eigen::Array3d middle, unit;
  double half;  // of its length
};

// All obstacles of a world. After every step each agent is outside all of them and inside the bounds, if it was before, and its path did
// not lead through any, however thin: it bounces off or slides along. Who starts inside one is put at its nearest surface. Who has nowhere
// to go stays, and turns back. Models need not know: those that want to see obstacles ask for this part.
class Walls : public WorldPart {
 public:
  explicit Walls(std::vector<Obstacle> obstacles) : obstacles_(std::move(obstacles)) {}
  std::unique_ptr<WorldPart> clone() const override { return std::make_unique<Walls>(*this); }
  void constrain(const World& world, const State& before, State& after) const override;
  const std::vector<Obstacle>& obstacles() const { return obstacles_; }

  // Is it inside one, farther than rounding reaches?
  bool hold(const Eigen::Array3d& position, int dims) const;

 private:
  std::vector<Obstacle> obstacles_;
};

}  // namespace swarmfit
