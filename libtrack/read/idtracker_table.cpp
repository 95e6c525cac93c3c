// SPDX-License-Identifier: MIT
#include "libtrack/read/idtracker_table.h"

#include "libtrack/nan.h"
#include "libtrack/read/postures.h"

namespace swarmfit {
namespace {

std::vector<std::string> labels(const std::vector<std::string>& stated, std::size_t animals) {
  if (stated.size() == animals) return stated;
  std::vector<std::string> out;
  for (std::size_t k = 1; k <= animals; ++k) out.push_back(std::to_string(k));
  return out;
}

}  // namespace

RawTable idtracker_table(const std::string& file, const IdTrackerFile& found, const ReadOptions& options) {
  const std::size_t frames = found.positions.dims[0], animals = found.positions.dims[1];
  const auto& sure = found.confidence;
  const bool has_confidence =
      sure.dims.size() >= 2 && sure.value.size() == frames * animals && sure.dims[0] == frames && sure.dims[1] == animals;
  RawTable table;
  table.file = file;
  table.unit = "px";
  if (found.fps && *found.fps > 0) table.dt = 1 / *found.fps;
  const auto names = labels(found.names, animals);
  Postures postures(table, options, {"centroid"});
  for (std::size_t k = 0; k < animals; ++k) {
    const auto track = table.names.number(names[k]);
    for (std::size_t f = 0; f < frames; ++f) {
      const double* at = found.positions.value.data() + 2 * (f * animals + k);
      const std::span<const double> confidence =
          has_confidence ? std::span(sure.value).subspan(f * animals + k, 1) : std::span<const double>();
      postures.add({track, static_cast<double>(f), kNaN, {at, 1}, {at + 1, 1}, {}, confidence});
    }
  }
  postures.finish();
  return table;
}

}  // namespace swarmfit
