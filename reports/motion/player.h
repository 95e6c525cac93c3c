// SPDX-License-Identifier: MIT
// The moving part of a page: films side by side, played by assets/player.js.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fit/results/scenery.h"
#include "libtrack/tracks.h"
#include "reports/write/html_table.h"

namespace swarmfit {

inline constexpr int kNoSeries = -1;  // of the recording, which has no colour among the models

// One film of a player. The tracks are borrowed.
struct Take {
  std::string title;
  const Tracks* tracks;
  int series = kNoSeries;  // colour and dashes of its name, as in the charts
};

// A player and the films it plays, in step; the first sets scale, unit and box. Everything else it shows is made by the script, so that a
// page without JavaScript has a sentence in its place. Nothing if nobody is to be seen in the first film. The scenery surrounds all of
// them.
Html player(const std::vector<Take>& takes, const Scenery& scenery = {});

// The script that a page with players needs, once, after the last of them.
std::string player_script();

}  // namespace swarmfit
