// SPDX-License-Identifier: MIT
#pragma once

#include "libswarm/scenario/scenario.h"
#include "libswarm/scenario/table.h"

namespace swarmfit {

// [start] of a scenario whose bounds and curve are known. Throws InputError with the place.
Start read_start(Table table, const Scenario& scene);

}  // namespace swarmfit
