// SPDX-License-Identifier: MIT
// Collision avoidance of a whole group, step by step: who is near whom, what that forbids (avoidance.h), and the velocity that is left.
#pragma once

#include <vector>

#include "libswarm/avoidance.h"
#include "libswarm/model.h"

namespace swarmfit {

// What an agent does when every velocity leads to a collision.
enum class Infeasible {
  zero,            // stops
  substep,         // asks for the step to be redone in halves; stops when it cannot be halved any more
  min_penetration  // takes the velocity that is least deep in what is forbidden
};
Infeasible parse_infeasible(std::string_view name);  // one of the names above

// One run's collision avoidance: part of a model's Workspace. Buffers are reused from step to step; nothing else is remembered.
class Avoider {
 public:
  struct Limits {
    double radius;        // of an agent, > 0 [unit]
    double max_speed;     // > 0 [unit/s]
    double time_horizon;  // for how long nobody is to be touched, > 0 [s]
    double range;         // neighbours farther away are not avoided [unit]
    double neighbours;    // most that are avoided at once; rounded
  };

  Avoider(int dims, Infeasible infeasible);

  // Before every step: finds out who is where.
  void begin(const State& now, const Bounds& bounds, const Limits& limits);

  // The collision-free velocity nearest to `preferred` for agent i. Agents with the same place and velocity part in a drawn direction. May
  // be called for different agents at once, `thread` being the caller's (for_each_agent).
  Eigen::Array3d velocity(const State& now, Index i, const Eigen::Array3d& preferred, const StepContext& c, std::size_t thread);

  // After every step: counts the agents without a collision-free velocity, or asks for a shorter step because of them.
  Step end(const StepContext& c) const;

 private:
  struct PerThread;
  // What agent i may do about those found near it.
  void forbid(const State& now, Index i, std::span<const Neighbours::Found> found, const StepContext& c, PerThread& mine) const;

  struct PerThread {
    Neighbours::Scratch nearest;
    std::vector<FourNeighbours> near;
    std::vector<HalfSpace> allowed, scratch;
    std::uint64_t infeasible = 0;
  };

  int dims_;
  Infeasible infeasible_;
  Limits limits_{};
  Neighbours around_;
  std::vector<double> hint_;  // distance of the last neighbour found, by row
  std::vector<PerThread> threads_;
};

}  // namespace swarmfit
