// SPDX-License-Identifier: MIT
// What worlds cost before anybody moves: fast marching over a cube of N³ cells with one goal in its middle, and the distance to a mesh that
// is a ball of N triangles, from places all over a cube twice as wide. Items are cells and places. And the same mesh made ready: triangles.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "libswarm/cost_field.h"
#include "libswarm/mesh.h"
#include "libtrack/rng.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

void march(benchmark::State& state) {
  const Index n = state.range(0);
  const FieldGrid grid{.lower = Array3d::Zero(), .cell = 1.0 / static_cast<double>(n), .count = {n, n, n}};
  const std::vector<double> slowness(static_cast<std::size_t>(grid.cells()), 1);
  std::vector<bool> goal(slowness.size());
  goal[static_cast<std::size_t>(grid.index(n / 2, n / 2, n / 2))] = true;
  for (auto _ : state) benchmark::DoNotOptimize(CostField(grid, slowness, goal));
  state.SetItemsProcessed(state.iterations() * grid.cells());
}

struct Ball {
  std::vector<Array3d> corners;
  std::vector<Triangle> triangles;
};

// Rings of latitude, twice as many corners in each as there are rings.
Ball ball(Index triangles) {
  using std::numbers::pi;
  const auto rings = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(triangles) / 4))) + 1, round = 2 * rings;
  Ball out;
  out.corners.emplace_back(0, 0, 1);
  for (std::uint32_t i = 1; i < rings; ++i)
    for (std::uint32_t k = 0; k < round; ++k) {
      const double polar = pi * i / rings, angle = 2 * pi * k / round;
      out.corners.emplace_back(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar));
    }
  out.corners.emplace_back(0, 0, -1);
  const auto at = [&](std::uint32_t ring, std::uint32_t k) { return 1 + (ring - 1) * round + k % round; };
  const auto last = static_cast<std::uint32_t>(out.corners.size()) - 1;
  for (std::uint32_t k = 0; k < round; ++k) {
    out.triangles.push_back({0, at(1, k), at(1, k + 1)});
    for (std::uint32_t i = 1; i + 1 < rings; ++i) {
      out.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      out.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
    out.triangles.push_back({last, at(rings - 1, k + 1), at(rings - 1, k)});
  }
  return out;
}

void distance(benchmark::State& state) {
  const Ball b = ball(state.range(0));
  const Mesh mesh(b.corners, b.triangles);
  std::vector<Array3d> places;
  for (std::uint32_t k = 0; k < 1000; ++k) {
    const auto xy = Rng{1}.uniform2(Stream::start, 0, k, 0), zu = Rng{1}.uniform2(Stream::start, 0, k, 1);
    places.emplace_back(4 * xy[0] - 2, 4 * xy[1] - 2, 4 * zu[0] - 2);
  }
  for (auto _ : state)
    for (const Array3d& place : places) benchmark::DoNotOptimize(mesh.nearest(place));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(places.size()));
}

void prepare(benchmark::State& state) {
  const Ball b = ball(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(Mesh(b.corners, b.triangles));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(b.triangles.size()));
}

BENCHMARK(march)->Name("fast marching/ours")->Arg(64)->Arg(128)->Unit(benchmark::kMillisecond);
BENCHMARK(distance)->Name("distance to a mesh/ours")->Arg(1000)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(prepare)->Name("mesh made ready/ours")->Arg(1000)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace swarmfit
