// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "libswarm/world.h"

namespace swarmfit {

// Where agents are told to go: along a curve that a user drew, or to the place where a recorded track goes on.
struct Guide : WorldPart {
  // The place that this agent heads for now [unit]; none: it goes where it likes.
  virtual std::optional<Eigen::Array3d> goal(std::uint32_t id) const = 0;
};

}  // namespace swarmfit
