// SPDX-License-Identifier: MIT
#include "reports/write/list_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace swarmfit {

std::string list_text(const std::vector<ListEntry>& entries, TextStyle style) {
  std::size_t width = 0;
  for (const ListEntry& entry : entries) width = std::max(width, display_width(entry.name));
  const std::string indent(width + 3, ' ');
  std::string out;
  for (const ListEntry& entry : entries) {
    const std::string gap(width - display_width(entry.name) + 2, ' ');
    out += ' ' + paint(entry.name, Paint::bold, style) + gap + wrapped(entry.summary, kTextWidth - indent.size(), indent) + '\n';
    for (const auto& [key, value] : entry.facts) {
      const std::string line = fmt::format("{}: {}", key, value);
      out += indent;
      out += paint(wrapped(line, kTextWidth - indent.size(), indent + "  "), Paint::dim, style) + '\n';
    }
  }
  return finished(std::move(out), style);
}

}  // namespace swarmfit
