// SPDX-License-Identifier: MIT
#include "libeval/group/measured.h"

#include <algorithm>
#include <cmath>

#include "libeval/order.h"

namespace swarmfit {
namespace {

double mean_nearest(const Tracks& tracks, std::optional<std::uint8_t> kind) {
  double sum = 0, count = 0;
  for_each_moment(tracks, moment_options(tracks, kind), [&](const Moment& moment) {
    if (moment.size() < 2) return;
    for (const double d : moment.nearest().distance) sum += d, ++count;
  });
  return count > 0 ? sum / count : 0;
}

// Of the classifier's windows [frames].
std::int64_t automatic_window(const Tracks& tracks, const MomentOptions& moments) {
  const OrderRecord record = order_record(tracks, moments, order_parameters_named({"extent", "speed"}));
  const double frames = 2 * mean_defined(record.values(0)) / mean_defined(record.values(1)) / tracks.dt();
  const auto length = tracks.frames().empty() ? 0 : tracks.frames().back().number - tracks.frames().front().number + 1;
  const std::int64_t most = std::max<std::int64_t>(10, length / 4);
  return std::isfinite(frames) && frames < static_cast<double>(most) ? std::max<std::int64_t>(10, std::llround(frames)) : most;
}

MeasuredGroup measured_group(const Tracks& tracks, const MeasureOptions& options, std::optional<std::uint8_t> kind) {
  MeasuredGroup out;
  const auto& names = tracks.meta().kinds;
  out.name = !kind ? "all" : *kind < names.size() ? names[*kind] : "kind " + std::to_string(*kind);
  MomentOptions moments = moment_options(tracks, kind);
  moments.link = out.link = options.link > 0 ? options.link : automatic_link(mean_nearest(tracks, kind), tracks.dims());
  out.record = order_record(tracks, moments, options.what);
  for (std::size_t k = 0; k < options.what.size(); ++k) out.means.push_back(series_mean(out.record.frame(), out.record.values(k)));
  out.curves = group_curves(tracks, moments);
  out.window = options.window > 0 ? options.window : automatic_window(tracks, moments);
  out.states = state_course(tracks, moments, options.words, out.window);
  return out;
}

}  // namespace

Measured measure(const Tracks& tracks, const MeasureOptions& options) {
  Measured out;
  out.groups.push_back(measured_group(tracks, options, {}));
  for (int kind = 0; kind < tracks.kinds() && tracks.kinds() > 1; ++kind)
    out.groups.push_back(measured_group(tracks, options, static_cast<std::uint8_t>(kind)));
  return out;
}

}  // namespace swarmfit
