// SPDX-License-Identifier: MIT
#include "libeval/false_discovery.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace swarmfit {

std::vector<double> adjusted_p(const std::vector<double>& p) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < p.size(); ++k)
    if (!std::isnan(p[k])) order.push_back(k);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] > p[b]; });
  std::vector<double> out = p;
  double least = 1;
  const auto tests = static_cast<double>(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    least = std::min(least, p[order[k]] * tests / (tests - static_cast<double>(k)));
    out[order[k]] = least;
  }
  return out;
}

}  // namespace swarmfit
