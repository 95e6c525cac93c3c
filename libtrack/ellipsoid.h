// SPDX-License-Identifier: MIT
#pragma once

#include "libtrack/tracks.h"

namespace swarmfit {

// Places per volume of the ellipsoid (ellipse) of two standard deviations about their mean; NaN where that is flat, or there are none.
double ellipsoid_density(const Eigen::Ref<const Rows>& places, int dims);

}  // namespace swarmfit
