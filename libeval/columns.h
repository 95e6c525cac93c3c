// SPDX-License-Identifier: MIT
// The columns of an energy table: the seven metrics of Ren et al. 2016, those of motion once per lag.
#pragma once

#include <array>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace swarmfit {

enum Metric : std::size_t { kSpeed, kAcceleration, kAngularVelocity, kAngularAcceleration, kJerk, kDistance, kVelocityDifference };
inline constexpr std::size_t kMetrics = 7;
inline constexpr std::size_t kMotionMetrics = 5;  // the first: they compare positions of one individual at different times

struct MetricInfo {
  std::string_view key;     // in tables and JSON: "v", "a", "omega", "alpha", "mu", "d", "eta"
  std::string_view symbol;  // "v", "a", "ω", "α", "μ", "d", "η"
  std::string_view name;    // "speed", ...
  int length, time;         // unit as powers of length and time
};
extern const std::array<MetricInfo, kMetrics> kMetricInfo;

// One metric at one lag. Metrics of motion are taken from positions `lag` frames apart; the others have lag 1.
struct Column {
  Metric metric = kSpeed;
  int lag = 1;
  const MetricInfo& info() const { return kMetricInfo[metric]; }
  bool motion() const { return metric < kMotionMetrics; }
  std::string key() const;     // "omega", "omega@4"
  std::string symbol() const;  // "ω", "ω@4"
  std::string name() const;    // "angular velocity", "angular velocity over 4 frames"
  friend bool operator==(const Column&, const Column&) = default;
};

// Of one lag: the seven metrics in the order of `Metric`, so that column kDistance is d whatever the lags are. Further lags: five columns
// each, in the order of the lags.
std::vector<Column> columns_at(const std::vector<int>& lags);
// The lags of such columns, in their order.
std::vector<int> lags_of(const std::vector<Column>& columns);

// One value per column; if nothing else is said, of the seven columns of a single lag.
template <class T>
class PerColumn : public std::vector<T> {
 public:
  PerColumn() : std::vector<T>(kMetrics) {}
  explicit PerColumn(std::size_t columns, const T& value = T()) : std::vector<T>(columns, value) {}
  PerColumn(std::initializer_list<T> values) : std::vector<T>(values) {}
  void fill(const T& value) { this->assign(this->size(), value); }
};

}  // namespace swarmfit
