// SPDX-License-Identifier: MIT
// The page of one set of tracks, recorded or simulated: what it is, what is wrong with it, how it moves, and how its metrics are
// distributed.
#pragma once

#include <optional>
#include <string>

#include "libeval/summary.h"
#include "reports/recording/model_card.h"

namespace swarmfit {

struct TracksPage {
  std::string command;             // that makes it again
  std::string version;             // of the program
  std::optional<ModelCard> model;  // which made the tracks, if one did
};

// Of a portrait and a summary of the same tracks. As safe as report_html.
std::string tracks_html(const Comparison& portrait, const TrackMeta&, const Summary&, const TracksPage&);

}  // namespace swarmfit
