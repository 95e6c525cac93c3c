// SPDX-License-Identifier: MIT
#include "libeval/value_spread.h"

#include <algorithm>
#include <cmath>

namespace swarmfit {

std::pair<std::vector<double>, std::vector<double>> mean_and_sd(const std::vector<const std::vector<double>*>& lists) {
  std::size_t size = 0;
  for (const auto* list : lists) size = std::max(size, list->size());
  std::pair<std::vector<double>, std::vector<double>> out{std::vector<double>(size, NAN), std::vector<double>(size, NAN)};
  for (std::size_t k = 0; k < size; ++k) {
    double sum = 0, squares = 0, n = 0;
    for (const auto* list : lists)
      if (k < list->size() && std::isfinite((*list)[k])) sum += (*list)[k], ++n;
    if (n == 0) continue;
    const double mean = sum / n;
    for (const auto* list : lists)
      if (k < list->size() && std::isfinite((*list)[k])) squares += ((*list)[k] - mean) * ((*list)[k] - mean);
    out.first[k] = mean;
    if (n > 1) out.second[k] = std::sqrt(squares / (n - 1));
  }
  return out;
}

}  // namespace swarmfit
