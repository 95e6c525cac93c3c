// SPDX-License-Identifier: MIT
#include "libswarm/neighbours.h"

#include <limits>
#include <utility>

#include "libtrack/hot.h"

namespace swarmfit {
namespace {

constexpr double kPerCell = 4;        // agents per cell that a search aims at
constexpr double kCellsPerAgent = 2;  // more cells than this cost more to clear than they save
constexpr std::size_t kBeyond = 3;    // places behind the last slot that are read, four at a time, but not used
constexpr std::size_t kRanked = 32;   // this few are sorted by counting, for each, who comes before it

// Where somebody is, and the periods; 0: none.
struct Origin {
  double x, y, z;
  double period[3];
};

template <bool periodic>
inline __attribute__((always_inline)) void squares(const double* x, const double* y, const double* z, Index n, const Origin& from,
                                                   double* out) {
  for (Index s = 0; s < n; ++s) {
    double dx = x[s] - from.x, dy = y[s] - from.y, dz = z[s] - from.z;
    if constexpr (periodic) {
      dx = Neighbours::shortest(dx, from.period[0]);
      dy = Neighbours::shortest(dy, from.period[1]);
      dz = Neighbours::shortest(dz, from.period[2]);
    }
    out[s] = dx * dx + dy * dy + dz * dz;
  }
}

SWARMFIT_HOT void squares_open(const double* __restrict x, const double* __restrict y, const double* __restrict z, Index n,
                               const Origin& from, double* __restrict out) {
  squares<false>(x, y, z, n, from, out);
}

SWARMFIT_HOT void squares_periodic(const double* __restrict x, const double* __restrict y, const double* __restrict z, Index n,
                                   const Origin& from, double* __restrict out) {
  squares<true>(x, y, z, n, from, out);
}

// Appends the slots within the squared radius; distances are computed four at a time, up to three beyond a run's end.
template <bool periodic>
inline __attribute__((always_inline)) std::size_t collect(const double* x, const double* y, const double* z, const Neighbours::Run* runs,
                                                          std::size_t count, const Origin& from, double radius2, Index self,
                                                          double* distance2, std::uint32_t* slots) {
  constexpr Index block = 32;
  std::size_t found = 0;
  double d2[block];
  for (std::size_t k = 0; k < count; ++k) {
    for (Index first = runs[k].first; first < runs[k].end; first += block) {
      const Index n = std::min(block, runs[k].end - first);
      squares<periodic>(x + first, y + first, z + first, (n + 3) / 4 * 4, from, d2);
      for (Index s = 0; s < n; ++s) {  // written always, kept only by the count: no branch to mispredict
        distance2[found] = d2[s];
        slots[found] = static_cast<std::uint32_t>(first + s);
        found += static_cast<std::size_t>((d2[s] < radius2) & (first + s != self));
      }
    }
  }
  return found;
}

SWARMFIT_HOT std::size_t collect_open(const double* x, const double* y, const double* z, const Neighbours::Run* runs, std::size_t count,
                                      const Origin& from, double radius2, Index self, double* __restrict distance2,
                                      std::uint32_t* __restrict slots) {
  return collect<false>(x, y, z, runs, count, from, radius2, self, distance2, slots);
}

SWARMFIT_HOT std::size_t collect_periodic(const double* x, const double* y, const double* z, const Neighbours::Run* runs, std::size_t count,
                                          const Origin& from, double radius2, Index self, double* __restrict distance2,
                                          std::uint32_t* __restrict slots) {
  return collect<true>(x, y, z, runs, count, from, radius2, self, distance2, slots);
}

// Bit s: x[s] < limit, of at most 64.
SWARMFIT_HOT std::uint64_t bits_below(const double* x, Index n, double limit) {
  LaneMask found{}, bit{1, 2, 4, 8};
  Index s = 0;
  for (; s + 4 <= n; s += 4, bit <<= 4) {
    Lanes four;
    load(x + s, four);
    found |= (four < limit) & bit;
  }
  auto mask = static_cast<std::uint64_t>((found[0] | found[1]) | (found[2] | found[3]));
  for (; s < n; ++s) mask |= std::uint64_t{x[s] < limit} << s;
  return mask;
}

// Up to this many agents, mostly within reach, going through all is faster than finding those that are (measured).
constexpr Index kFewAgents = 24;

struct Keys {
  Lanes distance2[kRanked / 4], row[kRanked / 4];
};

// For each of the first n how many come before: nearer, or as near and with a lower row. Beyond n, to a multiple of 4, keys are infinite.
SWARMFIT_HOT void count_before(const Keys& keys, std::size_t n, std::size_t* before) {
  for (std::size_t a = 0; a < n; ++a) {
    const double distance2 = keys.distance2[a / 4][a % 4], row = keys.row[a / 4][a % 4];
    LaneMask sum{};
    for (std::size_t b = 0; b < (n + 3) / 4; ++b)
      sum -= (keys.distance2[b] < distance2) | ((keys.distance2[b] == distance2) & (keys.row[b] < row));
    before[a] = static_cast<std::size_t>((sum[0] + sum[1]) + (sum[2] + sum[3]));
  }
}

}  // namespace

void Neighbours::build(const Rows& pos, const Bounds& bounds, double radius, Method method) {
  radius_ = radius;
  periodic_ = bounds.kind == Bounds::Kind::periodic;
  all_pairs_ = method == Method::all_pairs || (method == Method::automatic && pos.rows() < kAllPairsBelow);
  const auto n = static_cast<std::size_t>(pos.rows());
  row_.resize(n);
  slot_.resize(n);
  for (auto& x : x_) x.resize(n + kBeyond);
  lay_grid(pos, bounds);
  sort_into_cells(pos);
}

// Cells no wider than the radius, with about kPerCell agents in each, and never so many that clearing them dominates: a lone stray far
// away makes the cells wider, not more.
void Neighbours::lay_grid(const Rows& pos, const Bounds& bounds) {
  std::array<double, 3> extent{};
  double volume = 1;
  int directions = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto column = static_cast<Index>(k);
    const double width = periodic_ ? bounds.upper[column] - bounds.lower[column] : 0;
    axes_[k] = {.low = bounds.lower[column], .period = width};
    if (all_pairs_ || pos.rows() == 0) continue;
    double low = pos(0, column), high = low;
    for (Index i = 1; i < pos.rows(); ++i) {
      low = std::min(low, pos(i, column));
      high = std::max(high, pos(i, column));
    }
    if (width <= 0) axes_[k].low = low;
    extent[k] = width > 0 ? width : high - low;
    if (extent[k] > 0) {
      volume *= extent[k];
      ++directions;
    }
  }
  if (all_pairs_ || directions == 0) return;
  const auto n = static_cast<double>(pos.rows());
  const auto cells = [&](std::size_t k, double edge) { return std::max(1.0, std::floor(extent[k] / edge)); };
  double edge = std::min(radius_, std::pow(volume * kPerCell / n, 1.0 / directions));
  if (!(edge > 0)) edge = *std::max_element(extent.begin(), extent.end());
  while (cells(0, edge) * cells(1, edge) * cells(2, edge) > kCellsPerAgent * n + 64) edge *= 1.25;
  for (std::size_t k = 0; k < 3; ++k) {
    axes_[k].cells = static_cast<Index>(cells(k, edge));
    if (extent[k] > 0) axes_[k].edge = extent[k] / static_cast<double>(axes_[k].cells);
    axes_[k].per_edge = 1 / axes_[k].edge;
  }
}

// Counting sort by cell; agents of one cell keep the order of their rows.
void Neighbours::sort_into_cells(const Rows& pos) {
  const auto n = static_cast<std::size_t>(pos.rows());
  const auto place = [&](std::size_t i, std::size_t k) {
    const double x = pos(static_cast<Index>(i), static_cast<Index>(k)), width = axes_[k].period;
    return width > 0 ? x - width * std::floor((x - axes_[k].low) / width) : x;
  };
  if (all_pairs_) {
    for (std::size_t i = 0; i < n; ++i) row_[i] = slot_[i] = static_cast<Index>(i);
  } else {
    cell_.resize(n);
    cell_first_.assign(static_cast<std::size_t>(axes_[0].cells * axes_[1].cells * axes_[2].cells) + 1, 0);
    for (std::size_t i = 0; i < n; ++i) {
      const Index cx = axes_[0].clamped(place(i, 0)), cy = axes_[1].clamped(place(i, 1)), cz = axes_[2].clamped(place(i, 2));
      cell_[i] = (cz * axes_[1].cells + cy) * axes_[0].cells + cx;
      ++cell_first_[static_cast<std::size_t>(cell_[i])];
    }
    Index total = 0;
    for (Index& first : cell_first_) total += std::exchange(first, total);
    for (std::size_t i = 0; i < n; ++i) {
      slot_[i] = cell_first_[static_cast<std::size_t>(cell_[i])]++;
      row_[static_cast<std::size_t>(slot_[i])] = static_cast<Index>(i);
    }
    for (std::size_t c = cell_first_.size() - 1; c > 0; --c) cell_first_[c] = cell_first_[c - 1];
    cell_first_[0] = 0;
  }
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < n; ++i) x_[k][static_cast<std::size_t>(slot_[i])] = place(i, k);
}

std::size_t Neighbours::within(Index self, double radius, const Run* runs, std::size_t count, double* distance2,
                               std::uint32_t* slots) const {
  const auto s = static_cast<std::size_t>(self);
  const Origin from{x_[0][s], x_[1][s], x_[2][s], {axes_[0].period, axes_[1].period, axes_[2].period}};
  const auto compute = periodic_ ? collect_periodic : collect_open;
  return compute(x_[0].data(), x_[1].data(), x_[2].data(), runs, count, from, radius * radius, self, distance2, slots);
}

std::uint64_t Neighbours::below(const double* distance2, Index n, double limit2) { return bits_below(distance2, n, limit2); }

void Neighbours::squared_distances(Index self, Index first, Index end, double* out) const {
  const auto s = static_cast<std::size_t>(self);
  const Origin from{x_[0][s], x_[1][s], x_[2][s], {axes_[0].period, axes_[1].period, axes_[2].period}};
  const auto compute = periodic_ ? squares_periodic : squares_open;
  compute(x_[0].data() + first, x_[1].data() + first, x_[2].data() + first, end - first, from, out);
}

// Everybody but i nearer than `radius`, in slot order.
std::size_t Neighbours::gather(Index i, double radius, Scratch& scratch) const {
  const Index self = slot(i);
  if (all_pairs_) return gather_all(radius, scratch);
  Index room = 0;
  scratch.runs.clear();
  for_each_run(i, radius, [&](Index first, Index end) {
    scratch.runs.push_back({first, end});
    room += end - first;
  });
  const auto most = static_cast<std::size_t>(room) + kBeyond + 1;
  if (scratch.slots.size() < most) scratch.slots.resize(most), scratch.distance2.resize(most), scratch.found.resize(most);
  const std::size_t count = within(self, radius, scratch.runs.data(), scratch.runs.size(), scratch.distance2.data(), scratch.slots.data());
  for (std::size_t k = 0; k < count; ++k) scratch.found[k] = {scratch.distance2[k], static_cast<Index>(scratch.slots[k])};
  return count;
}

// The same from the distances of all slots, which `nearest` has computed.
std::size_t Neighbours::gather_all(double radius, Scratch& scratch) const {
  const double* distance2 = scratch.distance2.data();
  const double limit2 = radius * radius;
  std::size_t count = 0;
  if (size() > kFewAgents) {
    for_each_below(distance2, size(), limit2, [&](Index s) { scratch.found[count++] = {distance2[s], s}; });
    return count;
  }
  for (Index s = 0; s < size(); ++s) {  // written always, kept only by the count: no branch to mispredict
    scratch.found[count] = {distance2[s], s};
    count += static_cast<std::size_t>(distance2[s] < limit2);
  }
  return count;
}

std::span<const Neighbours::Found> Neighbours::nearest(Index i, std::size_t k, double radius, double& hint, Scratch& scratch) const {
  if (all_pairs_) {
    scratch.found.resize(static_cast<std::size_t>(size()));
    scratch.slots.resize(static_cast<std::size_t>(size()));
    scratch.distance2.resize(static_cast<std::size_t>(size()));
    squared_distances(slot(i), 0, size(), scratch.distance2.data());
    scratch.distance2[static_cast<std::size_t>(slot(i))] = std::numeric_limits<double>::infinity();
  }
  // Search spheres that grow until they hold k.
  double reach = hint > 0 ? std::min(1.1 * hint, radius) : radius;
  if (hint <= 0 && !all_pairs_) {
    const auto c = static_cast<std::size_t>(cell_[static_cast<std::size_t>(i)]);
    const auto here = static_cast<double>(cell_first_[c + 1] - cell_first_[c]);
    const double edge = std::max({axes_[0].edge, axes_[1].edge, axes_[2].edge});
    reach = std::min(radius, edge * std::cbrt(static_cast<double>(k) / here));
  }
  auto count = gather(i, reach, scratch);
  while (count < k && reach < radius) {
    reach = std::min(1.5 * reach, radius);
    count = gather(i, reach, scratch);
  }
  const auto found = sorted(k, count, scratch);
  hint = found.size() == k && k > 0 ? std::sqrt(found[k - 1].distance2) : radius;
  return found;
}

// The first k of the `count` that were found.
std::span<const Neighbours::Found> Neighbours::sorted(std::size_t k, std::size_t count, Scratch& scratch) const {
  const std::size_t kept = std::min(k, count);
  const auto first = scratch.found.begin();
  if (count <= 1) return {scratch.found.data(), kept};
  if (count > kRanked) {
    const auto closer = [this](const Found& a, const Found& b) {
      return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : row(a.slot) < row(b.slot);
    };
    std::partial_sort(first, first + static_cast<std::ptrdiff_t>(kept), first + static_cast<std::ptrdiff_t>(count), closer);
    return {scratch.found.data(), kept};
  }
  Found found[kRanked];
  Keys keys;
  std::size_t before[kRanked];
  for (std::size_t a = 0; a < (count + 3) / 4 * 4; ++a) {
    if (a < count) found[a] = scratch.found[a];
    keys.distance2[a / 4][a % 4] = a < count ? found[a].distance2 : std::numeric_limits<double>::infinity();
    keys.row[a / 4][a % 4] = a < count ? static_cast<double>(row(found[a].slot)) : std::numeric_limits<double>::infinity();
  }
  count_before(keys, count, before);
  for (std::size_t a = 0; a < count; ++a) scratch.found[before[a]] = found[a];
  return {scratch.found.data(), kept};
}

}  // namespace swarmfit
