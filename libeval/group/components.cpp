// SPDX-License-Identifier: MIT
#include "libeval/group/components.h"

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>
#include <numeric>

namespace swarmfit {
namespace {

constexpr Index kTreeFrom = 400;

// Sets that are merged, each named by its lowest member (union-find with path halving).
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t root(std::size_t k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void merge(std::size_t a, std::size_t b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

void link_all_pairs(const Rows& p, double link, const Eigen::Array3d& period, Sets& sets) {
  const auto way = [&](double d, Index axis) { return period[axis] > 0 ? d - period[axis] * std::round(d / period[axis]) : d; };
  for (Index i = 0; i < p.rows(); ++i)
    for (Index j = i + 1; j < p.rows(); ++j) {
      const double dx = way(p(i, 0) - p(j, 0), 0), dy = way(p(i, 1) - p(j, 1), 1), dz = way(p(i, 2) - p(j, 2), 2);
      if (dx * dx + dy * dy + dz * dz < link * link) sets.merge(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
    }
}

// What nanoflann asks of a point set.
struct Points {
  const Rows& p;
  std::size_t kdtree_get_point_count() const { return static_cast<std::size_t>(p.rows()); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return p(static_cast<Index>(i), static_cast<Index>(axis)); }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

void link_by_tree(const Rows& p, double link, Sets& sets) {
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points>, Points, 3, std::size_t>;
  const Points points{p};
  const Tree tree(3, points);
  std::vector<std::pair<std::size_t, double>> near;
  for (Index i = 0; i < p.rows(); ++i) {
    const double place[3] = {p(i, 0), p(i, 1), p(i, 2)};
    near.clear();
    tree.radiusSearch(place, link * link, near, nanoflann::SearchParams());
    for (const auto& [j, squared] : near) sets.merge(static_cast<std::size_t>(i), j);
  }
}

}  // namespace

Components connected(const Rows& places, double link, const Eigen::Array3d& period, LinkMethod method) {
  const auto n = static_cast<std::size_t>(places.rows());
  Sets sets(n);
  const bool open = (period <= 0).all();
  if (method == LinkMethod::tree || (method == LinkMethod::automatic && open && places.rows() >= kTreeFrom))
    link_by_tree(places, link, sets);
  else
    link_all_pairs(places, link, period, sets);

  std::vector<Index> count(n, 0);
  for (std::size_t k = 0; k < n; ++k) ++count[sets.root(k)];
  std::vector<std::size_t> roots;
  for (std::size_t k = 0; k < n; ++k)
    if (count[k] > 0) roots.push_back(k);
  std::stable_sort(roots.begin(), roots.end(), [&](std::size_t a, std::size_t b) { return count[a] > count[b]; });
  Components out{std::vector<int>(n), {}};
  std::vector<int> number(n);
  for (std::size_t c = 0; c < roots.size(); ++c) number[roots[c]] = static_cast<int>(c), out.size.push_back(count[roots[c]]);
  for (std::size_t k = 0; k < n; ++k) out.of[k] = number[sets.root(k)];
  return out;
}

}  // namespace swarmfit
