// SPDX-License-Identifier: MIT
#include "libswarm/paths.h"

#include <cmath>
#include <limits>

#include "libswarm/distance_field.h"

namespace swarmfit {

using Eigen::Array3d;

Array3d Goal::at(double t) const { return path.empty() ? centre : on_path(path, t); }

Paths::Paths(PathOptions options, std::vector<Goal> goals, std::vector<Obstacle> obstacles, double shift)
    : options_(std::move(options)), goals_(std::move(goals)), obstacles_(std::move(obstacles)), shift_(shift) {
  if (options_.reach <= 0) options_.reach = 2 * std::sqrt(2.0) * options_.grid.cell;
  for (const Goal& g : goals_) places_.push_back(g.at(shift_));
  find(options_.grid.count[2] == 1 ? 2 : 3);
}

void Paths::advance(const Clock& clock, const World& world, State&) {
  double farthest2 = 0;
  for (std::size_t k = 0; k < goals_.size(); ++k) {
    places_[k] = goals_[k].at(clock.t + shift_);
    farthest2 = std::max(farthest2, (places_[k] - marched_[k]).square().sum());
  }
  if (farthest2 >= cell() * cell()) find(world.dims);
}

bool Paths::holds(std::size_t k, const Array3d& place) const {
  return (place - places_[k]).square().sum() <= goals_[k].radius * goals_[k].radius;
}

void Paths::find(int dims) {
  const FieldGrid& grid = options_.grid;
  const auto cells = static_cast<std::size_t>(grid.cells());
  std::vector<double> slowness(cells);
  std::vector<bool> goal(cells, false);
  for (Index c = 0; c < grid.cells(); ++c) {
    const auto at = static_cast<std::size_t>(c);
    Array3d centre = grid.centre(c);
    if (dims == 2) centre[2] = 0;
    const double distance = nearest_surface(obstacles_, centre, dims).distance;
    slowness[at] = distance <= 0 ? std::numeric_limits<double>::infinity()
                                 : options_.length_weight + options_.repulsion_weight * repulsion(distance, options_.reach);
    for (std::size_t k = 0; k < goals_.size(); ++k)
      if (holds(k, centre)) goal[at] = true;
  }
  field_ = std::make_shared<CostField>(grid, std::move(slowness), std::move(goal));
  marched_ = places_;
}

}  // namespace swarmfit
