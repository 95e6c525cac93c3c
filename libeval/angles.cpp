// SPDX-License-Identifier: MIT
#include "libeval/angles.h"

#include "libtrack/hot.h"

namespace swarmfit {
namespace {

constexpr double kPi = 3.14159265358979323846, kPiLow = 1.2246467991473532e-16;  // pi = kPi + kPiLow

inline __attribute__((always_inline)) void angle(const Lanes& y, const Lanes& x, Lanes& out) {
  const Lanes width = x < 0 ? -x : x;
  const LaneMask steep = y > width;
  const Lanes small = steep ? width : y, large = steep ? y : width;
  // Of the quotient if it is below 0.66, or else 45 degrees and the rest.
  const LaneMask diagonal = small > 0.66 * large;
  const Lanes top = diagonal ? small - large : small;
  Lanes bottom = diagonal ? small + large : large;
  bottom = bottom == 0 ? Lanes{} + 1 : bottom;
  const Lanes t = top / bottom, z = t * t;
  const Lanes p = -6.485021904942025371773e1 +
                  z * (-1.228866684490136173410e2 +
                       z * (-7.500855792314704667340e1 + z * (-1.615753718733365076637e1 + z * -8.750608600031904122785e-1)));
  const Lanes q = 1.945506571482613964425e2 +
                  z * (4.853903996359136964868e2 +
                       z * (4.328810604912902668951e2 + z * (1.650270098316988542046e2 + z * (2.485846490142306297962e1 + z))));
  Lanes r = t * (z * (p / q)) + t;
  r = diagonal ? (kPi / 4) + (r + kPiLow / 4) : r;
  r = steep ? (kPi / 2) - (r - kPiLow / 2) : r;
  out = x < 0 ? kPi - (r - kPiLow) : r;
}

SWARMFIT_HOT void by_fours(const double* y, const double* x, Index fours, double* out) {
  for (Index k = 0; k < 4 * fours; k += 4) {
    Lanes a, b, r;
    load(y + k, a);
    load(x + k, b);
    angle(a, b, r);
    std::memcpy(out + k, &r, sizeof r);
  }
}

}  // namespace

void angles(const double* y, const double* x, Index count, double* out) {
  const Index whole = count / 4;
  by_fours(y, x, whole, out);
  if (const Index done = 4 * whole; done < count) {
    double top[4] = {}, right[4] = {}, last[4];
    for (Index k = done; k < count; ++k) top[k - done] = y[k], right[k - done] = x[k];
    by_fours(top, right, 1, last);
    for (Index k = done; k < count; ++k) out[k] = last[k - done];
  }
}

}  // namespace swarmfit
