// SPDX-License-Identifier: MIT
// Time scales: over how many frames motion is measured.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

// "1,4,16" in any order, returned ascending; "auto" gives none. Throws InputError on anything but different positive whole numbers.
std::vector<int> parse_lags(const std::string& text);
std::string lags_text(const std::vector<int>& lags);  // "1,4,16"

// Lags of one frame are always allowed. Throws InputError if no individual is in sight long enough, without a gap, for one jerk at the
// longest lag (3l + 1 frames).
void require_lags(const Tracks& tracks, const std::vector<int>& lags);

// The longest lag, a power of 2, that a recording carries: it leaves at least half as many jerks as a lag of 1, and one takes no more than
// an eighth of the recording, so that parts of it can be compared. At least 1.
int longest_lag(const Tracks& tracks);

// Lags at which the signal exceeds the localisation error sigma [unit per axis]. Always 1; if a metric of motion then owes more than
// `limit` of its spread to the error (error_share, with this seed), also the shortest of 2, 4, 8, ... at which none does, or the longest
// lag.
std::vector<int> choose_lags(const Tracks& tracks, const Eigen::Array3d& sigma, double limit, std::uint64_t seed);

}  // namespace swarmfit
