// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "libeval/group/measured.h"
#include "reports/write/run_folder.h"

namespace swarmfit {

// The page of swarmfit measure; as safe as every other (study_html.h).
std::string measure_html(const TrackMeta& meta, const Measured& measured, const Settings& settings, const std::string& version);

// What the group does most of the time, in a sentence.
std::string measure_sentence(const Measured& measured);

}  // namespace swarmfit
