// SPDX-License-Identifier: MIT
#include "libeval/spacing.h"

#include <cmath>
#include <numbers>

namespace swarmfit {

double uniform_volume(double determinant, int dims) {
  return dims == 3 ? 4.0 / 3.0 * std::numbers::pi * std::pow(5, 1.5) * std::sqrt(determinant)
                   : 4 * std::numbers::pi * std::sqrt(determinant);
}

double poisson_nearest(int dims) { return dims == 3 ? 0.55396 : 0.5; }

}  // namespace swarmfit
