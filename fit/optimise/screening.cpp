// SPDX-License-Identifier: MIT
#include "fit/optimise/screening.h"

#include <cmath>
#include <numeric>

namespace swarmfit {
namespace {

constexpr std::size_t kFew = 10;    // pairs before anything is given up
constexpr std::size_t kMost = 100;  // the search zooms in: older pairs tell of another scale
constexpr double kMargin = 0.25;    // root mean squares (docs/search.md)

}  // namespace

void Screening::learn(double difference_first, double difference_all) {
  const double off = difference_all - difference_first;
  if (!std::isfinite(off)) return;
  squares_.push_back(off * off);
  if (squares_.size() > kMost) squares_.pop_front();
}

bool Screening::worth(double difference_first) const {
  if (squares_.size() < kFew) return true;
  const double mean = std::accumulate(squares_.begin(), squares_.end(), 0.0) / static_cast<double>(squares_.size());
  return !(difference_first > kMargin * std::sqrt(mean));
}

}  // namespace swarmfit
