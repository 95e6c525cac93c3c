// SPDX-License-Identifier: MIT
// Where to go: the cheapest way to a goal, round obstacles. X. Wang, X. Jin, Z. Deng, L. Zhou, Inherent noise-aware insect swarm
// simulation, Computer Graphics Forum 33(6), 2014 (doi:10.1111/cgf.12277), Eqs 4, 6 and 7.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "libswarm/cost_field.h"
#include "libswarm/stimuli.h"
#include "libswarm/walls.h"

namespace swarmfit {

// A ball that agents head for; they are there anywhere in it.
struct Goal {
  Eigen::Array3d centre = Eigen::Array3d::Zero();
  double radius = 1;                     // > 0 [unit]
  std::vector<Stimulus::Key> path = {};  // of the centre, straight from key to key; empty: it stays
  Eigen::Array3d at(double t) const;
};

// The cost of a way is the integral of A + B g along it, g being the repulsion of obstacles (Eq 6). Cells in obstacles are impassable.
struct PathOptions {
  FieldGrid grid;
  double length_weight = 0.6, repulsion_weight = 0.4;  // A > 0, B >= 0
  double reach = 0;                                    // of the repulsion [unit]; 0: 2 sqrt(2) cells
};

// All goals of a world, and the way to the cheapest. Found again when a goal has moved by a cell.
class Paths : public WorldPart {
 public:
  // `shift` is added to the clock's time to get that of the goals [s].
  Paths(PathOptions options, std::vector<Goal> goals, std::vector<Obstacle> obstacles, double shift = 0);
  std::unique_ptr<WorldPart> clone() const override { return std::make_unique<Paths>(*this); }
  void advance(const Clock& clock, const World& world, State&) override;

  Eigen::Array3d direction(const Eigen::Array3d& place) const { return field_->direction(place); }  // 0 at a goal
  const CostField& field() const { return *field_; }
  double cell() const { return options_.grid.cell; }
  double reach() const { return options_.reach; }                // of the repulsion [unit]
  bool holds(std::size_t k, const Eigen::Array3d& place) const;  // is it in goal k?
  std::size_t size() const { return goals_.size(); }
  const Eigen::Array3d& place(std::size_t k) const { return places_[k]; }

 private:
  void find(int dims);

  PathOptions options_;
  std::vector<Goal> goals_;
  std::vector<Obstacle> obstacles_;
  double shift_;
  std::vector<Eigen::Array3d> places_, marched_;  // of the goals now, and when the field was found
  std::shared_ptr<const CostField> field_;        // shared by copies until a goal moves
};

}  // namespace swarmfit
