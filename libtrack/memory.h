// SPDX-License-Identifier: MIT
#pragma once

namespace swarmfit {

// Asks the allocator to keep what is freed instead of handing it back to the system: a fit frees and allocates the same buffers a hundred
// thousand times, a large file is copied from column to column, and every page fetched anew costs more than the work done in it
// (docs/performance.md). For the process as a whole, so only programs call it, first thing. Does nothing without glibc.
void keep_freed_memory();

}  // namespace swarmfit
