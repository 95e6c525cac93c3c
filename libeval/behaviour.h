// SPDX-License-Identifier: MIT
// Numbers by which a behaviour is told from trajectories alone: does the swarm scatter, gather, turn, arrive? For `expect` of scenario
// files.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libtrack/curve.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// What a measure may look at.
struct Witness {
  const Tracks& agents;
  const Tracks* stimuli = nullptr;                                 // where they were, as tracks; none, or null: there are none
  std::function<bool(const Eigen::Array3d&)> forbidden = nullptr;  // is nobody allowed there? null: everywhere is fine
  double enforced = 0;                                             // share of agents and steps that were pushed apart
  const Curve* curve = nullptr;                                    // that they are led along; null: there is none
  double reach = 0;                                                // of its key points
};

// Numbers by name: `from` and `until` in seconds, both included and all of it if not given; what else the measure takes.
using Questions = std::map<std::string, std::vector<double>, std::less<>>;

struct Behaviour {
  std::string_view name, meaning;
  std::vector<std::string_view> needs, may;                  // arguments: those that must be there, and those that may; each a name
  double (*of)(const Witness&, const Questions&) = nullptr;  // NaN where it is not defined
};

// All of them. A new one is one entry.
std::span<const Behaviour> behaviours();

// Throws InputError if there is no such measure, or its arguments are not what it takes.
void check_question(std::string_view measure, const Questions& asked);

// The number. With `relative_to` = [from, until] that over the same number of those times.
double observed(std::string_view measure, const Witness& seen, const Questions& asked);

}  // namespace swarmfit
