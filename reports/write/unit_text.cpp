// SPDX-License-Identifier: MIT
#include "reports/write/unit_text.h"

#include <fmt/format.h>

namespace swarmfit {
namespace {

std::string power(const std::string& base, int exponent) {
  if (exponent == 1) return base;
  if (exponent == 2) return base + "²";
  if (exponent == 3) return base + "³";
  return base + '^' + std::to_string(exponent);
}

}  // namespace

std::string metric_unit(std::size_t metric, const std::string& length_unit) {
  const MetricInfo& info = kMetricInfo[metric];
  const bool angle = metric == kAngularVelocity || metric == kAngularAcceleration;
  std::string above = angle ? "rad" : "1";
  if (info.length != 0) above = power(length_unit.empty() ? "unit" : length_unit, info.length);
  return info.time == 0 ? above : above + '/' + power("s", -info.time);
}

std::string density_unit(std::size_t metric, const std::string& length_unit) {
  const std::string unit = metric_unit(metric, length_unit);
  if (unit.substr(0, 2) == "1/") return unit.substr(2);
  return unit.find('/') == std::string::npos ? "1/" + unit : "1/(" + unit + ')';
}

std::string panel_unit(const PanelItem& item, const std::string& length_unit) {
  std::string above;
  if (item.length != 0) above = power(length_unit.empty() ? "unit" : length_unit, item.length);
  if (item.time > 0) above += fmt::format("{}{}", above.empty() ? "" : " ", power("s", item.time));
  return item.time < 0 ? (above.empty() ? "1" : above) + '/' + power("s", -item.time) : above;
}

}  // namespace swarmfit
