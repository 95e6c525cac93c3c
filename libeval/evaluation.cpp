// SPDX-License-Identifier: MIT
#include "libeval/evaluation.h"

#include <fmt/format.h>

#include <cmath>

#include "libeval/lags.h"
#include "libeval/order.h"
#include "libeval/rounding.h"
#include "libtrack/error.h"
#include "libtrack/nan.h"
#include "libtrack/text_scan.h"

namespace swarmfit {
namespace {

constexpr double kSameInterval = 0.01;  // relative difference of frame intervals that still counts as the same

void require_comparable(const Tracks& real, const Tracks& simulated) {
  const auto& a = real.meta();
  const auto& b = simulated.meta();
  if (a.dims != b.dims)
    throw InputError(fmt::format("{}: has {} dimensions; expected {} as in {}", b.from.path, b.dims, a.dims, a.from.path));
  if (a.unit != b.unit) throw InputError(fmt::format("{}: is in {}; expected {} as in {}", b.from.path, b.unit, a.unit, a.from.path));
  if (std::abs(a.dt - b.dt) > kSameInterval * a.dt)
    throw InputError(fmt::format("{}: its frame interval is {:.6g} s; expected {:.6g} s as in {}", b.from.path, b.dt, a.dt, a.from.path));
}

OrderMeans order_means(const Tracks& tracks) {
  const auto order = order_parameters(tracks);
  return {mean_defined(order.polarisation), mean_defined(order.milling), mean_defined(order.extent)};
}

// One field of the table: a number, or empty for undefined.
double energy_field(Fields& fields, const std::string& name, long line) {
  const long column = fields.column();
  double value = 0;
  if (fields.number(value) && std::isfinite(value)) return value;
  std::string scratch;
  const std::string text(fields.text(scratch));
  if (!text.empty()) throw InputError(at(name, line, column, fmt::format("'{}' is not a number; expected an energy, or nothing", text)));
  return kNaN;
}

std::vector<std::string> header(std::string_view line) {
  std::vector<std::string> names;
  std::string scratch;
  for (Fields fields(line, ','); !fields.done();) names.emplace_back(fields.text(scratch));
  if (!names.empty()) names.erase(names.begin());
  return names;
}

}  // namespace

Evaluation evaluate(const Tracks& real, const Tracks& simulated, const Binning& binning, const MetricOptions& options) {
  require_comparable(real, simulated);
  require_lags(real, options.lags);
  const Target target(recorded_samples(real, options), binning);
  Evaluation e;
  e.real = real.meta();
  e.simulated = simulated.meta();
  e.binning = target.binning();
  e.columns = target.columns();
  e.axis_lower = e.axis_width = PerColumn<double>(e.columns.size());
  e.real_distribution = target.recording();
  e.simulated_distribution = target.distributions(metric_samples(simulated, options));
  e.raw_energies = target.energies(e.simulated_distribution);
  for (std::size_t m = 0; m < e.columns.size(); ++m) {
    e.axis_lower[m] = target.axis(m).lower;
    e.axis_width[m] = target.axis(m).width;
  }
  e.real_order = order_means(real);
  e.simulated_order = order_means(simulated);
  return e;
}

WeighedTable weigh(const std::string& name, std::string_view csv) {
  WeighedTable table;
  std::vector<double> values;
  Lines lines(csv);
  std::string scratch;
  for (std::string_view line; lines.next(line);) {
    if (!has_content(line)) continue;
    if (table.metrics.empty()) {
      table.metrics = header(line);
      if (table.metrics.empty())
        throw InputError(at(name, lines.number(), 1, "no metric is named; expected a header such as model,v,a,omega"));
      continue;
    }
    Fields fields(line, ',');
    table.models.emplace_back(fields.text(scratch));
    std::size_t count = 0;
    for (; !fields.done(); ++count) values.push_back(energy_field(fields, name, lines.number()));
    if (count < table.metrics.size() && !line.empty() && line.back() == ',') values.push_back(kNaN), ++count;
    if (count != table.metrics.size())
      throw InputError(at(name, lines.number(), 1, fmt::format("{} energies; expected {} as in the header", count, table.metrics.size())));
  }
  if (table.models.empty()) throw InputError(name + ": no energies; expected a header of metric names and one line per model");
  table.energies = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      values.data(), static_cast<Index>(table.models.size()), static_cast<Index>(table.metrics.size()));
  table.weighting = entropy_weights(table.energies);
  for (Index m = 0; m < table.energies.rows(); ++m) table.scores.push_back(score(table.energies.row(m).transpose(), table.weighting));
  return table;
}

}  // namespace swarmfit
