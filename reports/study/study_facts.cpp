// SPDX-License-Identifier: MIT
#include "reports/study/study_facts.h"

#include <fmt/format.h>

#include "reports/study/study_html.h"

namespace swarmfit {
namespace {

// A number with its unit; nothing without a number.
std::string measured(const Settings& settings, std::string_view name, const std::string& unit) {
  const std::string value = setting(settings, name);
  return value.empty() || value == "0" ? "" : fmt::format("{} {}", value, unit);
}

}  // namespace

Html study_facts(const Settings& s) {
  const std::string unit = setting(s, "unit"), frames = setting(s, "frames"), fps = setting(s, "fps"), dims = setting(s, "dims");
  Html out = fact("individuals", setting(s, "agents"));
  out += fact("frames", fps.empty() ? frames : fmt::format("{} at {} Hz", frames, fps));
  out += fact("dimensions", dims.empty() ? "" : fmt::format("{}-D, in {}", dims, unit));
  out += fact("rms radius", measured(s, "extent", unit));
  out += fact("neighbour distance", measured(s, "spacing", unit));
  out += fact("mean speed", measured(s, "speed", unit + "/s"));
  out += fact("measurement error", measured(s, "film-noise", unit));
  out += fact("lost per individual and frame", setting(s, "dropout") == "0" ? "" : setting(s, "dropout"));
  out += fact("budget", setting(s, "budget"));
  out += fact("protocol", setting(s, "protocol"));
  return out;
}

}  // namespace swarmfit
