// SPDX-License-Identifier: MIT
#include "libswarm/cost_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "libtrack/vectors.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Calls visit(neighbour, axis, side) for the up to six cells that share a face with `cell`.
template <class Visit>
void for_each_face(const FieldGrid& grid, Index cell, Visit&& visit) {
  const auto place = grid.at(cell);
  Index stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (place[axis] > 0) visit(cell - stride, axis, -1.0);
    if (place[axis] + 1 < grid.count[axis]) visit(cell + stride, axis, 1.0);
    stride *= grid.count[axis];
  }
}

}  // namespace

Array3d FieldGrid::centre(Index c) const {
  const auto i = at(c);
  return lower + cell * (Array3d(static_cast<double>(i[0]), static_cast<double>(i[1]), static_cast<double>(i[2])) + 0.5);
}

Index FieldGrid::cell_of(const Array3d& place) const {
  std::array<Index, 3> i{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Index>(axis);
    const double last = static_cast<double>(count[axis] - 1);
    i[axis] = static_cast<Index>(std::clamp(std::floor((place[a] - lower[a]) / cell), 0.0, last));
  }
  return index(i[0], i[1], i[2]);
}

CostField::CostField(const FieldGrid& grid, std::vector<double> slowness, std::vector<bool> goal)
    : grid_(grid), slowness_(std::move(slowness)), cost_(slowness_.size(), kInfinite), goal_(std::move(goal)) {
  march();
  direction_.resize(cost_.size());
  for (Index c = 0; c < grid_.cells(); ++c) direction_[static_cast<std::size_t>(c)] = downhill(c);
}

void CostField::march() {
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  std::vector<bool> known(cost_.size(), false);
  for (Index c = 0; c < grid_.cells(); ++c)
    if (const auto s = static_cast<std::size_t>(c); goal_[s] && slowness_[s] < kInfinite) cost_[s] = 0, front.emplace(0, c);
  while (!front.empty()) {
    const Index cell = front.top().second;
    front.pop();
    if (known[static_cast<std::size_t>(cell)]) continue;
    known[static_cast<std::size_t>(cell)] = true;
    for_each_face(grid_, cell, [&](Index other, std::size_t, double) {
      const auto o = static_cast<std::size_t>(other);
      if (known[o] || slowness_[o] == kInfinite) return;
      if (const double cost = update(other); cost < cost_[o]) cost_[o] = cost, front.emplace(cost, other);
    });
  }
}

// Godunov: the largest number of axes whose smaller neighbours all lie below the cost that they give.
double CostField::update(Index cell) const {
  std::array<double, 3> least{kInfinite, kInfinite, kInfinite};
  for_each_face(grid_, cell, [&](Index other, std::size_t axis, double) {
    least[axis] = std::min(least[axis], cost_[static_cast<std::size_t>(other)]);
  });
  std::sort(least.begin(), least.end());
  const double step = slowness_[static_cast<std::size_t>(cell)] * grid_.cell;
  double cost = least[0] + step, sum = least[0], squares = least[0] * least[0];
  for (int axes = 2; axes <= 3 && cost > least[static_cast<std::size_t>(axes - 1)]; ++axes) {
    const double next = least[static_cast<std::size_t>(axes - 1)];
    sum += next;
    squares += next * next;
    const double disc = sum * sum - axes * (squares - step * step);
    if (disc < 0) break;
    cost = (sum + std::sqrt(disc)) / axes;
  }
  return cost;
}

Array3d CostField::downhill(Index cell) const {
  const double here = cost(cell);
  Array3d down = Array3d::Zero();
  if (!(here < kInfinite) || here == 0) return down;
  std::array<double, 3> least{here, here, here};
  for_each_face(grid_, cell, [&](Index other, std::size_t axis, double side) {
    const double there = cost(other);
    if (there >= least[axis]) return;
    least[axis] = there;
    down[static_cast<Index>(axis)] = side * (here - there);
  });
  const double slope = length(down);
  return slope > 1e-6 * grid_.cell ? Array3d(down / slope) : to_least_neighbour(cell);
}

Array3d CostField::to_least_neighbour(Index cell) const {
  const auto place = grid_.at(cell);
  Index best = cell;
  for (Index n = 0; n < 27; ++n) {
    const std::array<Index, 3> step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
    bool inside = true;
    std::array<Index, 3> there{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      there[axis] = place[axis] + step[axis];
      inside = inside && there[axis] >= 0 && there[axis] < grid_.count[axis];
    }
    if (!inside) continue;
    if (const Index other = grid_.index(there[0], there[1], there[2]); cost(other) < cost(best)) best = other;
  }
  const Array3d way = grid_.centre(best) - grid_.centre(cell);
  return best == cell ? way : Array3d(way / length(way));
}

Array3d CostField::direction(const Array3d& place) const {
  const Index own = grid_.cell_of(place);
  if (cost(own) == 0) return Array3d::Zero();
  std::array<std::array<Index, 2>, 3> near{};
  std::array<double, 3> share{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Index>(axis);
    const double last = static_cast<double>(grid_.count[axis] - 1);
    const double x = std::clamp((place[a] - grid_.lower[a]) / grid_.cell - 0.5, 0.0, last);
    near[axis][0] = static_cast<Index>(std::floor(x));
    near[axis][1] = std::min(near[axis][0] + 1, grid_.count[axis] - 1);
    share[axis] = x - std::floor(x);
  }
  Array3d sum = Array3d::Zero();
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::size_t i = corner & 1U, j = corner >> 1U & 1U, k = corner >> 2U;
    const double weight = (i == 0 ? 1 - share[0] : share[0]) * (j == 0 ? 1 - share[1] : share[1]) * (k == 0 ? 1 - share[2] : share[2]);
    sum += weight * direction_[static_cast<std::size_t>(grid_.index(near[0][i], near[1][j], near[2][k]))];
  }
  const double size = length(sum);
  return size > 1e-6 ? Array3d(sum / size) : direction_[static_cast<std::size_t>(own)];
}

Index CostField::unreachable() const {
  Index count = 0;
  for (std::size_t c = 0; c < cost_.size(); ++c) count += slowness_[c] < kInfinite && cost_[c] == kInfinite ? 1 : 0;
  return count;
}

}  // namespace swarmfit
