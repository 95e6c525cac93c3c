// SPDX-License-Identifier: MIT
// The part that moves: the recording and one simulation of every model.
#include <fmt/format.h>

#include "reports/comparison/html_sections.h"
#include "reports/motion/player.h"
#include "reports/write/number.h"

namespace swarmfit::sections {

namespace {

std::string what_is_shown(const Comparison& c) {
  const auto frames = c.film.frames();
  const auto shown = static_cast<std::int64_t>(frames.size()), all = static_cast<std::int64_t>(c.recording.data.frames);
  const double seconds = static_cast<double>(shown - 1) * c.film.dt();  // frames without anybody are not played
  const std::string which = shown < all ? fmt::format("are the first {} of {} frames", counted(shown), counted(all)) : "is every frame";
  return fmt::format("Shown {}, from {} to {}: {} s.", which, frames.front().number, frames.back().number, brief(seconds));
}

constexpr const char* kModels =
    " Each panel shows one scored simulation, with the recording's gaps and measurement error added. All panels have the same scale, "
    "without "
    "perspective.";

constexpr const char* kPair = " Both begin at their own first frame and have the same scale, without perspective.";

std::string who_is_shown(const Comparison& c) {
  if (c.models.empty()) return {};
  return c.run.command == "evaluate" ? kPair : kModels;
}

}  // namespace

Html motion(const Comparison& c) {
  if (c.film.rows() == 0) return {};
  std::vector<Take> takes{{c.recording.data.format == "simulated" ? c.recording.data.path : "recording", &c.film}};
  for (std::size_t k = 0; k < c.models.size(); ++k) takes.push_back({c.models[k].model, &c.models[k].film, static_cast<int>(k)});
  Html out = element("p", "", escaped(what_is_shown(c) + who_is_shown(c)));
  out += player(takes, c.around);
  return out;
}

}  // namespace swarmfit::sections
