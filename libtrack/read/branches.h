// SPDX-License-Identifier: MIT
// Tracks that split and merge, cut into individuals.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace swarmfit {

// The edges of a track, each from an earlier spot to a later one, as indices of spots.
using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

// The individuals in it: spots that follow each other without a split or a merge between them. Where a track splits or merges, those
// before end and those after begin. Spots in order of `frame`; individuals by their first spot, ties by its index.
std::vector<std::vector<std::uint32_t>> branches(const Edges& edges, const std::vector<double>& frame);

}  // namespace swarmfit
