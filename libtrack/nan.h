// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

namespace swarmfit {

// What is not known: a position not seen, a statistic that is not defined.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace swarmfit
