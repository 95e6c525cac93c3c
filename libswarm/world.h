// SPDX-License-Identifier: MIT
// The surroundings of the agents. The world advances between steps; models only read it.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "libswarm/state.h"
#include "libtrack/rng.h"

namespace swarmfit {

// Shape of the arena and what its boundary does.
struct Bounds {
  enum class Kind { open, box, sphere, periodic };
  enum class Wall { reflect, slip };  // reflect: the normal velocity changes sign; slip: it becomes zero

  Kind kind = Kind::open;
  Wall wall = Wall::reflect;
  Eigen::Array3d lower = Eigen::Array3d::Zero(), upper = Eigen::Array3d::Zero();  // box, periodic
  Eigen::Array3d centre = Eigen::Array3d::Zero();                                 // sphere
  double radius = 0;                                                              // sphere

  // b - a, the shortest way round in a periodic box.
  Eigen::Array3d separation(const Eigen::Array3d& a, const Eigen::Array3d& b) const;
  // Brings every agent back inside; axes from `dims` on are left alone.
  void confine(State& state, int dims) const;
  void confine(State& state, int dims, Index row) const;  // one of them
};

// A moment between two steps: sub-step `sub` (0 .. substeps-1) after frame `frame`.
struct Clock {
  std::int64_t frame;
  int sub;
  double t;   // [s]
  double dt;  // of the step to come [s]
  Rng rng{};  // the lane's: parts that draw (arrivals, wandering stimuli) differ between replicates
};

class World;

// A part of the world beyond its bounds: stimuli, obstacles, goals, grids, entrances and exits. A model that needs a kind of part asks
// for it by type (World::part), so new kinds of part never change World or the models that ignore them.
struct WorldPart {
  virtual ~WorldPart() = default;
  virtual std::unique_ptr<WorldPart> clone() const = 0;
  // Called before every step, in the order in which parts were added: may move the part itself, and let agents appear or leave. It may
  // read the other parts, so that a cost field can follow its goals.
  virtual void advance(const Clock&, const World&, State&) {}
  // Called after every step: walls bring whoever crossed them back. Both states have the same agents in the same rows.
  virtual void constrain(const World&, const State& /*before*/, State& /*after*/) const {}
};

class World {
 public:
  int dims = 3;
  Bounds bounds;

  World() = default;
  World(const World& other) { *this = other; }
  World& operator=(const World& other);
  World(World&&) = default;
  World& operator=(World&&) = default;

  void add(std::unique_ptr<WorldPart> part) { parts_.push_back(std::move(part)); }

  // The first part of this type, or null.
  template <class Part>
  const Part* part() const {
    for (const auto& p : parts_)
      if (const auto* found = dynamic_cast<const Part*>(p.get())) return found;
    return nullptr;
  }

  void advance(const Clock& clock, State& state) {
    for (const auto& p : parts_) p->advance(clock, *this, state);
  }

  // Keeps everybody within the bounds and on the right side of all walls, whatever the model knows of them.
  void constrain(const State& before, State& after) const {
    bounds.confine(after, dims);
    for (const auto& p : parts_) p->constrain(*this, before, after);
  }

 private:
  std::vector<std::unique_ptr<WorldPart>> parts_;
};

// Entrances and exits as recorded: each agent enters at a frame with a given position, and with a velocity known up to a normal error that
// every run draws anew, and leaves after another frame.
class Presence : public WorldPart {
 public:
  struct Visit {
    std::uint32_t id;
    std::uint8_t kind;
    std::int64_t enter, leave;  // first and last frame
    Eigen::Array3d pos, vel;
    Eigen::Array3d vel_error = Eigen::Array3d::Zero();  // standard deviation per axis
  };
  explicit Presence(std::vector<Visit> visits);
  std::unique_ptr<WorldPart> clone() const override { return std::make_unique<Presence>(*this); }
  void advance(const Clock&, const World&, State&) override;

 private:
  void see_off(std::int64_t frame, State& state);
  void welcome(std::span<const Visit* const> newcomers, const Clock& clock, State& state);

  std::shared_ptr<const std::vector<Visit>> visits_;  // by entry, then id; shared by all copies
  std::size_t entered_ = 0;                           // visits begun so far
  std::map<std::uint32_t, std::int64_t> leave_;       // last frame of those who are here
  std::int64_t first_leave_ = INT64_MAX;              // the earliest of them, or earlier
  std::int64_t done_ = INT64_MIN;                     // last frame handled
};

}  // namespace swarmfit
