// SPDX-License-Identifier: MIT
// Units as trackers write them, and names of columns with a unit in them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace swarmfit {

// "CM", "centimetres", "[cm]" → "cm"; "micron", "µm" (UTF-8 or Latin-1) → "um"; nothing for other words.
std::optional<std::string> length_unit(std::string_view text);

// Seconds are value * times / per: "ms" → 1, 1000; "minutes" → 60, 1. Two whole numbers, because 1e-3 is no double.
struct TimeUnit {
  double times = 1, per = 1;
  double seconds(double value) const { return per == 1 ? value * times : value * times / per; }
  bool operator==(const TimeUnit&) const = default;
};
std::optional<TimeUnit> time_unit(std::string_view text);
// The same with a number in front of it: "0.01s" → 1, 100; "40 ms" → 40, 1000.
std::optional<TimeUnit> scaled_time_unit(std::string_view text);

// A name of a column in parts.
struct ColumnName {
  std::string name;   // lower case, separators as '_', without the unit
  std::string title;  // the same as written
  std::string unit;   // as written; empty: none
};

// "Pos X [mm]" → {"pos_x", "mm"}; "x_cm", "x in cm", "x/cm", "time_ms" and "X#wcentroid (cm)" (→ "x#wcentroid") likewise.
ColumnName column_name(std::string_view text);

}  // namespace swarmfit
