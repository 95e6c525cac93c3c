// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "fit/results/portrait.h"
#include "libeval/evaluation.h"

namespace swarmfit {

// The page of two sets of tracks: how alike they are, both in motion, their distributions. Of an evaluation and a portrait of the same
// tracks; `command` is what makes the page again. As safe as report_html.
std::string evaluation_html(const Evaluation&, const PairPortrait&, const std::string& command, const std::string& version);

}  // namespace swarmfit
