// SPDX-License-Identifier: MIT
// The fit bounds are stated in a recording's own scales so that a search does not waste itself on absurd speeds: at least a quarter of
// random candidates of every model must move within a factor two of the recorded mean speed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "fit/experiment/conditions.h"
#include "fit/experiment/objective.h"
#include "fit/experiment/plant.h"
#include "fit/model_fit/search_space.h"
#include "libtrack/cut.h"
#include "libtrack/read/read.h"

namespace swarmfit {
namespace {

constexpr int kCandidates = 300;  // a share of 0.3 then has a standard error of 0.026; with a hundred it falls below a quarter by chance

// Every model, and what the presets of compare make of bswarm.
std::vector<std::string> choices() {
  std::vector<std::string> all{"bswarm[noise=perlin]",    "bswarm[noise=gaussian]",   "bswarm[noise=white]",        "bswarm[noise=none]",
                               "bswarm[interaction=off]", "brownian[friction=depot]", "brownian[interaction=morse]"};
  for (const ModelSpec& spec : models()) all.emplace_back(spec.name);
  return all;
}

Point random_point(int dimensions, std::uint32_t id) {
  Point x(dimensions);
  for (int k = 0; k < dimensions; ++k) x[k] = Rng{7}.uniform(Stream::probe, 0, id, static_cast<std::uint32_t>(k));
  return x;
}

int about_as_fast(const std::string& name, const Tracks& recording) {
  const auto model = parse_model(name);
  const Conditions conditions = make_conditions(recording, {});
  const Target target(metric_samples(recording), Binning::standard(Normalisation::reference));
  const Objective objective(model, conditions, target);
  const SearchSpace space(model, conditions.scales, {});
  std::vector<std::vector<double>> candidates;
  for (std::uint32_t k = 0; k < kCandidates; ++k) candidates.push_back(space.parameters(random_point(space.dimensions(), k)));
  int near = 0;
  for (const auto& outcome : objective.evaluate(candidates, replicate_seeds({1}, Stream::replicate, 1))) {
    const double ratio = outcome.distributions[kSpeed].moments.mean / conditions.scales.speed;
    near += outcome.failed == 0 && ratio > 0.5 && ratio < 2;
  }
  return near;
}

void expect_a_quarter(const Tracks& recording) {
  for (const std::string& name : choices()) {
    const auto dims = parse_model(name).spec->dims;
    if (std::find(dims.begin(), dims.end(), recording.dims()) == dims.end()) continue;  // models of motion in a plane
    const int near = about_as_fast(name, recording);
    testing::Test::RecordProperty(name, near);  // in the XML report
    EXPECT_GE(near, kCandidates / 4) << name << ": " << near;
  }
}

std::string recorded(const char* path) { return std::string(SWARMFIT_SOURCE_DIR) + "/../shared/data/" + path; }

// Enough for a mean speed: several times as long as motion takes to become new.
constexpr std::int64_t kFrames = 150;

TEST(RandomCandidates, MoveAboutAsFastAsTheDemo) { expect_a_quarter(cut(demo_recording(), 0, kFrames)); }

TEST(RandomCandidates, MoveAboutAsFastAsMidges) {
  const auto path = recorded("midge-lab-3d/BiologicalSwarmTimeSeries.txt");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "SKIPPED: the midge recording is not at " << path;
  ReadOptions options;
  options.columns = "id,x,y,z,t,vx,vy,vz,ax,ay,az";
  options.unit = "mm";
  options.frames = Interval{0, kFrames};
  expect_a_quarter(read_tracks(path, options));
}

TEST(RandomCandidates, MoveAboutAsFastAsJackdaws) {
  const auto path = recorded("jackdaw-flocks-3d/transit_05.mat");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "SKIPPED: the jackdaw recording is not at " << path;
  ReadOptions options;
  options.unit = "m";
  options.frames = Interval{100, 100 + kFrames};
  expect_a_quarter(read_tracks(path, options));
}

}  // namespace
}  // namespace swarmfit
