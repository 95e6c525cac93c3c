// SPDX-License-Identifier: MIT
// A bridge between nest and food: ants arrive at both ends at random, and leave at the other. For the model ant_traffic.
#pragma once

#include "libswarm/world.h"

namespace swarmfit {

// Strömbom and Dussutour 2018, Methods (doi:10.1371/journal.pcbi.1006523); lengths in cm. The nest is at x = 0, the food at x = length.
// Kind 0 enters at the nest; kinds 1, laden, and 2, unladen, at the food.
struct BridgeShape {
  double length = 300;
  double width = 0;             // 0: a line, y = 0
  double mean_interval = 1;     // between arrivals, at each end, exponential [s]
  double laden = 0.24;          // share of those that enter at the food
  double entry_y = 2.5;         // of a bridge with a width: mean and standard deviation of y at the entry,
  double entry_y_spread = 0.8;  // brought onto the bridge
  double speed = 2.3;           // of whoever enters [unit/s]
};

// Ants that would step over a side of a bridge with a width stay where they are along it, and 1/20 of the width inside.
class Bridge : public WorldPart {
 public:
  explicit Bridge(const BridgeShape& shape) : shape_(shape) {}
  std::unique_ptr<WorldPart> clone() const override { return std::make_unique<Bridge>(*this); }
  void advance(const Clock&, const World&, State&) override;
  void constrain(const World&, const State& before, State& after) const override;

  const BridgeShape& shape() const { return shape_; }

 private:
  struct End {
    std::uint64_t arrived = 0;  // ants so far
    double next = -1;           // when the next arrives [s]; below 0: not drawn yet
  };
  void see_off(State&) const;
  void welcome(End&, bool nest, const Clock&, State&) const;

  BridgeShape shape_;
  End nest_, food_;
};

}  // namespace swarmfit
