// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "libswarm/world.h"

namespace swarmfit {

// Something that agents flee from or fly to: a predator, a lamp, food, a mate. It moves on a straight line.
struct Stimulus {
  enum class Kind { attract, repel };
  Kind kind = Kind::repel;
  Eigen::Array3d start = Eigen::Array3d::Zero();     // position at t = 0 [unit]
  Eigen::Array3d velocity = Eigen::Array3d::Zero();  // [unit/s]
};

// All stimuli of a world, and where they are now.
class Stimuli : public WorldPart {
 public:
  explicit Stimuli(std::vector<Stimulus> stimuli);
  std::unique_ptr<WorldPart> clone() const override { return std::make_unique<Stimuli>(*this); }
  void advance(const Clock& clock, const World&, State&) override;

  struct Near {
    int index = -1;  // of the stimulus; -1: none within range
    Stimulus::Kind kind{};
    Eigen::Array3d from;  // unit vector from the stimulus to the agent; 0 at its very place
    double distance = 0;  // between the two [unit]
  };
  // The nearest with distance <= range; a repelling one wins ties.
  Near nearest(const Eigen::Array3d& position, const Bounds& bounds, double range) const;

 private:
  std::vector<Stimulus> stimuli_;
  std::vector<Eigen::Array3d> position_;
};

}  // namespace swarmfit
