// SPDX-License-Identifier: MIT
// What every text for the terminal is made of.
#pragma once

#include <string>
#include <vector>

#include "libeval/columns.h"
#include "reports/text_table.h"

namespace swarmfit::terminal {

inline constexpr std::size_t kWidth = 100;  // columns of the widest line

std::string finish(std::string text, TextStyle style);  // spelled out if the terminal knows no more than ASCII
std::string symbol_of(const Column& column, TextStyle style);
std::string paragraph(const std::string& text, const std::string& indent = "");
// A title and items below it, one or more lines each; nothing without items.
std::string bullets(const std::string& title, const std::vector<std::string>& items, Paint mark, TextStyle style);

}  // namespace swarmfit::terminal
