// SPDX-License-Identifier: MIT
#include "libtrack/read/raw_table.h"

#include <fmt/format.h>

#include <algorithm>

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

}  // namespace swarmfit
