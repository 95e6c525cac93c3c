// SPDX-License-Identifier: MIT
#pragma once

#include <omp.h>

#include <algorithm>

#include "libtrack/tracks.h"

namespace swarmfit {

// An OpenMP region costs 1.4 µs spinning and 40 µs with waiting threads, so only groups whose step takes far longer open one.
inline constexpr Index kParallelFrom = 2000;

// body(i, thread) for i in 0 .. n-1, on all threads when the group is large and nobody above runs in parallel already (fits parallelise
// over candidates instead). Bodies must be independent and write only what belongs to i: then the bits do not depend on the threads.
// `thread` numbers the scratch space a body may use, below agent_threads().
template <class Body>
void for_each_agent(Index n, Body&& body) {
  if (n >= kParallelFrom && !omp_in_parallel()) {
#pragma omp parallel for schedule(dynamic, 64)
    for (Index i = 0; i < n; ++i) body(i, static_cast<std::size_t>(omp_get_thread_num()));
  } else {
    for (Index i = 0; i < n; ++i) body(i, std::size_t{0});
  }
}

// body(first, count) for parts of 0 .. n-1 that together are all of it; on all threads under the same conditions.
template <class Body>
void for_each_part(Index n, Body&& body) {
  constexpr Index part = 512;
  if (n >= kParallelFrom && !omp_in_parallel()) {
#pragma omp parallel for schedule(static)
    for (Index first = 0; first < n; first += part) body(first, std::min(part, n - first));
  } else if (n > 0) {
    body(Index{0}, n);
  }
}

inline std::size_t agent_threads() { return omp_in_parallel() ? 1 : static_cast<std::size_t>(omp_get_max_threads()); }

}  // namespace swarmfit
