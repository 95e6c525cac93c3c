// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "fit/results/recovery.h"
#include "reports/write/run_folder.h"

namespace swarmfit {

// The answer of a recovery in words: "The model that made the recording is ranked first in 17 of 20 recordings.".
std::string recovery_sentence(const Recovery&);
// How often the maker is alone in the best group, shares it, or is not in it.
std::string recovery_detail(const Recovery&);

// The page of a model recovery.
std::string recovery_html(const Recovery&, const Settings& settings, const std::string& version);

}  // namespace swarmfit
