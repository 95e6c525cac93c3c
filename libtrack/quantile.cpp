// SPDX-License-Identifier: MIT
#include "libtrack/quantile.h"

#include <algorithm>
#include <cstddef>

#include "libtrack/nan.h"

namespace swarmfit {

double quantile(std::vector<double> values, double p) {
  if (values.empty()) return kNaN;
  const double position = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(values.begin(), at, values.end());
  if (below + 1 == values.size()) return *at;
  const double above = *std::min_element(at + 1, values.end());
  return *at + (position - static_cast<double>(below)) * (above - *at);
}

}  // namespace swarmfit
