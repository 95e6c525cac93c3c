// SPDX-License-Identifier: MIT
#include "libeval/robust.h"

#include <algorithm>
#include <cmath>

#include "libtrack/quantile.h"

namespace swarmfit {

Robust robust(std::vector<double> values) {
  const double middle = median(values);
  for (double& x : values) x = std::abs(x - middle);
  return {middle, kMadToSd * median(std::move(values))};
}

std::size_t count_outliers(const std::vector<double>& values, double sds) {
  const Robust r = robust(values);
  const auto wild = [&](double x) { return x > r.above(sds) || x < r.below(sds); };
  return static_cast<std::size_t>(std::count_if(values.begin(), values.end(), wild));
}

}  // namespace swarmfit
