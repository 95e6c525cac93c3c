// SPDX-License-Identifier: MIT
#include "libeval/nearest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <numeric>
#include <tuple>

#include "libeval/metrics.h"
#include "libtrack/hot.h"

namespace swarmfit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// From here on the tree beats all pairs (measured on normal clouds: equal at about 270, twice as fast at 800).
constexpr Index kTreeFrom = 280;

// The individuals of one frame, in ascending track number.
struct Cloud {
  const double *x, *y, *z;
  Index count;

  double squared_distance(Index i, Index j) const {
    const double dx = x[i] - x[j], dy = y[i] - y[j], dz = z[i] - z[j];
    return dx * dx + dy * dy + dz * dz;
  }

  // What nanoflann asks of a point set.
  std::size_t kdtree_get_point_count() const { return static_cast<std::size_t>(count); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return (axis == 0 ? x : axis == 1 ? y : z)[i]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

// For `many` individuals from i on, so that they wait less for each other's comparisons, with the others four at a time. Everybody is met
// in ascending order, so the strict comparisons leave ties with the lowest, in each lane and at the end.
template <int many>
inline __attribute__((always_inline)) void against_all(const Cloud& cloud, Index i, double* squared, Index* who) {
  const Index blocks = cloud.count / 4 * 4;
  Lanes least[many], nearest[many], index{0, 1, 2, 3};
  for (int k = 0; k < many; ++k) least[k] = Lanes{} + kInfinity, nearest[k] = Lanes{} - 1;
  for (Index j = 0; j < blocks; j += 4, index += 4) {
    Lanes x, y, z;
    load(cloud.x + j, x), load(cloud.y + j, y), load(cloud.z + j, z);
    for (int k = 0; k < many; ++k) {
      const Lanes dx = cloud.x[i + k] - x, dy = cloud.y[i + k] - y, dz = cloud.z[i + k] - z;
      const Lanes d2 = dx * dx + dy * dy + dz * dz;
      const auto closer = (d2 < least[k]) & (index != static_cast<double>(i + k));
      least[k] = closer ? d2 : least[k];
      nearest[k] = closer ? index : nearest[k];
    }
  }
  for (int k = 0; k < many; ++k) {
    double best = kInfinity, row = -1;
    for (int l = 0; l < 4; ++l)
      if (least[k][l] < best || (least[k][l] == best && nearest[k][l] < row)) best = least[k][l], row = nearest[k][l];
    for (Index j = blocks; j < cloud.count; ++j) {
      const double d2 = cloud.squared_distance(i + k, j);
      if (j != i + k && d2 < best) best = d2, row = static_cast<double>(j);
    }
    squared[i + k] = best;
    who[i + k] = static_cast<Index>(row);
  }
}

SWARMFIT_HOT void all_pairs(const Cloud& cloud, double* squared, Index* who) {
  Index i = 0;
  for (; i + 4 <= cloud.count; i += 4) against_all<4>(cloud, i, squared, who);
  for (; i < cloud.count; ++i) against_all<1>(cloud, i, squared, who);
}

// nanoflann's result set for "the nearest other, the lowest index among equals".
class NearestOther {
 public:
  NearestOther(Index self, double& squared, Index& who) : self_(self), squared_(squared), who_(who) {}
  std::size_t size() const { return who_ >= 0; }
  bool full() const { return true; }
  bool addPoint(double squared, std::size_t index) {
    const auto i = static_cast<Index>(index);
    if (i != self_ && (squared < squared_ || (squared == squared_ && i < who_))) squared_ = squared, who_ = i;
    return true;
  }
  // A little more than the best so far: equals must come through, and the tree's bounds carry rounding of their own.
  double worstDist() const { return squared_ * (1 + 1e-12) + std::numeric_limits<double>::min(); }

 private:
  Index self_;
  double& squared_;
  Index& who_;
};

// Ends at the first that shares its place with another, and says so: among many in one place a tree is slower than all pairs.
bool by_tree(const Cloud& cloud, double* squared, Index* who) {
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, std::size_t>;
  const Tree tree(3, cloud);
  for (Index i = 0; i < cloud.count; ++i) {
    const double point[3] = {cloud.x[i], cloud.y[i], cloud.z[i]};
    NearestOther result(i, squared[i], who[i]);
    tree.findNeighbors(result, point, nanoflann::SearchParams());
    if (squared[i] == 0) return false;
  }
  return true;
}

// The same with the individuals of one place together: they have each other, and the others meet the lowest of them.
void by_places(const Cloud& cloud, double* squared, Index* who) {
  const auto place = [&](Index i) { return std::tuple(cloud.x[i], cloud.y[i], cloud.z[i]); };
  std::vector<Index> order(static_cast<std::size_t>(cloud.count));
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return std::tuple(place(a), a) < std::tuple(place(b), b); });
  std::fill_n(squared, cloud.count, kInfinity);
  std::fill_n(who, cloud.count, Index{-1});
  std::vector<Index> lowest;
  for (std::size_t k = 0, end = 0; k < order.size(); k = end) {
    while (end < order.size() && place(order[end]) == place(order[k])) ++end;
    lowest.push_back(order[k]);
    for (std::size_t m = k; m < end && end - k > 1; ++m) squared[order[m]] = 0, who[order[m]] = order[m == k ? k + 1 : k];
  }
  if (static_cast<Index>(lowest.size()) == cloud.count) return all_pairs(cloud, squared, who);  // apart by so little that its square is 0
  std::sort(lowest.begin(), lowest.end());
  Rows apart(static_cast<Index>(lowest.size()), 3);
  for (Index i = 0; i < apart.rows(); ++i) {
    const Index row = lowest[static_cast<std::size_t>(i)];
    apart.row(i) << cloud.x[row], cloud.y[row], cloud.z[row];
  }
  const NearestOthers others = nearest_others(apart);
  for (std::size_t i = 0; i < lowest.size(); ++i) {
    const Index row = lowest[i];
    if (who[row] >= 0 || others.row[i] < 0) continue;
    who[row] = lowest[static_cast<std::size_t>(others.row[i])];
    squared[row] = cloud.squared_distance(row, who[row]);
  }
}

// Of the individuals of a cloud; their rows are counted from `first`.
void nearest_in(const Cloud& cloud, bool tree, Index first, double* distance, Index* who) {
  if (!tree)
    all_pairs(cloud, distance, who);
  else if (!by_tree(cloud, distance, who))
    by_places(cloud, distance, who);
  for (Index i = 0; i < cloud.count; ++i) {
    distance[i] = std::sqrt(distance[i]);
    if (who[i] >= 0) who[i] += first;
  }
}

}  // namespace

Nearest nearest_neighbours(const Tracks& tracks, NearestMethod method) {
  const Rows& pos = tracks.pos();
  const auto n = static_cast<std::size_t>(tracks.rows());
  Nearest out{std::vector<Index>(n, -1), std::vector<double>(n, kInfinity)};
  for (const FrameRange& frame : tracks.frames()) {
    const Index first = frame.first;
    const Cloud cloud{pos.col(0).data() + first, pos.col(1).data() + first, pos.col(2).data() + first, frame.count};
    const bool tree = method == NearestMethod::tree || (method == NearestMethod::automatic && frame.count >= kTreeFrom);
    nearest_in(cloud, tree, first, out.distance.data() + first, out.row.data() + first);
  }
  return out;
}

NearestOthers nearest_others(const Rows& places) {
  const auto n = static_cast<std::size_t>(places.rows());
  NearestOthers out{std::vector<Index>(n, -1), std::vector<double>(n, kInfinity)};
  const Cloud cloud{places.col(0).data(), places.col(1).data(), places.col(2).data(), places.rows()};
  nearest_in(cloud, places.rows() >= kTreeFrom, 0, out.distance.data(), out.row.data());
  return out;
}

}  // namespace swarmfit
