// SPDX-License-Identifier: MIT
// Links from row to row as blocks, so that what follows links goes through memory in order.
#pragma once

#include <span>
#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

// Rows first .. first + count - 1, each linked to the one `shift` rows later.
struct RowBlock {
  Index first, count, shift;
};

// All links of `next`, -1 being none: ascending, as long as possible.
std::vector<RowBlock> blocks_of(std::span<const Index> next);

// The parts of `blocks` whose links end in rows of `where`, which is ascending.
std::vector<RowBlock> blocks_into(const std::vector<RowBlock>& blocks, const std::vector<RowBlock>& where);

}  // namespace swarmfit
