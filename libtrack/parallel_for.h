// SPDX-License-Identifier: MIT
// A loop whose turns are shared out among threads.
#pragma once

#include <cstddef>
#include <exception>

namespace swarmfit {

// body(i) for i from 0 to n - 1, in any order. An exception must not leave a parallel region: of those thrown, that of the least i is
// thrown again here, and turns that have not begun by then are left out.
template <class Body>
void parallel_for(std::size_t n, Body&& body) {
  std::exception_ptr error;
  std::size_t thrown_by = n;
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t first = 0;
#pragma omp atomic read
    first = thrown_by;
    if (i > first) continue;
    try {
      body(i);
    } catch (...) {
#pragma omp critical(swarmfit_parallel_for)
      if (i < thrown_by) {
        error = std::current_exception();
#pragma omp atomic write
        thrown_by = i;
      }
    }
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace swarmfit
