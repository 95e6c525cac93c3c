// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <span>

#include "libtrack/rng.h"

namespace swarmfit {

// Three independent standard normals for each id, from draws 0 and 1 of (stream, tick, id): Box and Muller's transform of the numbers that
// Rng::normal2 uses, four at a time, with logarithm, sine and cosine of our own: the same within 4e-15, in a third of the time.
// x, y and z have room for ids.size(). What an id gets does not depend on the others.
void three_normals(const Rng& rng, Stream stream, std::uint64_t tick, std::span<const std::uint32_t> ids, double* x, double* y, double* z);

Eigen::Array3d three_normals(const Rng& rng, Stream stream, std::uint64_t tick, std::uint32_t id);

}  // namespace swarmfit
