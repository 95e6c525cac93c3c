// SPDX-License-Identifier: MIT
#include "libtrack/interpolate.h"

namespace swarmfit {

Rows interpolated(const Rows& rows, const std::vector<Between>& sources) {
  if (rows.rows() == 0) return rows;
  Rows out(static_cast<Index>(sources.size()), 3);
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < sources.size(); ++i) {
      const auto [a, part] = sources[i];
      out(static_cast<Index>(i), axis) = part == 0 ? rows(a, axis) : rows(a, axis) + part * (rows(a + 1, axis) - rows(a, axis));
    }
  }
  return out;
}

bool one_take(const std::vector<std::int64_t>& episodes, std::int64_t from, std::int64_t to) {
  return std::none_of(episodes.begin(), episodes.end(), [&](auto start) { return from < start && start <= to; });
}

}  // namespace swarmfit
