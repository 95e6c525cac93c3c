// SPDX-License-Identifier: MIT
#include "reports/comparison/chart_data.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/comparison/tables.h"
#include "reports/comparison/words.h"
#include "reports/write/json_parts.h"
#include "reports/write/page.h"
#include "reports/write/unit_text.h"

namespace swarmfit {
namespace {

using json_parts::Json;

// Five digits are more than a screen can show and keep the page small.
Json short_number(double value) { return std::isfinite(value) ? Json::parse(fmt::format("{:.5g}", value)) : Json(); }

template <class Values>
Json short_numbers(const Values& values) {
  Json out = Json::array();
  for (const double value : values) out.push_back(short_number(value));
  return out;
}

Json metric_data(const Comparison& c, std::size_t m) {
  const Column& column = c.recording.columns[m];
  Json models = Json::array();
  for (const ModelFit& r : c.models)
    models.push_back(short_numbers(physical_density(r.runs.distributions[m].histogram, c.recording.axis_width[m])));
  const auto [lower, upper] = physical_band(c, m);
  return {{"key", column.key()},
          {"symbol", column.symbol()},
          {"name", column.name()},
          {"unit", metric_unit(column.metric, c.recording.data.unit)},
          {"density_unit", density_unit(column.metric, c.recording.data.unit)},
          {"signed", column.metric == kAngularAcceleration},
          {"lower", c.recording.axis_lower[m]},
          {"width", c.recording.axis_width[m]},
          {"recording", short_numbers(physical_density(c.recording.distributions[m].histogram, c.recording.axis_width[m]))},
          {"band", {short_numbers(lower), short_numbers(upper)}},
          {"models", std::move(models)}};
}

}  // namespace

std::string chart_data(const Comparison& c) {
  Json metrics = Json::array(), models = Json::array();
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m) metrics.push_back(metric_data(c, m));
  for (const ModelFit& r : c.models) models.push_back({{"name", r.model}});
  const Json data = {{"clip", c.recording.binning.clip}, {"metrics", std::move(metrics)}, {"models", std::move(models)}};
  return embedded(data.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace swarmfit
