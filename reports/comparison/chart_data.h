// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "fit/results/comparison.h"

namespace swarmfit {

// The numbers behind the charts of a page, as assets/report.js takes them: JSON that cannot end the script element it stands in.
std::string chart_data(const Comparison&);

}  // namespace swarmfit
