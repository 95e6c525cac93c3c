// SPDX-License-Identifier: MIT
// Every model in motion on one page.
#pragma once

#include <string>
#include <vector>

#include "fit/results/scenery.h"
#include "libtrack/tracks.h"
#include "reports/recording/model_card.h"

namespace swarmfit {

struct Exhibit {
  ModelCard card;
  std::string command;  // that simulates it
  Tracks tracks;
  Scenery scenery = {};
};

// Players run only while they can be seen. As safe as report_html.
std::string gallery_html(const std::vector<Exhibit>&, const std::string& version);

}  // namespace swarmfit
