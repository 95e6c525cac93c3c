// SPDX-License-Identifier: MIT
// The classifier of group states on planted motion that no simulator of ours made.
#include "libeval/group/group_state.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <numbers>

#include "tests/eval/build.h"

namespace swarmfit {
namespace {

using test::Row;
using test::tracks_of;
constexpr double kPi = std::numbers::pi;
constexpr std::uint32_t kN = 60;
constexpr std::int64_t kFrames = 120;
constexpr double kLink = 3;

using Place = std::array<double, 3>;
// Where individual i is in frame t (one frame per second); `s` a seed for what differs between recordings.
using Plant = std::function<Place(std::uint32_t i, double t, std::uint64_t s)>;

// Uniform in a disc of this radius.
Place disc(std::uint32_t i, std::uint64_t s, double radius) {
  const double r = radius * std::sqrt(test::uniform(s, 0, i, 0)), phi = 2 * kPi * test::uniform(s, 0, i, 1);
  return {r * std::cos(phi), r * std::sin(phi), 0};
}
double shake(std::uint32_t i, double t, std::uint64_t s, std::uint32_t axis) {
  return 0.02 * test::normal(s, static_cast<std::uint64_t>(t) + 1, i, axis);
}

struct Planted {
  const char* state;
  StateWords words;
  Plant place;
};

const std::vector<Planted>& planted() {
  constexpr auto group = StateWords::group, flock = StateWords::flock;
  static const std::vector<Planted> all = {
      {"swarm", group,
       [](std::uint32_t i, double t, std::uint64_t s) {  // everybody on a loop of its own within the disc
         const Place p = disc(i, s, 4);
         const double w = 0.6 + 0.6 * test::uniform(s, 1, i, 0), phase = 2 * kPi * test::uniform(s, 1, i, 1);
         return Place{p[0] + std::cos(w * t + phase), p[1] + std::sin(1.3 * w * t + phase), 0};
       }},
      {"mill", group,
       [](std::uint32_t i, double t, std::uint64_t s) {
         const double r = 3 + test::uniform(s, 0, i, 0), phi = 2 * kPi * test::uniform(s, 0, i, 1) + 0.6 / r * t;
         return Place{r * std::cos(phi), r * std::sin(phi), 0};
       }},
      {"undirected_mill", group,
       [](std::uint32_t i, double t, std::uint64_t s) {
         const double r = 3 + test::uniform(s, 0, i, 0), phi = 2 * kPi * test::uniform(s, 0, i, 1) + (i % 2 == 0 ? 0.6 : -0.6) / r * t;
         return Place{r * std::cos(phi), r * std::sin(phi), 0};
       }},
      {"aligned", group,
       [](std::uint32_t i, double t, std::uint64_t s) {
         const Place p = disc(i, s, 5);
         return Place{p[0] + 0.5 * t + shake(i, t, s, 0), p[1] + shake(i, t, s, 1), 0};
       }},
      {"moving_chain", group,
       [](std::uint32_t i, double t, std::uint64_t s) {
         return Place{20 * test::uniform(s, 0, i, 0) + 0.5 * t, 0.3 * test::normal(s, 0, i, 1) + shake(i, t, s, 1), 0};
       }},
      {"rotating_chain", group,
       [](std::uint32_t i, double t, std::uint64_t s) {  // a spoke that turns about its middle
         const double x = 20 * test::uniform(s, 0, i, 0) - 10, y = 0.3 * test::normal(s, 0, i, 1), a = 0.05 * t;
         return Place{x * std::cos(a) - y * std::sin(a), x * std::sin(a) + y * std::cos(a), 0};
       }},
      {"figure_of_eight", group,
       [](std::uint32_t i, double t, std::uint64_t s) {
         const double side = i % 2 == 0 ? 1 : -1, phi = 2 * kPi * test::uniform(s, 0, i, 1) + side * 0.2 * t,
                      r = 2 + test::uniform(s, 0, i, 0);
         return Place{3.2 * side + r * std::cos(phi), r * std::sin(phi), 0};
       }},
      {"split", group,
       [](std::uint32_t i, double t, std::uint64_t s) {
         const Place p = disc(i, s, 3);
         const double side = i % 2 == 0 ? 1 : -1;
         return Place{p[0] + side * (20 + 0.4 * t), p[1] + shake(i, t, s, 1), 0};
       }},
      {"disordered", group,
       [](std::uint32_t i, double t, std::uint64_t s) {  // a gas, far apart
         const Place p = disc(i, s, 60);
         const double phi = 2 * kPi * test::uniform(s, 2, i, 0);
         return Place{p[0] + 0.4 * t * std::cos(phi), p[1] + 0.4 * t * std::sin(phi), 0};
       }},
      {"vortex", flock,
       [](std::uint32_t i, double t, std::uint64_t s) {  // in both senses, radii from 2 to 6
         const double r = 2 + 4 * test::uniform(s, 0, i, 0), phi = 2 * kPi * test::uniform(s, 0, i, 1) + (i % 2 == 0 ? 0.5 : -0.5) / r * t;
         return Place{r * std::cos(phi), r * std::sin(phi), 0};
       }},
      {"semi_vortex", flock,
       [](std::uint32_t i, double t, std::uint64_t s) {  // straight for five seconds, then as above
         const double r = 2 + 4 * test::uniform(s, 0, i, 0), phi = 2 * kPi * test::uniform(s, 0, i, 1) + (i % 2 == 0 ? 0.5 : -0.5) / r * t;
         return t < 5 ? Place{r * std::cos(phi) + 5 * t, r * std::sin(phi), 0} : Place{r * std::cos(phi), r * std::sin(phi), 0};
       }},
      {"comet", flock,
       [](std::uint32_t i, double t, std::uint64_t s) {  // a dense head, one in ten in a long tail
         const Place p = disc(i, s, 0.4);
         const double x = i < 9 * kN / 10 ? p[0] : -2.9 * (i - 9 * kN / 10 + 1);
         return Place{x + 0.5 * t, p[1] + shake(i, t, s, 1), 0};
       }},
      {"compact", flock,
       [](std::uint32_t i, double t, std::uint64_t s) {
         const Place p = disc(i, s, 1);  // it begins dense, and makes room
         const double wider = 1 + std::min(1.0, t / 10);
         return Place{wider * p[0] + 0.5 * t, wider * p[1] + shake(i, t, s, 1), 0};
       }},
      {"cohesive", flock,
       [](std::uint32_t i, double t, std::uint64_t s) {
         const Place p = disc(i, s, 8);
         return Place{p[0] + 0.5 * t, p[1] + shake(i, t, s, 1), 0};
       }},
      {"convergence", flock,
       [](std::uint32_t i, double t, std::uint64_t s) {
         const Place p = disc(i, s, 4);
         const double apart = t < 80 ? 0.15 * (80 - t) : 0;
         return Place{p[0] + 2 * t, p[1] + (i % 2 == 0 ? apart : -apart) + shake(i, t, s, 1), 0};
       }},
      {"split", flock,
       [](std::uint32_t i, double t, std::uint64_t s) {
         const Place p = disc(i, s, 3);
         return Place{p[0] + 0.5 * t, p[1] + (i % 2 == 0 ? 15 : -15) + shake(i, t, s, 1), 0};
       }},
  };
  return all;
}

Tracks tracks_of_plant(const Plant& place, std::uint64_t seed) {
  return tracks_of(test::rows_of(kN, kFrames, 1, [&](std::uint32_t i, double t) { return place(i, t, seed); }), {.dt = 1, .dims = 2});
}

const GroupState& last_state(const Planted& p, std::uint64_t seed) {
  const Tracks tracks = tracks_of_plant(p.place, seed);
  MomentOptions options = moment_options(tracks);
  options.link = kLink;
  return *state_course(tracks, options, p.words, 30).windows.back().state;
}

// Ten recordings of every state: a row per planted state, a column per recognised one. All on the diagonal but for one in ten.
TEST(GroupState, ConfusionOverPlantedStates) {
  for (const Planted& p : planted()) {
    std::map<std::string_view, int> found;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) ++found[last_state(p, seed).key];
    std::string row;
    for (const auto& [state, count] : found) row += fmt::format(" {} {}", state, count);
    EXPECT_GE(found[p.state], 9) << p.state << ":" << row;
  }
}

TEST(GroupState, EveryStateOfTheTableIsPlanted) {
  for (const GroupState& s : state_table()) {
    EXPECT_FALSE(s.rule.empty() || s.name.empty());
    const bool is_planted = std::any_of(planted().begin(), planted().end(), [&](const Planted& p) { return p.state == s.key; });
    EXPECT_TRUE(is_planted) << s.key;
  }
  // Without anything to go by, the last word of each vocabulary.
  StateFeatures nothing;
  nothing.polarisation = nothing.rotation = std::nan("");
  for (const StateWords words : {StateWords::group, StateWords::flock}) EXPECT_EQ(state_of(nothing, {}, words).key, "disordered");
}

TEST(GroupState, TheSameInSpaceAndAnyUnit) {
  // A directed mill in a tilted plane, in another unit of length.
  const Tracks mill = tracks_of(test::rows_of(kN, 60, 0.04,
                                              [](std::uint32_t i, double t) {
                                                const double r = 3000 + 1000 * test::uniform(1, 0, i, 0),
                                                             phi = 2 * kPi * test::uniform(1, 0, i, 1) + t;
                                                return Place{r * std::cos(phi), r * std::sin(phi) * 0.6, r * std::sin(phi) * 0.8};
                                              }),
                                {.dt = 0.04});
  const StateCourse course = state_course(mill, moment_options(mill), StateWords::group, 30);
  ASSERT_EQ(course.windows.size(), 2U);
  EXPECT_EQ(course.windows[0].state->key, "mill");
  EXPECT_EQ(course.windows[1].first, 30);
  EXPECT_EQ(spells(course).size(), 1U);
}

const GroupState& state_of_plant(const Plant& place, StateWords words, double side = 0) {
  const Tracks tracks = tracks_of_plant(place, 3);
  MomentOptions options = moment_options(tracks);
  options.link = kLink;
  if (side > 0) options.period = {side, side, 0};
  return *state_course(tracks, options, words, 30).windows.back().state;
}

// What fills a periodic box is no group, although everybody is linked.
TEST(GroupState, AGasInAPeriodicBoxIsNoSwarm) {
  const Plant gas = [](std::uint32_t i, double t, std::uint64_t s) {
    const double phi = 2 * kPi * test::uniform(s, 2, i, 0);
    return Place{10 * test::uniform(s, 0, i, 0) + 0.02 * t * std::cos(phi), 10 * test::uniform(s, 0, i, 1) + 0.02 * t * std::sin(phi), 0};
  };
  EXPECT_EQ(state_of_plant(gas, StateWords::group, 10).key, "disordered");
  EXPECT_EQ(state_of_plant(gas, StateWords::group).key, "swarm");
}

// Everybody crosses the middle and comes back: an empty core at every moment, and no rotation.
TEST(GroupState, WhoMovesInAndOutIsNoMill) {
  const Plant pulse = [](std::uint32_t i, double t, std::uint64_t s) {
    const double phi = 2 * kPi * test::uniform(s, 0, i / 2, 0) + kPi * (i % 2), r = static_cast<int>(t) % 2 == 0 ? 1.2 : -0.8;
    return Place{r * std::cos(phi), r * std::sin(phi), 0};
  };
  EXPECT_EQ(state_of_plant(pulse, StateWords::group).key, "swarm");
}

// A belt: to the one end on this side, and back on the other. Its axis does not turn.
TEST(GroupState, AChainThatRunsToAndFroRotates) {
  const Plant belt = [](std::uint32_t i, double t, std::uint64_t s) {
    const double round = std::fmod(40 * test::uniform(s, 0, i, 0) + 0.5 * t, 40);
    return Place{round < 20 ? round : 40 - round, (round < 20 ? 0.2 : -0.2) + shake(i, t, s, 1), 0};
  };
  EXPECT_EQ(state_of_plant(belt, StateWords::group).key, "rotating_chain");
}

// A core, and stranded individuals far behind: more than one in twenty are a tail, fewer have been lost.
TEST(GroupState, StrandedIndividualsAreACometsTail) {
  const auto stranded = [](std::uint32_t many) {
    return [many](std::uint32_t i, double t, std::uint64_t s) {
      const Place p = disc(i, s, 4);
      return Place{(i < kN - many ? p[0] : -40.0 * (kN - i)) + 0.5 * t, p[1] + shake(i, t, s, 1), 0};
    };
  };
  EXPECT_EQ(state_of_plant(stranded(6), StateWords::flock).key, "comet");
  EXPECT_EQ(state_of_plant(stranded(2), StateWords::flock).key, "cohesive");
}

// Two parts for less than half of the first window are parts, too.
TEST(GroupState, AShortPartingIsRemembered) {
  const Plant meet = [](std::uint32_t i, double t, std::uint64_t s) {
    const Place p = disc(i, s, 2);
    const double apart = t < 12 ? 12 - t : 0;
    return Place{p[0] + 2 * t, p[1] + (i % 2 == 0 ? apart : -apart) + shake(i, t, s, 1), 0};
  };
  EXPECT_EQ(state_of_plant(meet, StateWords::flock).key, "convergence");
}

// Two halves that part at 40 s and meet again from 80 s on: one fission, one fusion, where links of 3 break and form.
TEST(GroupState, FissionAndFusionAreEvents) {
  const Tracks tracks = tracks_of_plant(
      [](std::uint32_t i, double t, std::uint64_t s) {
        const Place p = disc(i, s, 3);
        const double apart = t < 40 ? 0 : t < 60 ? t - 40 : t < 80 ? 20 : t < 100 ? 100 - t : 0;
        return Place{p[0] + 0.5 * t, p[1] + (i % 2 == 0 ? apart : -apart), 0};
      },
      3);
  MomentOptions options = moment_options(tracks);
  options.link = kLink;
  const StateCourse course = state_course(tracks, options, StateWords::flock, 20);
  ASSERT_EQ(course.events.size(), 2U);
  EXPECT_TRUE(course.events[0].fission());
  EXPECT_EQ(course.events[0].after, 2);
  EXPECT_NEAR(static_cast<double>(course.events[0].frame), 44, 3);  // 6 + 3 apart, but for gaps at the rims
  EXPECT_FALSE(course.events[1].fission());
  EXPECT_NEAR(static_cast<double>(course.events[1].frame), 96, 3);
}

}  // namespace
}  // namespace swarmfit
