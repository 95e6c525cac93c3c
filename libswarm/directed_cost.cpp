// SPDX-License-Identifier: MIT
#include "libswarm/directed_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace swarmfit {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

DirectedCostField::DirectedCostField(const FieldGrid& grid, std::vector<Faces> slowness, const std::vector<bool>& goal)
    : grid_(grid), slowness_(std::move(slowness)), cost_(slowness_.size(), kNever) {
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  std::vector<bool> known(cost_.size(), false);
  for (Index c = 0; c < grid_.cells(); ++c)
    if (goal[static_cast<std::size_t>(c)]) cost_[static_cast<std::size_t>(c)] = 0, front.emplace(0, c);
  while (!front.empty()) {
    const Index cell = front.top().second;
    front.pop();
    if (known[static_cast<std::size_t>(cell)]) continue;
    known[static_cast<std::size_t>(cell)] = true;
    for (std::size_t face = 0; face < kFaces.size(); ++face) {
      const Index other = beyond(cell, face);
      if (other < 0 || known[static_cast<std::size_t>(other)]) continue;
      if (const double cost = update(other); cost < cost_[static_cast<std::size_t>(other)])
        cost_[static_cast<std::size_t>(other)] = cost, front.emplace(cost, other);
    }
  }
}

Index DirectedCostField::beyond(Index cell, std::size_t face) const {
  const auto place = grid_.at(cell);
  const Index i = place[0] + kFaces[face][0], j = place[1] + kFaces[face][1];
  return i < 0 || j < 0 || i >= grid_.count[0] || j >= grid_.count[1] ? -1 : grid_.index(i, j, 0);
}

std::array<DirectedCostField::Way, 2> DirectedCostField::ways(Index cell) const {
  std::array<Way, 2> best{{{kNever, kNever, 0}, {kNever, kNever, 2}}};
  for (std::size_t face = 0; face < kFaces.size(); ++face) {
    const Index other = beyond(cell, face);
    const double step = slowness_[static_cast<std::size_t>(cell)][face] * grid_.cell;
    if (other < 0 || step == kNever) continue;
    const Way way{cost(other), step, face};
    if (Way& least = best[face / 2]; way.cost + way.step < least.cost + least.step) least = way;
  }
  return best;
}

// ((c - a) / p)² + ((c - b) / q)² = 1, upwind: c lies above both a and b, or one axis alone counts.
double DirectedCostField::update(Index cell) const {
  const auto [x, y] = ways(cell);
  const double one = std::min(x.cost + x.step, y.cost + y.step);
  if (x.cost == kNever || y.cost == kNever) return one;
  const double p2 = x.step * x.step, q2 = y.step * y.step, apart = x.cost - y.cost, under = p2 + q2 - apart * apart;
  if (under < 0) return one;
  const double both = (x.cost * q2 + y.cost * p2 + x.step * y.step * std::sqrt(under)) / (p2 + q2);
  return both >= std::max(x.cost, y.cost) ? both : one;
}

DirectedCostField::Faces DirectedCostField::downhill(Index cell) const {
  Faces down{};
  const double here = cost(cell);
  if (!(here < kNever) || here == 0) return down;
  double squares = 0;
  for (const Way& way : ways(cell)) {
    if (!(way.cost < here)) continue;
    down[way.face] = here - way.cost;
    squares += down[way.face] * down[way.face];
  }
  if (squares > 0)
    for (double& d : down) d /= std::sqrt(squares);
  return down;
}

}  // namespace swarmfit
