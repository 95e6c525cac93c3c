// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libswarm/headings.h"
#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
constexpr double kSpeed = 0.03;

// Agents at random in a periodic square or cube; one step per frame, as published.
Lane torus(const Made& made, Index agents, double side, int dims) {
  Lane lane = crowd(made, agents, side, kSpeed, 3, dims);
  lane.world.bounds.kind = Bounds::Kind::periodic;
  lane.world.bounds.upper.head(dims).setConstant(side);
  return lane;
}

double order(const Rows& vel) {
  const double n = static_cast<double>(vel.rows());
  return std::sqrt((vel.colwise().sum() / n / kSpeed).square().sum());
}

// Order in every frame after the first `skip`.
std::vector<double> orders(const Made& made, Lane lane, std::int64_t frames, std::size_t skip) {
  Recorded out;
  lane.out = &out;
  run(made, {.frame_dt = 1, .frames = frames}, lane);
  std::vector<double> all;
  for (std::size_t k = skip; k < out.moments.size(); ++k) all.push_back(order(out.moments[k].vel));
  return all;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

// Two agents within the radius, flying along x and y, and one alone: with eta = 0 the two take the bisector, itself included in the mean.
// The old direction still moves them for one step, the new one for the next.
TEST(Vicsek, OneStep) {
  for (const bool old : {true, false}) {
    const Made made = make(old ? "vicsek" : "vicsek[update=new]", 2);
    Lane lane = crowd(made, 0, 1, 1, 1, 2);
    set(made, lane, "eta", 0);
    lane.state.spawn(0, {0, 0, 0}, {kSpeed, 0, 0});
    lane.state.spawn(0, {0.5, 0, 0}, {0, kSpeed, 0});
    lane.state.spawn(0, {0, -1.5, 0}, {-kSpeed, 0, 0});
    run(made, {.frame_dt = 1, .frames = 2}, lane);
    const Array3d bisector = Array3d(1, 1, 0) * kSpeed / std::sqrt(2.0);
    for (Index i = 0; i < 2; ++i) EXPECT_LT((lane.state.vel.row(i).transpose() - bisector).abs().maxCoeff(), 1e-15);
    EXPECT_LT((lane.state.vel.row(2).transpose() - Array3d(-kSpeed, 0, 0)).abs().maxCoeff(), 1e-15);
    const Array3d moved = old ? Array3d(kSpeed, 0, 0) : bisector;
    EXPECT_LT((lane.state.pos.row(0).transpose() - moved).abs().maxCoeff(), 1e-15) << old;
  }
}

TEST(Vicsek, WithoutNoiseEverybodyAligns) {
  for (const int dims : {2, 3})
    for (const char* model : {"vicsek", "vicsek[update=new]", "vicsek[noise=vectorial]"}) {
      const Made made = make(model, dims);
      Lane lane = torus(made, 150, 4, dims);
      set(made, lane, "eta", 0);
      set(made, lane, "eta_vectorial", 0);
      EXPECT_GT(orders(made, lane, 401, 400)[0], 1 - 1e-6) << model << dims;
    }
}

// At eta = 2π the mean direction is forgotten: N order² has mean 1 (in two dimensions it is exponential). 400 frames: 5 standard errors
// are 0.25 (level 6e-7).
TEST(Vicsek, FullNoiseLeavesNoOrder) {
  const Index n = 200;
  for (const int dims : {2, 3}) {
    const Made made = make("vicsek", dims);
    Lane lane = torus(made, n, 5, dims);
    set(made, lane, "eta", 2 * std::numbers::pi);
    auto all = orders(made, lane, 401, 1);
    for (double& v : all) v *= v * static_cast<double>(n);
    EXPECT_NEAR(mean(all), 1, 0.25) << dims;
  }
}

// The published transition, at the density of the first figure: order falls all the way, from nearly 1 to nearly 0.
TEST(Vicsek, OrderFallsWithNoise) {
  for (const char* model : {"vicsek", "vicsek[noise=vectorial]"}) {
    const Made made = make(model, 2);
    const bool scalar = std::string_view(model) == "vicsek";
    double before = 1;
    for (const double eta : {0.08, 0.25, 0.42, 0.58, 0.75, 0.92}) {
      Lane lane = torus(made, 196, 7, 2);
      set(made, lane, "eta", 2 * std::numbers::pi * eta);
      set(made, lane, "eta_vectorial", eta);
      const double now = mean(orders(made, lane, 501, 200));
      EXPECT_LT(now, before) << model << eta;
      if (eta == 0.08) {
        EXPECT_GT(now, 0.95);
      }
      before = now;
    }
    EXPECT_LT(before, scalar ? 0.2 : 0.3) << model;
  }
}

// Agents too far apart to see each other: scalar noise turns each by an angle uniform on [-eta/2, eta/2], vectorial noise adds a vector of
// length eta. 3000 agents; the mean angle to within 5 standard errors.
TEST(Vicsek, NoiseIsAsLargeAsItSays) {
  const double eta = 1.2;
  for (const int dims : {2, 3})
    for (const bool vectorial : {false, true}) {
      const Made made = make(vectorial ? "vicsek[noise=vectorial,update=new]" : "vicsek[update=new]", dims);
      Lane lane = crowd(made, 0, 1, 1, 1, dims);
      set(made, lane, "eta", eta);
      set(made, lane, "eta_vectorial", eta / 2);
      const int n = 3000;
      const Array3d u = dims == 2 ? Array3d(0.6, 0.8, 0) : Array3d(0.36, 0.48, 0.8);
      for (int k = 0; k < n; ++k) lane.state.spawn(0, {3.0 * k, 0, 0}, kSpeed * u);
      run(made, {.frame_dt = 1, .frames = 2}, lane);
      double sum = 0, widest = 0;
      Array3d drift = Array3d::Zero();
      for (Index i = 0; i < n; ++i) {
        const Array3d v = lane.state.vel.row(i).transpose() / kSpeed;
        const double angle = angle_between(v, u);
        EXPECT_NEAR(v.square().sum(), 1, 1e-12);
        sum += angle;
        widest = std::max(widest, angle);
        drift += (v - (v * u).sum() * u) / n;
      }
      EXPECT_LT(std::sqrt(drift.square().sum()), 5 * 0.35 / std::sqrt(n));  // to no side: root mean square of the sine is 0.33
      EXPECT_LE(widest, vectorial ? std::asin(eta / 2) + 1e-9 : eta / 2 + 1e-9);
      EXPECT_GT(widest, 0.97 * (vectorial ? std::asin(eta / 2) : eta / 2));
      if (!vectorial) {
        EXPECT_NEAR(sum / n, eta / 4, 5 * eta / 4 / std::sqrt(3.0 * n));
      }
    }
}

// Decisions belong to multiples of tau: the same path for any number of steps between, also where the interval is the recording's.
TEST(Vicsek, PathDoesNotDependOnTheStep) {
  TrackColumns columns;
  columns.names = {"a"};
  columns.track = {0};
  columns.frame = {0};
  columns.pos = Rows::Zero(1, 3);
  TrackMeta meta;
  meta.dt = 0.1;
  const Tracks recording(columns, meta);
  for (const char* model : {"vicsek", "vicsek[update=new]", "vicsek[noise=vectorial]"})
    for (const bool recorded : {false, true}) {
      const ModelChoice choice = parse_model(model);
      swarmfit::Setup setup;
      if (recorded) setup.reference = &recording;
      const Made made{choice, make_model(choice, setup)};
      const auto end = [&](int substeps, double frame_dt) {
        Lane lane = torus(made, 60, 3, 3);
        if (recorded) set(made, lane, "tau", 0);
        run(made, {.frame_dt = frame_dt, .substeps = substeps, .frames = 1 + std::lround((recorded ? 2 : 20) / frame_dt)}, lane);
        return lane.state;
      };
      const double tau = recorded ? 0.1 : 1;
      const State one = end(1, tau), many = end(7, tau), frames = end(1, tau / 4);
      EXPECT_LT((one.pos - many.pos).abs().maxCoeff(), 1e-9) << model << recorded;
      EXPECT_LT((one.vel - many.vel).abs().maxCoeff(), 1e-9) << model << recorded;
      EXPECT_LT((one.pos - frames.pos).abs().maxCoeff(), 1e-9) << model << recorded;
    }
}

TEST(Vicsek, WhoHasNoDirectionGetsOne) {
  const Made made = make("vicsek", 2);
  Lane lane = crowd(made, 0, 1, 1, 1, 2);
  for (int k = 0; k < 50; ++k) lane.state.spawn(0, {3.0 * k, 0, 0}, {0, 0, 0});
  run(made, {.frame_dt = 1, .frames = 2}, lane);
  EXPECT_LT((lane.state.vel.square().rowwise().sum().sqrt() - kSpeed).abs().maxCoeff(), 1e-12);
  EXPECT_LT(order(lane.state.vel), 0.6);
}

}  // namespace
}  // namespace swarmfit
