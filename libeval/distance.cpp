// SPDX-License-Identifier: MIT
#include "libeval/distance.h"

#include <cmath>
#include <stdexcept>

#include "libtrack/nan.h"

namespace swarmfit {
namespace {

void require_same_bins(const Histogram& a, const Histogram& b) {
  if (a.counts.size() != b.counts.size()) throw std::invalid_argument("distance of histograms: bins differ");
}

// Difference of the shares in a bin.
double difference(const Histogram& a, const Histogram& b, std::size_t bin) {
  return static_cast<double>(a.counts[bin]) / static_cast<double>(a.samples) -
         static_cast<double>(b.counts[bin]) / static_cast<double>(b.samples);
}

}  // namespace

double total_variation(const Histogram& a, const Histogram& b) {
  if (a.samples == 0 || b.samples == 0) return kNaN;
  require_same_bins(a, b);
  double sum = 0;
  for (std::size_t i = 0; i < a.counts.size(); ++i) sum += std::abs(difference(a, b, i));
  return 0.5 * sum;
}

double wasserstein(const Histogram& a, const Histogram& b, double width) {
  if (a.samples == 0 || b.samples == 0) return kNaN;
  require_same_bins(a, b);
  double ahead = 0, sum = 0;
  for (std::size_t i = 0; i < a.counts.size(); ++i) {
    ahead += difference(a, b, i);
    sum += std::abs(ahead);
  }
  return sum * width;
}

}  // namespace swarmfit
