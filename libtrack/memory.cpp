// SPDX-License-Identifier: MIT
#include "libtrack/memory.h"

#include <limits>  // any standard header says whether this is glibc
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace swarmfit {

void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, 0);  // no block gets a mapping of its own, which would be given back with the block
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

}  // namespace swarmfit
