// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace swarmfit {

// 0, 1, 2, ..., n - 1.
template <class Position>
std::vector<Position> identity_order(std::size_t n) {
  std::vector<Position> order(n);
  std::iota(order.begin(), order.end(), Position{0});
  return order;
}

// The positions in `order` sorted by their integer key, equal keys keeping their order. By counting where the keys are dense, as the
// track and frame numbers of a recording of ten million rows are.
template <class Key, class Position>
std::vector<Position> sorted_by(const std::vector<Key>& key, std::vector<Position> order) {
  if (order.empty()) return order;
  const auto at = [&](Position i) { return key[static_cast<std::size_t>(i)]; };
  const auto [low, high] = std::minmax_element(key.begin(), key.end());
  const Key least = *low;
  const auto range = static_cast<std::size_t>(*high) - static_cast<std::size_t>(least);  // modulo 2^64, so it cannot overflow
  if (range > 4 * key.size()) {
    std::stable_sort(order.begin(), order.end(), [&](Position a, Position b) { return at(a) < at(b); });
    return order;
  }
  std::vector<std::size_t> place(range + 2, 0);
  for (const Position i : order) ++place[static_cast<std::size_t>(at(i) - least) + 1];
  std::partial_sum(place.begin(), place.end(), place.begin());
  std::vector<Position> out(order.size());
  for (const Position i : order) out[place[static_cast<std::size_t>(at(i) - least)]++] = i;
  return out;
}

}  // namespace swarmfit
