// SPDX-License-Identifier: MIT
#include "libtrack/read/branches.h"

#include <algorithm>
#include <map>

namespace swarmfit {

std::vector<std::vector<std::uint32_t>> branches(const Edges& edges, const std::vector<double>& frame) {
  struct Links {
    std::size_t in = 0, out = 0;
    std::uint32_t next = 0;
    bool follows = false;  // continues the individual of the spot before it
  };
  std::map<std::uint32_t, Links> spots;
  for (const auto& [from, to] : edges) {
    ++spots[from].out;
    spots[from].next = to;
    ++spots[to].in;
  }
  for (const auto& [from, to] : edges) spots[to].follows = spots[to].in == 1 && spots[from].out == 1;

  std::vector<std::vector<std::uint32_t>> out;
  for (const auto& [spot, links] : spots) {
    if (links.follows) continue;
    auto& branch = out.emplace_back(1, spot);
    for (const Links* at = &links; at->out == 1 && spots[at->next].follows; at = &spots[at->next]) branch.push_back(at->next);
  }
  std::stable_sort(out.begin(), out.end(), [&](const auto& a, const auto& b) { return frame[a[0]] < frame[b[0]]; });
  return out;
}

}  // namespace swarmfit
