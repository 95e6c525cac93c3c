// SPDX-License-Identifier: MIT
#include "libeval/row_blocks.h"

#include <algorithm>

namespace swarmfit {

std::vector<RowBlock> blocks_of(std::span<const Index> next) {
  std::vector<RowBlock> out;
  const auto rows = static_cast<Index>(next.size());
  for (Index k = 0; k < rows; ++k) {
    const Index to = next[static_cast<std::size_t>(k)];
    if (to < 0) continue;
    if (!out.empty() && out.back().first + out.back().count == k && out.back().shift == to - k)
      ++out.back().count;
    else
      out.push_back({k, 1, to - k});
  }
  return out;
}

std::vector<RowBlock> blocks_into(const std::vector<RowBlock>& blocks, const std::vector<RowBlock>& where) {
  std::vector<RowBlock> out;
  for (const RowBlock& b : blocks) {
    const Index first = b.first + b.shift, end = first + b.count;
    auto w = std::partition_point(where.begin(), where.end(), [&](const RowBlock& x) { return x.first + x.count <= first; });
    for (; w != where.end() && w->first < end; ++w) {
      const Index from = std::max(first, w->first), to = std::min(end, w->first + w->count);
      if (from < to) out.push_back({from - b.shift, to - from, b.shift});
    }
  }
  return out;
}

}  // namespace swarmfit
