// SPDX-License-Identifier: MIT
// Settings: what extend and augment add to a recording, and by which model.
#include "cli/parse.h"
#include "cli/tables.h"
#include "libtrack/error.h"

namespace swarmfit::cli {
namespace {

constexpr double kMostAdded = 1'000'000;
constexpr std::int64_t kAnyGap = 10'000'000;  // frames

std::vector<Setting> of_extend() {
  return {
      {.name = "onward",
       .in = kExtend,
       .help = "frames by which tracks continue beyond their ends; NAME=frames for one individual",
       .allowed = texts(),
       .initial = "100",
       .use = [](Arguments& a, const Value& v) { a.extending.onward = parse_frames(v.words, 0); }},
      {.name = "bridge",
       .in = kExtend,
       .help =
           "longest gap between fragments of one individual to bridge [frames]; 0: none; if not given, all; NAME=frames for one individual",
       .allowed = texts(),
       .use = [](Arguments& a, const Value& v) { a.extending.bridge = parse_frames(v.words, kAnyGap); }},
      {.name = "add",
       .in = kAugment,
       .help = "simulated agents to add",
       .allowed = whole(1, kMostAdded),
       .initial = "100",
       .use = [](Arguments& a, const Value& v) { a.add = v.whole<int>(); }},
  };
}

}  // namespace

std::vector<Setting> synthesis_settings() {
  std::vector<Setting> all = of_extend();
  const std::vector<Setting> pilots = {
      {.name = "model",
       .in = kSyntheses,
       .help = "the model that moves where nothing was recorded, with options in brackets; see swarmfit models",
       .initial = "fastswarm",
       .letter = 'm',
       .use = [](Arguments& a, const Value& v) { a.extending.pilot.model = parse_model(v.text()); }},
      {.name = "set",
       .in = kSyntheses,
       .help = "parameter=value of the model, in units of the recording, as fit reports them; else the defaults of fits",
       .allowed = texts(),
       .use = [](Arguments& a, const Value& v) { a.extending.pilot.set = parse_assignments(v.words); }},
      {.name = "arena",
       .in = kSyntheses,
       .help = "where simulated agents may be: open, box or sphere about the recorded positions, or x0:x1,y0:y1[,z0:z1]",
       .initial = "open",
       .use = [](Arguments& a, const Value& v) { a.extending.pilot.arena = v.text(); }},
  };
  all.insert(all.end(), pilots.begin(), pilots.end());
  return all;
}

}  // namespace swarmfit::cli
