// SPDX-License-Identifier: MIT
// Groups of places that are connected by links.
#pragma once

#include "libeval/group/moment.h"

namespace swarmfit {

// Places less than `link` apart [unit] are linked, the shortest way round where `period` says so (Moment). All pairs for small groups, a
// k-d tree for large ones in open space; both give the same.
enum class LinkMethod { automatic, all_pairs, tree };
Components connected(const Rows& places, double link, const Eigen::Array3d& period, LinkMethod method = LinkMethod::automatic);

}  // namespace swarmfit
