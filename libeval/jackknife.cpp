// SPDX-License-Identifier: MIT
#include "libeval/jackknife.h"

#include <cmath>

namespace swarmfit {

double jackknife(const std::vector<double>& without) {
  const auto n = static_cast<double>(without.size());
  double mean = 0, squares = 0;
  for (const double x : without) mean += x / n;
  for (const double x : without) squares += (x - mean) * (x - mean);
  return std::sqrt(squares * (n - 1) / n);
}

}  // namespace swarmfit
