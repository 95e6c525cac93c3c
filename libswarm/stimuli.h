// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "libswarm/noise.h"
#include "libswarm/world.h"

namespace swarmfit {

// Something that agents flee from or fly to: a predator, a lamp, food, a mate.
struct Stimulus {
  enum class Kind { attract, repel };
  enum class Motion {
    line,   // on a straight line: start + t velocity
    path,   // straight from key to key, still before the first and after the last
    lead,   // `offset` away from the mean position of all agents: a goal that stays ahead
    ring,   // for each agent another place: on the horizontal circle about `start`, `ahead` radians farther round than the agent itself
    wander  // along curl noise of feature size `scale` at constant `speed`, on a leash of length `radius` about `start`
  };
  struct Key {
    double t;  // [s], ascending
    Eigen::Array3d place;
  };

  Kind kind = Kind::repel;
  Eigen::Array3d start = Eigen::Array3d::Zero();     // line: position at t = 0; wander: at its first moment; ring: centre [unit]
  Eigen::Array3d velocity = Eigen::Array3d::Zero();  // line [unit/s]
  Motion motion = Motion::line;
  std::vector<Key> path = {};                                                                               // path; at least one
  Eigen::Array3d offset = Eigen::Array3d::Zero();                                                           // lead [unit]
  double radius = 0;                                                                                        // ring, wander; > 0 [unit]
  double ahead = 0;                                                                                         // ring [rad]
  double scale = 1;                                                                                         // wander; > 0 [unit]
  double speed = 0;                                                                                         // wander [unit/s]
  double from = -std::numeric_limits<double>::infinity(), until = std::numeric_limits<double>::infinity();  // when it is there [s]
};

// Where something on this path is: straight from key to key, still before the first and after the last.
Eigen::Array3d on_path(const std::vector<Stimulus::Key>& keys, double t);

// All stimuli of a world, and where they are now.
class Stimuli : public WorldPart {
 public:
  // `shift` is added to the clock's time to get that of the stimuli [s].
  explicit Stimuli(std::vector<Stimulus> stimuli, double shift = 0);
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

  std::size_t size() const { return stimuli_.size(); }
  bool present(std::size_t k) const { return present_[k]; }
  Stimulus::Kind kind(std::size_t k) const { return stimuli_[k].kind; }
  const Eigen::Array3d& place(std::size_t k) const { return position_[k]; }  // of a ring its centre

 private:
  Eigen::Array3d place_for(std::size_t k, const Eigen::Array3d& agent) const;
  Eigen::Array3d wandered(std::size_t k, double dt, const Rng& rng);

  std::vector<Stimulus> stimuli_;
  double shift_;
  int dims_ = 3;
  std::optional<double> last_;  // time of the last move
  std::vector<Eigen::Array3d> position_;
  std::vector<bool> present_;
  std::vector<std::shared_ptr<const NoiseField>> fields_;  // of those that wander; made when the seed is known
};

}  // namespace swarmfit
