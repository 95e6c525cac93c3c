// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "libtrack/tracks.h"

namespace swarmfit {

// All agents at one moment, as a structure of arrays. Row numbers change when agents appear or leave, and when a run puts a large group
// into the order of its places; ids never do.
struct State {
  Rows pos;                        // position [unit]; z = 0 in two dimensions
  Rows vel;                        // velocity [unit/s]
  std::vector<std::uint32_t> id;   // stable name of the agent: random numbers and recorded tracks are keyed by it
  std::vector<std::uint8_t> kind;  // sheep 0, shepherd 1, ...: defined by the model or scenario
  Eigen::ArrayXXd own;             // the model's named private columns, agents × columns (ModelSpec::columns)
  std::uint32_t next_id = 0;       // id of the next agent that is spawned without one
  Index entered = 0;               // rows from here on have appeared since Model::enter was last called

  Index size() const { return pos.rows(); }

  // Appends agents at rest, with zero private columns and ids from next_id on; returns the row of the first. For many at once: appending
  // moves everybody.
  Index append(Index count);

  // Appends an agent and returns its row; its private columns start at 0. With no id given it takes next_id.
  Index spawn(std::uint8_t kind, const Eigen::Array3d& position, const Eigen::Array3d& velocity);
  Index spawn(std::uint8_t kind, const Eigen::Array3d& position, const Eigen::Array3d& velocity, std::uint32_t id);

  // Removes a row; the order of the others is kept.
  void remove(Index row);

  // Row k becomes what row order[k] was; `order` is a permutation.
  void reorder(std::span<const Index> order);
};

}  // namespace swarmfit
