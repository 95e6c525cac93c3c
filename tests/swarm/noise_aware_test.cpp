// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

constexpr double kScale = 0.8, kGain = 1.3, kCage = 3;

Lane caged(const Made& made, int dims = 3) {
  Lane lane = crowd(made, 0, 1, 1, 1, dims);
  set(made, lane, "scale", kScale);
  set(made, lane, "gain", kGain);
  set(made, lane, "cage", kCage);
  return lane;
}

// The velocity field at these places: that of agents after a step too short to move them.
std::vector<Array3d> velocity(const std::vector<Array3d>& places, const char* model = "noise_aware", int dims = 3) {
  const Made made = make(model, dims);
  Lane lane = caged(made, dims);
  for (const Array3d& x : places) lane.state.spawn(0, x, {0, 0, 0});
  run(made, {.frame_dt = 1e-13, .frames = 2}, lane);
  std::vector<Array3d> v(places.size());
  for (Index i = 0; i < lane.state.size(); ++i)  // rows of a large group move; ids count from 0
    v[lane.state.id[static_cast<std::size_t>(i)]] = lane.state.vel.row(i).transpose();
  return v;
}

// Uniform in the shell between two radii.
Array3d place(std::uint32_t k, double inner, double outer, int dims = 3) {
  const double r = inner + (outer - inner) * Rng{5}.uniform(Stream::probe, 0, k, 1);
  return r * random_direction(Rng{5}, Stream::probe, 0, k, 0, dims);
}

// The paper's potential, equations 2 and 3, written down again.
Array3d potential(const NoiseField& field, const Array3d& x) {
  const Array3d p = kGain * field.potential(x / kScale);
  const double r = std::sqrt(x.square().sum()), t = std::clamp((kCage - r) / kScale, 0.0, 1.0);
  const double alpha = 15. / 8 * t - 10. / 8 * t * t * t + 3. / 8 * std::pow(t, 5);
  const Array3d n = x / r;
  return alpha * p + (1 - alpha) * (n * p).sum() * n;
}

TEST(NoiseAware, AwayFromTheCageVelocityIsTheCurlOfTheSeed) {
  const NoiseField field(Rng{1});  // the seed of `crowd`
  for (std::uint32_t k = 0; k < 20; ++k) {
    const Array3d x = place(k, 0, kCage - kScale - 1e-6);
    EXPECT_LT((velocity({x})[0] - kGain / kScale * field.curl(x / kScale)).abs().maxCoeff(), 1e-9);
    const Array3d flat = place(k, 0, kCage - kScale - 1e-6, 2);
    EXPECT_LT((velocity({flat}, "noise_aware", 2)[0] - kGain / kScale * field.curl2(flat / kScale)).abs().maxCoeff(), 1e-9);
  }
}

// Inside the ramp against central differences of the potential.
TEST(NoiseAware, NearTheCageVelocityIsTheCurlOfTheBentPotential) {
  const NoiseField field(Rng{1});
  const double h = 1e-5;
  for (std::uint32_t k = 0; k < 200; ++k) {
    const Array3d x = place(k, kCage - kScale, kCage);
    std::array<Array3d, 3> slope;  // of the potential along each axis
    for (Index axis = 0; axis < 3; ++axis) {
      Array3d step = Array3d::Zero();
      step[axis] = h;
      slope[static_cast<std::size_t>(axis)] = (potential(field, x + step) - potential(field, x - step)) / (2 * h);
    }
    const Array3d curl(slope[1][2] - slope[2][1], slope[2][0] - slope[0][2], slope[0][1] - slope[1][0]);
    EXPECT_LT((velocity({x})[0] - curl).abs().maxCoeff(), 1e-6) << k;
  }
}

// Everywhere, the ramp and both sides of it included: the largest divergence, times scale² / gain, as for the noise itself.
TEST(NoiseAware, FieldIsFreeOfDivergence) {
  const double h = 1e-3 * kScale;
  for (const int dims : {2, 3}) {
    std::vector<Array3d> places;
    const std::uint32_t samples = 3000;
    for (std::uint32_t k = 0; k < samples; ++k)
      for (Index axis = 0; axis < dims; ++axis)
        for (const double side : {-h, h}) {
          places.push_back(place(k, 0.2, kCage - 2 * h, dims));
          places.back()[axis] += side;
        }
    const auto v = velocity(places, "noise_aware", dims);
    double worst = 0;
    std::size_t next = 0;
    for (std::uint32_t k = 0; k < samples; ++k) {
      double divergence = 0;
      for (Index axis = 0; axis < dims; ++axis, next += 2) divergence += (v[next + 1][axis] - v[next][axis]) / (2 * h);
      worst = std::max(worst, std::abs(divergence));
    }
    EXPECT_LT(worst * kScale * kScale / kGain, 5e-4) << dims;
  }
}

TEST(NoiseAware, FlowIsTangentialAtTheCageAndBeyond) {
  for (const int dims : {2, 3})
    for (std::uint32_t k = 0; k < 50; ++k) {
      const Array3d on = place(k, kCage, kCage, dims), beyond = 1.7 * on;
      for (const Array3d& x : {on, beyond}) {
        const Array3d v = velocity({x}, "noise_aware", dims)[0];
        EXPECT_NEAR((v * x).sum() / kCage, 0, 1e-12);
      }
    }
}

TEST(NoiseAware, NobodyLeavesTheCage) {
  for (const char* model : {"noise_aware", "noise_aware[noise=perlin]", "noise_aware[noise=white]"})
    for (const int dims : {2, 3})
      for (const double dt : {0.01, 1.0}) {
        const Made made = make(model, dims);
        Lane lane = caged(made, dims);
        for (std::uint32_t k = 0; k < 100; ++k) lane.state.spawn(0, place(k, 0, kCage, dims), {0, 0, 0});
        lane.state.spawn(0, {2 * kCage, 0, 0}, {0, 0, 0});  // outside from the start
        run(made, {.frame_dt = dt, .frames = 1001}, lane);
        const Eigen::ArrayXd r = lane.state.pos.square().rowwise().sum().sqrt();
        EXPECT_LE(r.head(100).maxCoeff(), kCage * (1 + 1e-12)) << model << dims << dt;
        EXPECT_LE(r[100], 2 * kCage * (1 + 1e-12));
        EXPECT_GT(r.head(100).maxCoeff(), 0.8 * kCage);  // the cage was met
      }
}

// Without divergence a uniform swarm stays uniform: the share within the radius that halves the volume is binomial, n = 1500. The band is
// 4.4 standard errors (level 1e-5). Perlin noise has sinks.
TEST(NoiseAware, CurlNoiseKeepsAUniformSwarmUniform) {
  const auto inner_share = [](const char* model) {
    const Made made = make(model);
    Lane lane = caged(made);
    for (std::uint32_t k = 0; k < 1500; ++k) {
      const double r = kCage * std::cbrt(Rng{9}.uniform(Stream::probe, 0, k));
      lane.state.spawn(0, r * random_direction(Rng{9}, Stream::probe, 1, k, 0, 3), {0, 0, 0});
    }
    run(made, {.frame_dt = 0.02, .frames = 301}, lane);
    const Eigen::ArrayXd r = lane.state.pos.square().rowwise().sum().sqrt();
    std::set<std::array<long, 3>> cells;  // of edge 0.5
    for (Index i = 0; i < r.size(); ++i)
      cells.insert({std::lround(2 * lane.state.pos(i, 0)), std::lround(2 * lane.state.pos(i, 1)), std::lround(2 * lane.state.pos(i, 2))});
    return std::pair((r < kCage * std::cbrt(0.5)).cast<double>().mean(), cells.size());
  };
  const auto [curl, curl_cells] = inner_share("noise_aware");
  const auto [perlin, perlin_cells] = inner_share("noise_aware[noise=perlin]");
  EXPECT_NEAR(curl, 0.5, 4.4 * 0.5 / std::sqrt(1500.0));
  EXPECT_GT(curl_cells, 2 * perlin_cells);
}

// All three noises are equally fast, to within 4 %: over 20 seeds, because a plane through the three-dimensional lattice is a little faster
// or slower depending on where it cuts.
TEST(NoiseAware, NoisesHaveTheSameRootMeanSquareSpeed) {
  for (const int dims : {2, 3})
    for (const char* model : {"noise_aware", "noise_aware[noise=perlin]", "noise_aware[noise=white]"}) {
      const Made made = make(model, dims);
      double square = 0;
      const std::uint64_t seeds = 20;
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        Lane lane = caged(made, dims);
        lane.rng = {seed};
        set(made, lane, "cage", 40);
        for (std::uint32_t k = 0; k < 1000; ++k) lane.state.spawn(0, place(k, 0, 30, dims), {0, 0, 0});
        run(made, {.frame_dt = 1e-13, .frames = 2}, lane);
        square += lane.state.vel.square().rowwise().sum().mean() / static_cast<double>(seeds);
      }
      EXPECT_NEAR(std::sqrt(square) / (kGain / kScale) / (dims == 2 ? 1.00 : 1.72), 1, 0.04) << model << dims;
    }
}

TEST(NoiseAware, WhiteVelocitiesLastAsLongAsAskedForWhateverTheStep) {
  const Made made = make("noise_aware[noise=white]");
  const auto after = [&](int substeps) {
    Lane lane = caged(made);
    set(made, lane, "hold", 0.1);
    lane.state.spawn(0, {0, 0, 0}, {0, 0, 0});
    run(made, {.frame_dt = 0.1, .substeps = substeps, .frames = 4}, lane);
    return Array3d(lane.state.pos.row(0).transpose());
  };
  EXPECT_LT((after(1) - after(7)).abs().maxCoeff(), 1e-12);
  EXPECT_GT(after(1).abs().maxCoeff(), 0.01);
}

// Midpoint steps: halving them quarters the error.
TEST(NoiseAware, StreamLinesConvergeWithTheSecondPowerOfTheStep) {
  const Made made = make("noise_aware");
  const auto end = [&](int substeps) {
    Lane lane = caged(made);
    for (std::uint32_t k = 0; k < 20; ++k) lane.state.spawn(0, place(k, 0, 1), {0, 0, 0});
    run(made, {.frame_dt = 0.02, .substeps = substeps, .frames = 6}, lane);
    return lane.state.pos;
  };
  const Rows best = end(64);
  const double coarse = (end(1) - best).abs().maxCoeff(), fine = (end(2) - best).abs().maxCoeff();
  EXPECT_LT(coarse, 0.01);
  EXPECT_NEAR(coarse / fine, 4, 1);
}

// ---- where the cage is ----------------------------------------------------------------------------------------------------------

Tracks recording(const std::vector<Array3d>& places) {
  TrackColumns columns;
  columns.pos.resize(static_cast<Index>(places.size()), 3);
  for (std::size_t k = 0; k < places.size(); ++k) {
    columns.names.push_back(std::to_string(k));
    columns.track.push_back(static_cast<std::uint32_t>(k));
    columns.frame.push_back(0);
    columns.pos.row(static_cast<Index>(k)) = places[k].transpose();
  }
  TrackMeta meta;
  meta.dt = 0.1;
  return {columns, meta};
}

// Does an agent at x move along the radius about `centre`, if it does at all? Only inside the cage it may.
double radial_speed(const Tracks* reference, const Bounds& bounds, const Array3d& centre, const Array3d& x) {
  const ModelChoice choice = parse_model("noise_aware");
  swarmfit::Setup setup;
  setup.reference = reference;
  const Made made{choice, make_model(choice, setup)};
  Lane lane = caged(made);
  lane.world.bounds = bounds;
  lane.state.spawn(0, x, {0, 0, 0});
  run(made, {.frame_dt = 1e-13, .frames = 2}, lane);
  const Array3d out = (x - centre) / (x - centre).matrix().norm();
  return std::abs((Array3d(lane.state.vel.row(0).transpose()) * out).sum());
}

TEST(NoiseAware, CageIsTheSphericalArena) {
  Bounds bounds;
  bounds.kind = Bounds::Kind::sphere;
  bounds.centre = {5, 6, 7};
  bounds.radius = 2;
  const Array3d direction(0.6, 0, 0.8);
  EXPECT_LT(radial_speed(nullptr, bounds, bounds.centre, bounds.centre + 2 * direction), 1e-12);
  EXPECT_GT(radial_speed(nullptr, bounds, bounds.centre, bounds.centre + 1.5 * direction), 1e-3);
}

TEST(NoiseAware, CageHoldsTheRecording) {
  const Array3d middle(10, 20, 30), direction(0, 0.6, 0.8);
  const Tracks small = recording({middle + Array3d(1, 0, 0), middle - Array3d(1, 0, 0)});
  const Tracks large = recording({middle + Array3d(9, 0, 0), middle - Array3d(9, 0, 0)});
  EXPECT_LT(radial_speed(&small, {}, middle, middle + kCage * direction), 1e-12);  // larger than the recording: as given
  EXPECT_GT(radial_speed(&large, {}, middle, middle + kCage * direction), 1e-3);
  EXPECT_LT(radial_speed(&large, {}, middle, middle + 9 * direction), 1e-12);
}

}  // namespace
}  // namespace swarmfit
