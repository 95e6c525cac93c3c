// SPDX-License-Identifier: MIT
#include "reports/terminal_parts.h"

#include "reports/words.h"

namespace swarmfit::terminal {

std::string finish(std::string text, TextStyle style) { return style.unicode ? std::move(text) : ascii(text); }

std::string symbol_of(const Column& column, TextStyle style) { return style.unicode ? column.symbol() : column.key(); }

std::string paragraph(const std::string& text, const std::string& indent) {
  return indent + wrapped(printable(text), kWidth - indent.size(), indent) + '\n';
}

std::string bullets(const std::string& title, const std::vector<std::string>& items, Paint mark, TextStyle style) {
  if (items.empty()) return {};
  std::string out = '\n' + paint(title, mark, style) + '\n';
  for (const std::string& item : items) out += "  - " + wrapped(printable(item), kWidth - 4, "    ") + '\n';
  return out;
}

}  // namespace swarmfit::terminal
