// SPDX-License-Identifier: MIT
// Numbers as text: exact for machines, short for people.
#pragma once

#include <cstdint>
#include <string>

namespace swarmfit {

// The shortest text that reads back as the same double; empty unless finite.
std::string exact(double value);

// For people. Undefined values are an en dash.
std::string fixed(double value, int decimals);                     // "0.312"
std::string brief(double value, int significant = 4);              // rounded without trailing zeros: "0.01", "100"
std::string rounded(double value, int significant = 3);            // "12300", "0.0123", "1.2e-07"
std::string percent(double share);                                 // 0.673 -> "67 %"
std::string counted(std::int64_t count);                           // thousands apart: "12 345" with narrow no-break spaces
std::string counted(std::int64_t count, const std::string& noun);  // "1 track", "3 tracks"

inline const std::string kUndefined = "\u2013";

}  // namespace swarmfit
