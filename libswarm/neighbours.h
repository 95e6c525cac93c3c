// SPDX-License-Identifier: MIT
// Who is near whom. A cell grid for a fixed radius, all pairs for small groups (faster there, and the oracle of the tests), k nearest.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "libswarm/state.h"
#include "libswarm/world.h"

namespace swarmfit {

// Reusable search structure of one run; allocates only when a group outgrows all before it.
//
//   near.build(now.pos, world.bounds, radius);
//   near.visit(i, [&](Index j, const Eigen::Array3d& offset, double distance) { ... });
//
// Positions are copied in the order of their cells, so that neighbours in space are neighbours in memory. A place in that order is a slot.
// In a periodic box everybody is met once, at the nearest image, also when the radius exceeds half the box.
class Neighbours {
 public:
  enum class Method { automatic, all_pairs, grid };

  // automatic: all pairs below this many agents, where they beat the grid (bench/simulate_bench.cpp). Depends on nothing but the number of
  // agents, so that the order of summation, and with it the last bits, is the same wherever the agents are.
  static constexpr Index kAllPairsBelow = 400;

  struct Found {
    double distance2;  // squared distance [unit²]
    Index slot;
  };
  struct Run {
    Index first, end;  // slots first .. end-1
  };
  // What one thread needs for `nearest`; reused from call to call.
  struct Scratch {
    std::vector<Found> found;
    std::vector<double> distance2;
    std::vector<std::uint32_t> slots;
    std::vector<Run> runs;
  };

  // Positions must be finite.
  void build(const Rows& pos, const Bounds& bounds, double radius, Method method = Method::automatic);

  // Reports every j != i with |offset| < radius, offset = separation(i, j), in an order that depends only on the positions.
  template <class Visit>
  void visit(Index i, Visit&& visit) const {
    const Index self = slot(i);
    if (all_pairs_) return visit_from(0, self, visit);
    Candidates block;
    double distance2[kBlock + 1];
    std::uint32_t slots[kBlock + 1];
    const auto flush = [&] {
      const std::size_t count = within(self, radius_, block.runs, block.count, distance2, slots);
      for (std::size_t k = 0; k < count; ++k) visit(row(slots[k]), offset(self, slots[k]), std::sqrt(distance2[k]));
      block.clear();
    };
    for_each_run(i, radius_, [&](Index first, Index end) { block.add(first, end, flush); });
    flush();
  }

  // The same for j > i only, in ascending order. For all pairs.
  template <class Visit>
  void visit_later(Index i, Visit&& visit) const {
    assert(all_pairs_);
    visit_from(i + 1, i, visit);
  }

  // For kernels that do their own distance test: run(first, end) is called for ranges of slots that together hold everybody nearer to i
  // than `radius`, i itself, and others besides; no slot twice.
  template <class Take>
  void for_each_run(Index i, double radius, Take&& run) const;

  // The at most k nearest with distance < radius, ascending; equal distances by row. `hint` is a guess of the distance of the k-th and
  // becomes that distance: last step's makes the search fast, a wrong or zero one costs only time. Valid until the scratch is used again.
  std::span<const Found> nearest(Index i, std::size_t k, double radius, double& hint, Scratch& scratch) const;

  Index size() const { return static_cast<Index>(row_.size()); }
  Index row(Index slot) const { return row_[static_cast<std::size_t>(slot)]; }
  Index slot(Index row) const { return slot_[static_cast<std::size_t>(row)]; }
  std::span<const Index> rows() const { return row_; }                          // by slot
  const double* coordinate(std::size_t axis) const { return x_[axis].data(); }  // by slot

  bool periodic() const { return periodic_; }
  double period(std::size_t axis) const { return axes_[axis].period; }

  // separation(a, b) of two slots.
  Eigen::Array3d offset(Index a, Index b) const {
    const auto along = [&](std::size_t axis) {
      const double d = x_[axis][static_cast<std::size_t>(b)] - x_[axis][static_cast<std::size_t>(a)];
      return periodic_ ? shortest(d, axes_[axis].period) : d;
    };
    return {along(0), along(1), along(2)};
  }

  // The shorter way round of two places in [0, period); period 0: no wrapping.
  static double shortest(double d, double period) {
    const double half = 0.5 * period;
    return d > half ? d - period : (d < -half ? d + period : d);
  }

 private:
  // Cells along one axis: cell c covers low + [c, c + 1) · edge.
  struct Axis {
    double low = 0, period = 0, edge = 1, per_edge = 1;
    Index cells = 1;
    double cell(double x) const { return std::floor((x - low) * per_edge); }
    Index clamped(double x) const { return static_cast<Index>(std::clamp((x - low) * per_edge, 0.0, static_cast<double>(cells - 1))); }
  };
  // Runs of slots that are gone through together, kBlock slots at a time.
  static constexpr Index kBlock = 256;
  struct Candidates {
    static constexpr std::size_t kRuns = 64;
    Run runs[kRuns];
    std::size_t count = 0;
    Index slots = 0;
    void clear() { count = 0, slots = 0; }
    template <class Flush>
    void add(Index first, Index end, Flush&& flush) {
      while (first < end) {
        if (count == kRuns || slots == kBlock) flush();
        const Index upto = std::min(end, first + kBlock - slots);
        runs[count++] = {first, upto};
        slots += upto - first;
        first = upto;
      }
    }
  };
  static constexpr double kMargin = 1e-9;  // of a cell: an agent may lie outside its cell by rounding
  // Cells first .. last of an axis that come within reach of x; they may lie outside 0 .. cells-1 and wrap around.
  struct Span {
    Index first, last;
    bool all;
  };
  template <class Visit>
  void visit_from(Index begin, Index self, Visit& visit) const;
  Span span(const Axis& axis, double x, double reach) const;
  static double gap(const Axis& axis, Index cell, double x);
  static Index wrapped(Index cell, Index cells) { return cell < 0 ? cell + cells : (cell >= cells ? cell - cells : cell); }
  std::size_t gather(Index i, double radius, Scratch& scratch) const;
  std::size_t gather_all(double radius, Scratch& scratch) const;
  std::span<const Found> sorted(std::size_t k, std::size_t count, Scratch& scratch) const;
  // Those of the runs' slots, in order and without oneself, that are nearer than `radius`, with |offset(self, s)|². Both have room for all
  // of them and one more: what is not kept is written too.
  std::size_t within(Index self, double radius, const Run* runs, std::size_t count, double* distance2, std::uint32_t* slots) const;
  // take(s) for every s < n whose distance2 is below the limit, in ascending order; skips the others without a branch for each.
  template <class Take>
  static void for_each_below(const double* distance2, Index n, double limit2, Take&& take) {
    for (Index first = 0; first < n; first += kMask)
      for (std::uint64_t mask = below(distance2 + first, std::min(kMask, n - first), limit2); mask != 0; mask &= mask - 1)
        take(first + std::countr_zero(mask));
  }
  // Bit s: distance2[s] < limit2, of at most kMask.
  static std::uint64_t below(const double* distance2, Index n, double limit2);
  static constexpr Index kMask = 64;
  // |offset(self, s)|² for the slots first .. end-1.
  void squared_distances(Index self, Index first, Index end, double* out) const;
  void lay_grid(const Rows& pos, const Bounds& bounds);
  void sort_into_cells(const Rows& pos);

  double radius_ = 0;
  bool periodic_ = false, all_pairs_ = true;
  std::array<Axis, 3> axes_;
  std::array<std::vector<double>, 3> x_;  // by slot
  std::vector<Index> row_, slot_;         // row of a slot, slot of a row
  std::vector<Index> cell_, cell_first_;  // cell of a row; first slot of a cell
};

inline Neighbours::Span Neighbours::span(const Axis& axis, double x, double reach) const {
  const double margin = kMargin * axis.edge;
  if (axis.period <= 0) return {axis.clamped(x - reach - margin), axis.clamped(x + reach + margin), false};
  const double first = axis.cell(x - reach - margin), last = axis.cell(x + reach + margin);
  if (last - first + 1 >= static_cast<double>(axis.cells)) return {0, axis.cells - 1, true};
  return {static_cast<Index>(first), static_cast<Index>(last), false};
}

// Distance from x to a cell's nearer face; 0 inside, and 0 rather than a rounding error too much.
inline double Neighbours::gap(const Axis& axis, Index cell, double x) {
  const double low = axis.low + static_cast<double>(cell) * axis.edge;
  return std::max({0.0, low - x, x - low - axis.edge}) * (1 - kMargin);
}

template <class Visit>
void Neighbours::visit_from(Index begin, Index self, Visit& visit) const {
  constexpr Index block = 128;
  double distance2[block];
  for (Index first = begin; first < size(); first += block) {
    const Index end = std::min(first + block, size());
    squared_distances(self, first, end, distance2);
    for_each_below(distance2, end - first, radius_ * radius_, [&](Index k) {
      const Index s = first + k;
      if (s != self) visit(row(s), offset(self, s), std::sqrt(distance2[k]));
    });
  }
}

template <class Take>
void Neighbours::for_each_run(Index i, double radius, Take&& run) const {
  if (all_pairs_) return run(Index{0}, size());
  const auto self = static_cast<std::size_t>(slot(i));
  const double x = x_[0][self], y = x_[1][self], z = x_[2][self];
  const auto cells = [&](Index begin, Index end) {  // cells begin .. end of one row along x are contiguous
    const Index first = cell_first_[static_cast<std::size_t>(begin)], last = cell_first_[static_cast<std::size_t>(end + 1)];
    if (first < last) run(first, last);
  };
  const Span zs = span(axes_[2], z, radius), ys = span(axes_[1], y, radius);
  for (Index cz = zs.first; cz <= zs.last; ++cz) {
    const double dz = zs.all ? 0 : gap(axes_[2], cz, z);
    for (Index cy = ys.first; cy <= ys.last; ++cy) {
      const double dy = ys.all ? 0 : gap(axes_[1], cy, y);
      const double rest = radius * radius - dz * dz - dy * dy;
      if (rest < 0) continue;
      const Index nx = axes_[0].cells;
      const Index base = (wrapped(cz, axes_[2].cells) * axes_[1].cells + wrapped(cy, axes_[1].cells)) * nx;
      const Span xs = span(axes_[0], x, std::sqrt(rest));
      if (xs.first < 0) cells(base + xs.first + nx, base + nx - 1);
      cells(base + std::max<Index>(xs.first, 0), base + std::min(xs.last, nx - 1));
      if (xs.last >= nx) cells(base, base + xs.last - nx);
    }
  }
}

}  // namespace swarmfit
