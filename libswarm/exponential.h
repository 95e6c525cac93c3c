// SPDX-License-Identifier: MIT
#pragma once

#include "libtrack/hot.h"

namespace swarmfit {

// e^x of four numbers, each within [-700, 700], to 1e-15 of the value. To be inlined in what SWARMFIT_HOT marks: the same bits in both
// versions, and on machines whose standard libraries differ.
inline __attribute__((always_inline)) void exponential(const Lanes& x, Lanes& out) {
  constexpr double log2e = 1.4426950408889634, high = 0x1.62e42feep-1, low = 1.90821492927058770002e-10;  // log(2) = high + low
  constexpr double round = 0x1.8p52;  // adding it leaves the nearest integer in the lowest bits
  const Lanes shifted = x * log2e + round;
  const Lanes k = shifted - round;
  const Lanes r = (x - k * high) - k * low;  // |r| <= log(2) / 2, where Taylor's series to r^13 errs by 4e-18
  const Lanes r2 = r * r, r4 = r2 * r2;
  const Lanes a = (1.0 / 2 + r * (1.0 / 6)) + r2 * (1.0 / 24 + r * (1.0 / 120));
  const Lanes b = (1.0 / 720 + r * (1.0 / 5040)) + r2 * (1.0 / 40320 + r * (1.0 / 362880));
  const Lanes c = (1.0 / 3628800 + r * (1.0 / 39916800)) + r2 * (1.0 / 479001600 + r * (1.0 / 6227020800));
  const Lanes p = 1 + (r + r2 * (a + r4 * (b + r4 * c)));
  LaneMask bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  bits = (bits + 1023) << 52;
  Lanes power;
  std::memcpy(&power, &bits, sizeof power);
  out = p * power;
}

}  // namespace swarmfit
