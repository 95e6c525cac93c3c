// SPDX-License-Identifier: MIT
#include "libeval/columns.h"

#include <fmt/format.h>

namespace swarmfit {

const std::array<MetricInfo, kMetrics> kMetricInfo = {{
    {"v", "v", "speed", 1, -1},
    {"a", "a", "acceleration", 1, -2},
    {"omega", "ω", "angular velocity", 0, -1},
    {"alpha", "α", "angular acceleration", 0, -2},
    {"mu", "μ", "jerk", 1, -3},
    {"d", "d", "nearest-neighbour distance", 1, 0},
    {"eta", "η", "velocity difference", 0, -1},
}};

namespace {

std::string at_lag(std::string_view text, int lag) { return lag == 1 ? std::string(text) : fmt::format("{}@{}", text, lag); }

}  // namespace

std::string Column::key() const { return at_lag(info().key, lag); }
std::string Column::symbol() const { return at_lag(info().symbol, lag); }
std::string Column::name() const { return lag == 1 ? std::string(info().name) : fmt::format("{} over {} frames", info().name, lag); }

std::vector<Column> columns_at(const std::vector<int>& lags) {
  std::vector<Column> out;
  out.reserve(kMetrics + kMotionMetrics * lags.size());
  for (const int lag : lags) {
    for (std::size_t m = 0; m < kMotionMetrics; ++m) out.push_back({static_cast<Metric>(m), lag});
    if (out.size() == kMotionMetrics) out.push_back({kDistance, 1}), out.push_back({kVelocityDifference, 1});
  }
  return out;
}

std::vector<int> lags_of(const std::vector<Column>& columns) {
  std::vector<int> out;
  for (const Column& c : columns)
    if (c.metric == kSpeed) out.push_back(c.lag);
  return out;
}

}  // namespace swarmfit
