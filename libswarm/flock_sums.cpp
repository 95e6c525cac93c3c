// SPDX-License-Identifier: MIT
#include "libswarm/flock_sums.h"

#include "libtrack/hot.h"

namespace swarmfit {
namespace {

constexpr int kLanes = 4;
using Block = double[kLanes];

// The agent in whose view the others are, and the limits of what it sees, squared.
struct View {
  double p[3], v[3], inner2, outer2, period[3];
};

// Places and velocities by slot.
struct Slots {
  const double *p[3], *v[3];
};

// Sums so far, lane by lane.
struct Sums {
  Block apart[3]{}, turn[3]{}, join[3]{};
};

// Branch-free, so that the lanes go through one instruction together. The agent itself adds zeros.
template <bool periodic>
inline __attribute__((always_inline)) void add_block(const Slots& at, const View& view, Sums& sums) {
#pragma omp simd
  for (int l = 0; l < kLanes; ++l) {
    double dx = at.p[0][l] - view.p[0], dy = at.p[1][l] - view.p[1], dz = at.p[2][l] - view.p[2];
    if constexpr (periodic) {
      dx = Neighbours::shortest(dx, view.period[0]);
      dy = Neighbours::shortest(dy, view.period[1]);
      dz = Neighbours::shortest(dz, view.period[2]);
    }
    const double d2 = dx * dx + dy * dy + dz * dz;
    const double seen = d2 < view.outer2 ? 1.0 : 0.0;
    const double near = d2 < view.inner2 ? 1.0 : 0.0;
    const double inverse = (d2 > 0 ? near : 0.0) / (d2 > 0 ? d2 : 1.0);
    sums.apart[0][l] -= inverse * dx;
    sums.apart[1][l] -= inverse * dy;
    sums.apart[2][l] -= inverse * dz;
    sums.turn[0][l] += seen * (at.v[0][l] - view.v[0]);
    sums.turn[1][l] += seen * (at.v[1][l] - view.v[1]);
    sums.turn[2][l] += seen * (at.v[2][l] - view.v[2]);
    sums.join[0][l] += seen * dx;
    sums.join[1][l] += seen * dy;
    sums.join[2][l] += seen * dz;
  }
}

// Slots first .. end-1; the last block is filled up with the agent itself.
template <bool periodic>
inline __attribute__((always_inline)) void add_run(const Slots& all, Index first, Index end, const View& view, Sums& sums) {
  Index s = first;
  for (; s + kLanes <= end; s += kLanes)
    add_block<periodic>({{all.p[0] + s, all.p[1] + s, all.p[2] + s}, {all.v[0] + s, all.v[1] + s, all.v[2] + s}}, view, sums);
  if (s == end) return;
  Block p[3], v[3];
  for (int axis = 0; axis < 3; ++axis)
    for (Index l = 0; l < kLanes; ++l) {
      p[axis][l] = s + l < end ? all.p[axis][s + l] : view.p[axis];
      v[axis][l] = s + l < end ? all.v[axis][s + l] : view.v[axis];
    }
  add_block<periodic>({{p[0], p[1], p[2]}, {v[0], v[1], v[2]}}, view, sums);
}

SWARMFIT_HOT void add_open(const Slots& all, Index first, Index end, const View& view, Sums& sums) {
  add_run<false>(all, first, end, view, sums);
}

SWARMFIT_HOT void add_periodic(const Slots& all, Index first, Index end, const View& view, Sums& sums) {
  add_run<true>(all, first, end, view, sums);
}

Eigen::Array3d total(const Block (&sums)[3]) {
  Eigen::Array3d out;
  for (int axis = 0; axis < 3; ++axis) out[axis] = (sums[axis][0] + sums[axis][1]) + (sums[axis][2] + sums[axis][3]);
  return out;
}

}  // namespace

void SlotVelocities::take(const Neighbours& neighbours, const Rows& vel) {
  const auto rows = neighbours.rows();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    v_[axis].resize(rows.size());
    for (std::size_t s = 0; s < rows.size(); ++s) v_[axis][s] = vel(rows[s], static_cast<Index>(axis));
  }
}

FlockSums flock_sums(const Neighbours& neighbours, const SlotVelocities& velocities, Index i, double inner, double outer) {
  Slots all{};
  View view{{}, {}, inner * inner, outer * outer, {}};
  const Index self = neighbours.slot(i);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all.p[axis] = neighbours.coordinate(axis);
    all.v[axis] = velocities.component(axis);
    view.p[axis] = all.p[axis][self];
    view.v[axis] = all.v[axis][self];
    view.period[axis] = neighbours.period(axis);
  }
  const auto add = neighbours.periodic() ? add_periodic : add_open;
  Sums sums;
  neighbours.for_each_run(i, outer, [&](Index first, Index end) { add(all, first, end, view, sums); });
  return {total(sums.apart), total(sums.turn), total(sums.join)};
}

}  // namespace swarmfit
