// SPDX-License-Identifier: MIT
#include "libswarm/zones.h"

#include "libtrack/hot.h"

namespace swarmfit {
namespace {

constexpr int kLanes = 4;
using Block = double[kLanes];

// Limits of the zones (squared) and the agent in whose view they are.
struct View {
  double x, y, z, inner2, from2, to2;
  double period[3];
};

// Sums so far, lane by lane.
struct Sums {
  Block nx{}, ny{}, nz{}, n{}, fx{}, fy{}, fz{}, f{}, same{};
};

// Branch-free, so that the lanes go through one instruction together.
template <bool periodic>
inline __attribute__((always_inline)) void add_block(const double* x, const double* y, const double* z, const View& view, Sums& sums) {
  constexpr double coincident2 = kCoincident * kCoincident;
#pragma omp simd
  for (int l = 0; l < kLanes; ++l) {
    double dx = x[l] - view.x, dy = y[l] - view.y, dz = z[l] - view.z;
    if constexpr (periodic) {
      dx = Neighbours::shortest(dx, view.period[0]);
      dy = Neighbours::shortest(dy, view.period[1]);
      dz = Neighbours::shortest(dz, view.period[2]);
    }
    const double d2 = dx * dx + dy * dy + dz * dz;
    const double apart = d2 < coincident2 ? 0.0 : 1.0;
    const double inverse = apart / std::sqrt(d2 < coincident2 ? 1.0 : d2);
    const double near = d2 < view.inner2 ? inverse : 0.0;
    const double upto = d2 <= view.to2 ? inverse : 0.0;
    const double far = d2 < view.from2 ? 0.0 : upto;
    sums.nx[l] += near * dx;
    sums.ny[l] += near * dy;
    sums.nz[l] += near * dz;
    sums.n[l] += near > 0 ? 1.0 : 0.0;
    sums.fx[l] += far * dx;
    sums.fy[l] += far * dy;
    sums.fz[l] += far * dz;
    sums.f[l] += far > 0 ? 1.0 : 0.0;
    sums.same[l] += 1.0 - apart;
  }
}

// Slots first .. end-1; the last block is filled up with the agent itself, which counts as coincident.
template <bool periodic>
inline __attribute__((always_inline)) void add_run(const double* x, const double* y, const double* z, Index first, Index end,
                                                   const View& view, Sums& sums) {
  Index s = first;
  for (; s + kLanes <= end; s += kLanes) add_block<periodic>(x + s, y + s, z + s, view, sums);
  if (s == end) return;
  Block tx, ty, tz;
  for (Index l = 0; l < kLanes; ++l) {
    const bool in = s + l < end;
    tx[l] = in ? x[s + l] : view.x;
    ty[l] = in ? y[s + l] : view.y;
    tz[l] = in ? z[s + l] : view.z;
    if (!in) sums.same[l] -= 1;
  }
  add_block<periodic>(tx, ty, tz, view, sums);
}

SWARMFIT_HOT void add_open(const double* x, const double* y, const double* z, Index first, Index end, const View& view, Sums& sums) {
  add_run<false>(x, y, z, first, end, view, sums);
}

SWARMFIT_HOT void add_periodic(const double* x, const double* y, const double* z, Index first, Index end, const View& view, Sums& sums) {
  add_run<true>(x, y, z, first, end, view, sums);
}

double total(const Block& lanes) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); }

}  // namespace

ZoneSums zone_sums(const Neighbours& neighbours, Index i, double inner, double outer_from, double outer_to) {
  const double *x = neighbours.coordinate(0), *y = neighbours.coordinate(1), *z = neighbours.coordinate(2);
  const Index self = neighbours.slot(i);
  const View view{x[self],
                  y[self],
                  z[self],
                  inner * inner,
                  outer_from * outer_from,
                  outer_to * outer_to,
                  {neighbours.period(0), neighbours.period(1), neighbours.period(2)}};
  const auto add = neighbours.periodic() ? add_periodic : add_open;
  Sums sums;
  neighbours.for_each_run(i, std::max(inner, outer_to), [&](Index first, Index end) { add(x, y, z, first, end, view, sums); });
  return {{total(sums.nx), total(sums.ny), total(sums.nz)},
          {total(sums.fx), total(sums.fy), total(sums.fz)},
          total(sums.n),
          total(sums.f),
          static_cast<Index>(total(sums.same)) - 1};
}

}  // namespace swarmfit
