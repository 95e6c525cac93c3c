// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "fit/results/parameter_recovery.h"
#include "reports/write/html_table.h"
#include "reports/write/run_folder.h"

namespace swarmfit {

// The answer of a parameter recovery in words.
std::string coverage_sentence(const ParameterRecovery&);

// One parameter (an index into ParameterRecovery::parameters): every recording's interval above its true value, with the line on which both
// are equal; intervals that miss the truth are dashed, and crossed where the truth lies.
Html intervals_drawing(const ParameterRecovery&, std::size_t parameter);

// How many of these ranks, uniform on 0 .. 1 if posteriors are right, lie below each share, with the band that uniform ones keep to.
Html ranks_drawing(std::vector<double> ranks, double band, const std::string& name);

// The page of a parameter recovery.
std::string parameter_recovery_html(const ParameterRecovery&, const Settings& settings, const std::string& version);

}  // namespace swarmfit
