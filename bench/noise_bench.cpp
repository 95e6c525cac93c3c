// SPDX-License-Identifier: MIT
// Random forces: the curl of three Perlin potentials at one place, and standard normal numbers. Items are evaluations, and numbers.
// Names are part/whose.
#include <Random123/philox.h>
#include <benchmark/benchmark.h>

#include <numeric>
#include <random>

#include "libswarm/noise.h"
#ifdef BENCH_LIBNOISE
#include <libnoise/noise.h>
#endif

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Calls curl at places all over the field.
template <class Curl>
void everywhere(benchmark::State& state, Curl&& curl) {
  Array3d x(0.1, 0.2, 0.3), sum = Array3d::Zero();
  for (auto _ : state) {
    sum += curl(x);
    x += 0.137;
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations());
}

void curl_ours(benchmark::State& state) {
  const NoiseField field(Rng{1});
  everywhere(state, [&](const Array3d& x) { return field.curl(x); });
}
BENCHMARK(curl_ours)->Name("curl/ours");

#ifdef BENCH_LIBNOISE
// One octave each; it has no derivatives, so they are central differences.
void curl_libnoise(benchmark::State& state) {
  noise::module::Perlin potential[3];
  for (int k = 0; k < 3; ++k) {
    potential[k].SetOctaveCount(1);
    potential[k].SetNoiseQuality(noise::QUALITY_BEST);
    potential[k].SetSeed(k);
  }
  constexpr double h = 1e-4;
  const auto slope = [&](int k, const Array3d& x, Index axis) {
    Array3d a = x, b = x;
    a[axis] -= h, b[axis] += h;
    return (potential[k].GetValue(b[0], b[1], b[2]) - potential[k].GetValue(a[0], a[1], a[2])) / (2 * h);
  };
  everywhere(state, [&](const Array3d& x) {
    return Array3d(slope(2, x, 1) - slope(1, x, 2), slope(0, x, 2) - slope(2, x, 0), slope(1, x, 0) - slope(0, x, 1));
  });
}
BENCHMARK(curl_libnoise)->Name("curl/libnoise, central differences");
#endif

// For a hundred agents, as models draw them.
void normals_ours(benchmark::State& state) {
  std::vector<std::uint32_t> id(100);
  std::iota(id.begin(), id.end(), 0u);
  GaussianNoise noise;
  std::uint64_t tick = 0;
  for (auto _ : state) {
    noise.draw(Rng{1}, Stream::noise, ++tick, id);
    benchmark::DoNotOptimize(noise[99]);
  }
  state.SetItemsProcessed(300 * state.iterations());
}
BENCHMARK(normals_ours)->Name("normals/ours");

// Two at a time, in double precision.
void normals_random123(benchmark::State& state) {
  using Philox = r123::Philox4x32;
  Philox philox;
  std::uint32_t tick = 0;
  const auto unit = [](std::uint32_t low, std::uint32_t high) {
    return static_cast<double>((std::uint64_t{high} << 32 | low) >> 11) * 0x1.0p-53;
  };
  for (auto _ : state) {
    const Philox::ctr_type b = philox({{++tick, 7, 0, 0}}, {{1, 0}});
    const double radius = std::sqrt(-2 * std::log(1 - unit(b[0], b[1]))), angle = 2 * std::numbers::pi * unit(b[2], b[3]);
    benchmark::DoNotOptimize(radius * std::cos(angle));
    benchmark::DoNotOptimize(radius * std::sin(angle));
  }
  state.SetItemsProcessed(2 * state.iterations());
}
BENCHMARK(normals_random123)->Name("normals/Random123 and Box-Muller");

void normals_standard(benchmark::State& state) {
  std::mt19937_64 bits(1);
  std::normal_distribution<double> normal;
  for (auto _ : state) benchmark::DoNotOptimize(normal(bits));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(normals_standard)->Name("normals/std::mt19937_64, not counter-based");

}  // namespace
}  // namespace swarmfit
