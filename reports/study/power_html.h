// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "fit/results/power.h"
#include "reports/write/run_folder.h"

namespace swarmfit {

// The page of power: the answer, who is told from whom, and how much longer the recording would have to be.
std::string power_html(const Power&, const Settings& settings);

}  // namespace swarmfit
