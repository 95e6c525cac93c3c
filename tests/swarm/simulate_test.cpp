// SPDX-License-Identifier: MIT
#include "libswarm/simulate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <set>

#include "libtrack/error.h"
#include "tests/swarm/lane.h"

namespace {
std::atomic<long> allocations{0};
}

// Every allocation of this test program is counted. Not inlined, or the compiler sees free() meet new and complains.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace swarmfit {
namespace {

using Eigen::Array3d;
using testing::ElementsAre;

// Flies straight on, writes down every step it is asked for, and refuses steps longer than `longest`.
struct Straight : Model {
  struct Asked {
    double t, dt;
    std::uint64_t tick;
    bool can_halve;
    double p;
  };
  double longest = 1e9, blow_up_at = 1e9;
  mutable std::vector<Asked> asked;
  mutable std::vector<Index> entered;

  Index columns() const override { return 1; }
  void enter(State& state, Index first, const World&, const StepContext&) const override {
    for (Index i = first; i < state.size(); ++i) {
      entered.push_back(state.id[static_cast<std::size_t>(i)]);
      state.own(i, 0) = 100 + state.id[static_cast<std::size_t>(i)];
    }
  }
  Step step(const State& now, State& next, const World&, const StepContext& c) const override {
    asked.push_back({c.t, c.dt, c.tick, c.can_halve, c.p.empty() ? 0 : c.p[0]});
    if (c.dt > longest && c.can_halve) return Step::halve_dt;
    if (c.t >= blow_up_at) return Step::blew_up;
    for (Index i = 0; i < now.size(); ++i) EXPECT_EQ(next.own(i, 0), 100 + now.id[static_cast<std::size_t>(i)]);
    next.vel = now.vel;
    next.pos = now.pos + c.dt * now.vel;
    return Step::done;
  }
};

Lane straight_lane(Recorded* out) {
  Lane lane;
  lane.out = out;
  lane.state.spawn(0, {0, 0, 0}, {1, 0, 0});
  return lane;
}

TEST(Simulate, EmitsEveryFrameAndStepsBetween) {
  Straight model;
  Recorded out;
  Lane lane = straight_lane(&out);
  cpu_backend().run(model, {.frame_dt = 0.5, .substeps = 2, .first_frame = 10, .frames = 4}, {&lane, 1});
  ASSERT_EQ(out.moments.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(out.moments[k].frame, static_cast<std::int64_t>(10 + k));
    EXPECT_DOUBLE_EQ(out.moments[k].pos(0, 0), 0.5 * static_cast<double>(k));
  }
  EXPECT_EQ(lane.count.agent_steps, 6u);
  EXPECT_DOUBLE_EQ(model.asked[1].t, 5.25);
  EXPECT_DOUBLE_EQ(model.asked[1].dt, 0.25);
}

TEST(Simulate, HalvesStepsWithRandomNumbersOfTheirOwn) {
  Straight model;
  model.longest = 0.3;
  Recorded out;
  Lane lane = straight_lane(&out);
  cpu_backend().run(model, {.frame_dt = 1, .frames = 3}, {&lane, 1});
  EXPECT_DOUBLE_EQ(out.moments[2].pos(0, 0), 2);
  EXPECT_EQ(lane.count.halved_steps, 6u);  // per frame: the whole and both halves
  EXPECT_EQ(lane.count.agent_steps, 8u);
  std::set<std::uint64_t> ticks;
  for (const auto& asked : model.asked)
    if (asked.dt <= model.longest) ticks.insert(asked.tick);
  EXPECT_EQ(ticks.size(), 8u);
}

TEST(Simulate, HalvesAtMostThrice) {
  Straight model;
  model.longest = 0;
  Lane lane = straight_lane(nullptr);
  cpu_backend().run(model, {.frame_dt = 1, .frames = 2}, {&lane, 1});
  EXPECT_EQ(lane.count.agent_steps, 8u);
  EXPECT_FALSE(model.asked[3].can_halve);
  EXPECT_DOUBLE_EQ(model.asked[3].dt, 0.125);
  EXPECT_FALSE(lane.blew_up);
}

TEST(Simulate, HalvingWhereItMayNotBeIsAnError) {
  struct Stubborn : Straight {
    Step step(const State&, State&, const World&, const StepContext&) const override { return Step::halve_dt; }
  };
  Lane lane = straight_lane(nullptr);
  try {
    cpu_backend().run(Stubborn{}, {.frame_dt = 0.5, .first_frame = 4, .frames = 3}, {&lane, 1});
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(),
                 "model unnamed: asks for half a step at 2 s, after 3 halvings; expected a step as long as it is where it may not halve");
  }
}

TEST(Simulate, StopsWhenMotionBlowsUp) {
  const Plan plan{.frame_dt = 1, .frames = 10, .speed_limit = 5};
  const auto frames_with = [&](Straight& model, double speed) {
    Recorded out;
    Lane lane = straight_lane(&out);
    lane.state.vel(0, 0) = speed;
    cpu_backend().run(model, plan, {&lane, 1});
    EXPECT_TRUE(lane.blew_up);
    return out.moments.size();
  };
  Straight model;
  EXPECT_EQ(frames_with(model, 6), 1u);
  EXPECT_EQ(frames_with(model, std::nan("")), 1u);
  EXPECT_EQ(frames_with(model, INFINITY), 1u);
  model.blow_up_at = 3;
  EXPECT_EQ(frames_with(model, 1), 4u);
  Lane lane = straight_lane(nullptr);
  lane.state.vel(0, 0) = INFINITY;
  cpu_backend().run(Straight{}, {.frame_dt = 1, .frames = 10}, {&lane, 1});
  EXPECT_TRUE(lane.blew_up);  // without any speed limit too
}

TEST(Simulate, NewcomersGetTheirPrivateColumns) {
  Straight model;
  Recorded out;
  Lane lane = straight_lane(&out);
  lane.world.add(
      std::make_unique<Presence>(std::vector<Presence::Visit>{{8, 0, 1, 2, {0, 0, 0}, {0, 0, 0}}, {8, 0, 3, 9, {1, 1, 1}, {0, 0, 0}}}));
  cpu_backend().run(model, {.frame_dt = 1, .frames = 5}, {&lane, 1});
  EXPECT_THAT(model.entered, ElementsAre(0, 8, 8));
  EXPECT_THAT(out.moments[0].id, ElementsAre(0));
  EXPECT_THAT(out.moments[1].id, ElementsAre(0, 8));
  EXPECT_EQ(out.moments[3].pos(1, 0), 1);
}

TEST(Simulate, SchedulesMoveParameters) {
  Straight model;
  Lane lane = straight_lane(nullptr);
  lane.p = {7};
  Plan plan{.frame_dt = 1, .frames = 6, .schedules = {{0, {{1, 10}, {3, 20}}}}};
  cpu_backend().run(model, plan, {&lane, 1});
  std::vector<double> seen;
  for (const auto& asked : model.asked) seen.push_back(asked.p);
  EXPECT_THAT(seen, ElementsAre(10, 10, 15, 20, 20));
  EXPECT_EQ(lane.p[0], 7);
}

TEST(Simulate, NobodyIsNoProblem) {
  Straight model;
  Recorded out;
  Lane lane;
  lane.out = &out;
  cpu_backend().run(model, {.frame_dt = 1, .frames = 3}, {&lane, 1});
  EXPECT_EQ(out.moments.size(), 3u);
}

TEST(Simulate, SubstepsFollowTheTimeScale) {
  ModelSpec spec{};
  spec.largest_dt = 0.1;
  const Scales scales{.extent = 2, .spacing = 1, .speed = 4};  // T = 0.5 s
  const ModelChoice choice{&spec, {}, "straight"};
  EXPECT_EQ(stable_steps(choice, scales, 0.01), 1);
  EXPECT_EQ(stable_steps(choice, scales, 0.05), 1);
  EXPECT_EQ(stable_steps(choice, scales, 0.051), 2);
  EXPECT_EQ(stable_steps(choice, scales, 1), 20);
  spec.map = "always";
  EXPECT_EQ(stable_steps(choice, scales, 1), 1);
  spec.map = {};
  spec.largest_dt = INFINITY;
  EXPECT_EQ(stable_steps(choice, scales, 1), 1);
}

// 200 steps more cost no allocation more, but for buffers that meet a denser crowd than any before.
TEST(Simulate, StepsDoNotAllocate) {
  for (const char* name : {"bswarm", "bswarm[noise=white,infeasible=min_penetration]", "boids"})
    for (const Index agents : {60, 500}) {
      const Made made = make(name);
      const auto count = [&](std::int64_t frames) {
        Lane lane = crowd(made, agents, 6, 0.5);
        const long before = allocations;
        run(made, {.frame_dt = 0.01, .frames = frames}, lane);
        return allocations - before;
      };
      const long some = count(20), more = count(120);
      EXPECT_LE(more - some, 10) << name << ", " << agents << " agents: " << some << " and " << more;
    }
}

}  // namespace
}  // namespace swarmfit
