// SPDX-License-Identifier: MIT
#pragma once

#include "reports/write/text_table.h"

namespace swarmfit::cli {

// Colour only on a terminal and without NO_COLOR; signs beyond ASCII where the locale says UTF-8.
TextStyle style();

}  // namespace swarmfit::cli
