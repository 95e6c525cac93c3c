// SPDX-License-Identifier: MIT
// Racing: a candidate that must beat another is simulated a few times first, and given up if it then lies clearly behind.
#pragma once

#include <cstddef>
#include <deque>

namespace swarmfit {

// How many of the replicates come first: a quarter, rounded up.
inline std::size_t screening_replicates(std::size_t replicates) { return (replicates + 3) / 4; }

// How far the difference of two costs after the first replicates may lie from that after all, learned from pairs where both are known.
// Costs must be those of equally many replicates on the same seeds: a distance between histograms shrinks with the number of samples.
class Screening {
 public:
  // Differences: candidate minus rival.
  void learn(double difference_first, double difference_all);
  // False if the difference after the first replicates is so large that all of them would hardly turn it. True while too little is known.
  bool worth(double difference_first) const;

 private:
  std::deque<double> squares_;  // (all - first)² of the latest pairs
};

}  // namespace swarmfit
