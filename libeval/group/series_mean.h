// SPDX-License-Identifier: MIT
// The mean of a series of correlated values, and how sure it is.
#pragma once

#include <cstdint>
#include <span>

namespace swarmfit {

struct SeriesMean {
  double mean = 0, sd = 0;      // of the defined values; NaN if there are none
  std::size_t count = 0;        // of them
  double correlation_time = 0;  // [frames]: n / effective sample size (effective_size); at least 1, NaN if the values are all the same
  double lower = 0, upper = 0;  // 95 % interval of the mean; NaN if the series is shorter than four blocks
  std::size_t blocks = 0;       // behind it
};

// Batch means: the series is cut into at most 20 blocks of equal time, each of two correlation times at least, and Student's t of their
// means gives the interval (Flegal and Jones 2010, doi:10.1214/09-AOS735). `frame` ascends; values that are not finite are left out.
SeriesMean series_mean(std::span<const std::int64_t> frame, std::span<const double> values);

}  // namespace swarmfit
