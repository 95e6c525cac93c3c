// SPDX-License-Identifier: MIT
// What swarmfit knows about a model, in words: made from the comment that opens its file and from its table, so that it cannot be wrong.
#pragma once

#include <string>

#include "libswarm/model.h"
#include "reports/write/list_text.h"

namespace swarmfit::cli {

std::string model_manual(const ModelSpec& spec);  // plain text
std::string model_page(const ModelSpec& spec);    // Markdown, the head of docs/models/NAME.md
ListEntry model_entry(const ModelSpec& spec);     // for `swarmfit models`

}  // namespace swarmfit::cli
