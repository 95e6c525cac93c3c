// SPDX-License-Identifier: MIT
// Numbers as text: exact for machines, short for people.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace swarmfit {

// The shortest text that reads back as the same double; empty unless finite.
std::string exact(double value);

// For people. Undefined values are an en dash.
std::string fixed(double value, int decimals);           // "0.312"
std::string brief(double value, int significant = 4);    // rounded without trailing zeros: "0.01", "100"
std::string rounded(double value, int significant = 3);  // "12300", "0.0123", "1.2e-07"
// "0.92 ± 0.03"; an error that would round to zero has one digit: "1.00 ± 0.004". The value alone where the error is not finite.
std::string with_error(double value, double error, int decimals);
std::string percent(double share);                                 // 0.673 -> "67 %"
std::string counted(std::int64_t count);                           // thousands apart: "12 345" with narrow no-break spaces
std::string counted(std::int64_t count, const std::string& noun);  // "1 track", "3 tracks"

// Text of these functions as print has it: a minus sign before a number, "1.2×10⁻⁷" for "1.2e-07", " to " for " .. ".
std::string in_print(std::string_view text);

// A unit with powers as print has them: "mm/s²" for "mm/s^2", "mm/s¹·⁵" for "mm/s^1.5".
std::string unit_in_print(std::string_view unit);

inline const std::string kUndefined = "\u2013";

}  // namespace swarmfit
