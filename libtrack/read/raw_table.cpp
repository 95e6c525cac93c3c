// SPDX-License-Identifier: MIT
#include "libtrack/read/raw_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

// Whole numbers below this are looked up by index, everything else by name.
constexpr std::uint32_t kIndexed = 1u << 20;

// "12" → 12, "12.0" → 12; nothing for other names, among them "012".
bool small_integer(std::string_view name, std::uint32_t& value) {
  const auto point = name.find('.');
  if (point != std::string_view::npos) {
    if (name.find_first_not_of('0', point + 1) != std::string_view::npos) return false;
    name = name.substr(0, point);
  }
  if (name.empty() || name.size() > 8 || (name.size() > 1 && name[0] == '0')) return false;
  value = 0;
  for (const char c : name) {
    if (c < '0' || c > '9') return false;
    value = 10 * value + static_cast<std::uint32_t>(c - '0');
  }
  return true;
}

}  // namespace

std::uint32_t TrackNames::number(std::string_view name) {
  std::uint32_t integer = 0;
  if (small_integer(name, integer)) return number(integer);
  const auto [entry, fresh] = by_name_.try_emplace(std::string(name), static_cast<std::uint32_t>(names_.size()));
  if (fresh) names_.emplace_back(name);
  return entry->second;
}

std::uint32_t TrackNames::number(std::uint32_t integer) {
  if (integer < kIndexed) {
    if (integer >= by_integer_.size()) by_integer_.resize(std::max<std::size_t>(integer + 1, 2 * by_integer_.size()));
    auto& slot = by_integer_[integer];
    if (slot == 0) {
      names_.push_back(std::to_string(integer));
      slot = static_cast<std::uint32_t>(names_.size());
    }
    return slot - 1;
  }
  const auto name = std::to_string(integer);
  const auto [entry, fresh] = by_name_.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
  if (fresh) names_.push_back(name);
  return entry->second;
}

std::string RawTable::place(std::size_t row) const {
  const auto after = std::upper_bound(parts.begin(), parts.end(), row, [](std::size_t r, const Part& part) { return r < part.first; });
  const auto& in = after == parts.begin() ? file : after[-1].file;
  if (!line.empty()) return fmt::format("{}:{}", in, line[row]);
  return fmt::format("{}: {} {}", in, row_name, row + 1 - (after == parts.begin() ? 0 : after[-1].first));
}

void add_ids(RawTable& table, std::span<const double> ids) {
  table.track.reserve(table.track.size() + ids.size());
  for (const double id : ids) {
    if (std::isnan(id))
      table.track.push_back(RawTable::no_track);
    else if (id >= 0 && id < 1e9 && id == std::floor(id))
      table.track.push_back(table.names.number(static_cast<std::uint32_t>(id)));
    else
      table.track.push_back(table.names.number(fmt::format("{}", id)));
  }
}

void check_numbers(const RawTable& table) {
  for (std::size_t c = 0; c < kNumberColumns; ++c) {
    const auto column = static_cast<FileColumn>(c);
    for (std::size_t i = 0; i < table.number[c].size(); ++i) {
      const double value = table.number[c][i];
      if (std::isinf(value)) throw InputError(table.place(i) + ": the value is infinite; expected a finite number");
      if (column == FileColumn::t && std::isnan(value))
        throw InputError(table.place(i) + ": the time is missing; expected a time in every row");
      if (column == FileColumn::frame && std::abs(value) > 9e15)
        throw InputError(fmt::format("{}: the frame number {} is too large; expected one up to 9e15", table.place(i), value));
      if (column == FileColumn::frame && value != std::floor(value))
        throw InputError(fmt::format("{}: the frame number {} is not an integer; expected whole frames", table.place(i), value));
    }
  }
}

}  // namespace swarmfit
