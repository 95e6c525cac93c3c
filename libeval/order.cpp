// SPDX-License-Identifier: MIT
#include "libeval/order.h"

#include <cmath>

#include "libeval/group/order_table.h"
#include "libtrack/nan.h"

namespace swarmfit {

OrderSeries order_parameters(const Tracks& tracks, std::optional<std::uint8_t> kind) {
  OrderRecord record = order_record(tracks, moment_options(tracks, kind), order_parameters_named({"polarisation", "milling", "extent"}));
  return {record.frame(), record.values(0), record.values(1), record.values(2)};
}

double mean_defined(const std::vector<double>& values) {
  double sum = 0, count = 0;
  for (const double x : values)
    if (std::isfinite(x)) sum += x, ++count;
  return count > 0 ? sum / count : kNaN;
}

}  // namespace swarmfit
