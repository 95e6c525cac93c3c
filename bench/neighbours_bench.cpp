// SPDX-License-Identifier: MIT
// Everybody's neighbours within a radius that holds about 30 of them, the search structure built anew: uniform in a box. "sorted": agents
// stand in memory in the order of their places, as runs keep large groups. Items are agents. Names are part/whose/agents.
#include <benchmark/benchmark.h>

#include <nanoflann.hpp>

#include "libswarm/neighbours.h"

namespace swarmfit {
namespace {

struct Crowd {
  Crowd(Index n, bool sorted) : pos(n, 3), radius(std::cbrt(30 / (4.19 * static_cast<double>(n)))) {
    for (Index i = 0; i < n; ++i) {
      const auto id = static_cast<std::uint32_t>(i);
      const auto xy = Rng{1}.uniform2(Stream::start, 0, id, 0);
      pos.row(i) << xy[0], xy[1], Rng{1}.uniform(Stream::start, 0, id, 1);
    }
    if (!sorted) return;
    Neighbours near;
    near.build(pos, Bounds{}, 1, Neighbours::Method::grid);
    const Rows before = pos;
    for (Index i = 0; i < n; ++i) pos.row(i) = before.row(near.row(i));
  }
  Rows pos;
  double radius;
};

void ours(benchmark::State& state, Neighbours::Method method, bool sorted) {
  const Crowd crowd(state.range(0), sorted);
  Neighbours near;
  double sum = 0;
  for (auto _ : state) {
    near.build(crowd.pos, Bounds{}, crowd.radius, method);
    for (Index i = 0; i < crowd.pos.rows(); ++i) near.visit(i, [&](Index, const Eigen::Array3d&, double distance) { sum += distance; });
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

struct Points {
  const Rows& pos;
  std::size_t kdtree_get_point_count() const { return static_cast<std::size_t>(pos.rows()); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return pos(static_cast<Index>(i), static_cast<Index>(axis)); }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

void nanoflann_tree(benchmark::State& state, bool sorted) {
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points>, Points, 3, std::size_t>;
  const Crowd crowd(state.range(0), sorted);
  const Points points{crowd.pos};
  nanoflann::SearchParams unsorted;
  unsorted.sorted = false;
  std::vector<std::pair<std::size_t, double>> found;
  double sum = 0;
  for (auto _ : state) {
    const Tree tree(3, points);
    for (Index i = 0; i < crowd.pos.rows(); ++i) {
      const double point[3] = {crowd.pos(i, 0), crowd.pos(i, 1), crowd.pos(i, 2)};
      tree.radiusSearch(point, crowd.radius * crowd.radius, found, unsorted);
      for (const auto& f : found) sum += std::sqrt(f.second);
    }
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

const bool registered = [] {
  for (const bool sorted : {false, true}) {
    const std::string part = sorted ? "neighbours, sorted" : "neighbours";
    for (const Index n : {100, 1000, 10000, 100000, 1000000}) {
      benchmark::RegisterBenchmark((part + "/ours").c_str(), ours, Neighbours::Method::automatic, sorted)->Arg(n);
      benchmark::RegisterBenchmark((part + "/nanoflann").c_str(), nanoflann_tree, sorted)->Arg(n);
      if (n <= 10000) benchmark::RegisterBenchmark((part + "/all pairs").c_str(), ours, Neighbours::Method::all_pairs, sorted)->Arg(n);
    }
  }
  return true;
}();

}  // namespace
}  // namespace swarmfit
