// SPDX-License-Identifier: MIT
// What a model asks for is checked in one place, whoever makes it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libtrack/error.h"
#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using ModelSetup = swarmfit::Setup;  // not testing::Test::Setup

struct Still : Model {
  explicit Still(Index columns) : columns_(columns) {}
  Index columns() const override { return columns_; }
  Step step(const State& now, State& next, const World&, const StepContext&) const override {
    next.pos = now.pos;
    next.vel = now.vel;
    return Step::done;
  }
  Index columns_;
};

// Herds in the plane, one step per frame of the recording it learned from.
ModelSpec herd() {
  ModelSpec spec;
  spec.name = "herd";
  spec.dims = {2};
  spec.needs_reference = spec.fixed_step = true;
  spec.native_dt = 0.2;
  spec.columns = {"fear"};
  spec.kinds = {"sheep", "dog"};
  spec.options = {{.name = "dog", .values = {"barks", "bites"}, .meaning = "what it does"}};
  spec.make = [](const ModelSetup& setup) -> std::unique_ptr<Model> {
    EXPECT_EQ(setup.options.size(), 1u);
    return std::make_unique<Still>(1);
  };
  return spec;
}

Tracks plain(int dims) {
  State state;
  state.append(3);
  return recording_of(state, dims);  // one frame every 0.01 s
}

std::string error_of(const ModelSpec& spec, const ModelSetup& setup, const Options& options = {}) {
  try {
    make_model({&spec, options, spec.name}, setup);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(MakeModel, GivesWhatTheSpecSays) {
  ModelSpec spec = herd();
  spec.update = Update::sequential;
  const Tracks recording = plain(2);
  const auto model = make_model({&spec, {}, "herd[dog=barks]"}, {.dims = 2, .reference = &recording, .step = 0.01, .kinds = 2});
  EXPECT_EQ(model->name(), "herd[dog=barks]");
  EXPECT_EQ(model->update(), Update::sequential);
}

TEST(MakeModel, ChecksDimensions) {
  const Tracks flat = plain(2), solid = plain(3);
  EXPECT_EQ(error_of(herd(), {.dims = 3, .reference = &solid}), "model herd: does not move in 3 dimensions; expected 2");
  EXPECT_THAT(error_of(herd(), {.dims = 2, .reference = &solid}), HasSubstr("a recording in 3 dimensions; expected one in 2"));
  EXPECT_EQ(error_of(herd(), {.dims = 2, .reference = &flat}), "");
  EXPECT_EQ(error_of(*parse_model("boids").spec, {.dims = 1}), "model boids: does not move in 1 dimensions; expected 2 or 3");
}

TEST(MakeModel, ChecksTheReference) {
  EXPECT_THAT(error_of(herd(), {.dims = 2}), HasSubstr("model herd: cannot be made without a recording; expected one"));
}

TEST(MakeModel, ChecksTheStep) {
  const Tracks recording = plain(2);
  EXPECT_EQ(error_of(herd(), {.dims = 2, .reference = &recording, .step = 0.005}),
            "model herd: steps of 0.005 s; expected 0.01 s, the recording's frame interval");
  EXPECT_EQ(error_of(herd(), {.dims = 2, .reference = &recording}), "");
  ModelSpec free = herd();
  free.needs_reference = false;
  EXPECT_EQ(error_of(free, {.dims = 2, .step = 0.1}), "model herd: steps of 0.1 s; expected 0.2 s, the model's own step");
  EXPECT_EQ(error_of(free, {.dims = 2, .step = 0.2}), "");
  free.fixed_step = false;
  EXPECT_EQ(error_of(free, {.dims = 2, .step = 0.1}), "");
  EXPECT_TRUE(herd().is_map({}));  // fits do not halve it either
}

TEST(MakeModel, ChecksKinds) {
  const Tracks recording = plain(2);
  EXPECT_EQ(error_of(herd(), {.dims = 2, .reference = &recording, .kinds = 3}),
            "model herd: 3 kinds of agents; expected at most 2: sheep, dog");
  EXPECT_EQ(error_of(*parse_model("boids").spec, {.kinds = 200}), "");  // all agents are alike to it
}

TEST(MakeModel, ChecksOptions) {
  const Tracks recording = plain(2);
  EXPECT_THAT(error_of(herd(), {.dims = 2, .reference = &recording}, {{"dog", "sleeps"}}), HasSubstr("expected one of barks, bites"));
}

TEST(MakeModel, ChecksTheSpecItself) {
  const Tracks recording = plain(2);
  const ModelSetup setup{.dims = 2, .reference = &recording};
  ModelSpec spec = herd();
  spec.columns = {"fear", "hunger"};
  EXPECT_THAT(error_of(spec, setup), HasSubstr("has 1 private columns and names 2"));
  spec = herd();
  spec.parameters = {{.row = 1, .name = "speed"}, {.row = 0, .name = "range"}};
  EXPECT_THAT(error_of(spec, setup), HasSubstr("parameter speed is row 0 of the table and calls itself 1"));
  spec = herd();
  spec.make = {};
  EXPECT_THAT(error_of(spec, setup), AllOf(HasSubstr("model herd"), HasSubstr("no rule of motion")));
}

}  // namespace
}  // namespace swarmfit
