// SPDX-License-Identifier: MIT
// Measures of behaviour on motion whose numbers are known in closed form.
#include "libeval/behaviour.h"

#include <gmock/gmock.h>

#include <numbers>

#include "libtrack/error.h"
#include "tests/eval/build.h"

namespace swarmfit {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kFrames = 41;  // of 0.1 s

// n individuals; `place(k, t)` is where the k-th is at time t.
template <class Place>
Tracks motion(int n, Place&& place) {
  std::vector<test::Row> rows;
  for (std::int64_t frame = 0; frame < kFrames; ++frame)
    for (int k = 0; k < n; ++k) rows.push_back({static_cast<std::uint32_t>(k), frame, place(k, 0.1 * static_cast<double>(frame))});
  return test::tracks_of(rows);
}

// Four on a circle of radius 2 about (1, 0, 0) in the plane of x and z, one turn in 4 s.
Tracks ring() {
  return motion(4, [](int k, double t) {
    const double angle = std::numbers::pi / 2 * (k + t);
    return std::array<double, 3>{1 + 2 * std::cos(angle), 0, 2 * std::sin(angle)};
  });
}

TEST(Behaviour, OfARing) {
  const Tracks tracks = ring();
  const Witness w{.agents = tracks};
  EXPECT_NEAR(observed("polarisation", w, {}), 0, 1e-12);
  EXPECT_NEAR(observed("rotation", w, {}), std::cos(std::numbers::pi / 40), 1e-12) << "a chord, half a step ahead of the tangent";
  EXPECT_NEAR(observed("rotation", w, {{"centre", {1, 0, 0}}}), std::cos(std::numbers::pi / 40), 1e-12);
  EXPECT_NEAR(observed("radius", w, {{"centre", {1, 0, 0}}}), 2, 1e-12);
  EXPECT_NEAR(observed("extent", w, {}), 2, 1e-12);
  EXPECT_NEAR(observed("spacing", w, {}), std::sqrt(8.0), 1e-12);
  EXPECT_NEAR(observed("speed", w, {}), 2 * 2 * std::sin(std::numbers::pi / 40) / 0.1, 1e-9);
  EXPECT_NEAR(observed("drift", w, {{"until", {2}}}), 0, 1e-12);
  EXPECT_EQ(observed("count", w, {}), 4);
  EXPECT_TRUE(std::isnan(observed("density", w, {}))) << "flat";
}

TEST(Behaviour, OfALineThatMoves) {
  // One at each end of the axes, moving along x at 3, and growing twice as large in 4 s.
  const Tracks tracks = motion(6, [](int k, double t) {
    std::array<double, 3> p{3 * t, 0, 0};
    p[static_cast<std::size_t>(k / 2)] += (k % 2 == 0 ? 1 : -1) * (1 + t / 4);
    return p;
  });
  const Witness w{.agents = tracks, .forbidden = [](const Eigen::Array3d& p) { return p[0] < 0; }};
  EXPECT_NEAR(observed("progress", w, {{"along", {2, 0, 0}}}), 12, 1e-12);
  EXPECT_NEAR(observed("progress", w, {{"along", {1, 1, 0}}, {"from", {1}}, {"until", {2}}}), 3 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(observed("drift", w, {}), 12, 1e-12);
  EXPECT_NEAR(observed("extent", w, {{"from", {4}}, {"relative_to", {0, 0}}}), 2, 1e-12);
  // Variance 1/3 on each axis at t = 0.
  const double volume = 4.0 / 3 * std::numbers::pi * 8 * std::pow(1.0 / 3, 1.5);
  EXPECT_NEAR(observed("density", w, {{"until", {0}}}), 6 / volume, 1e-12);
  EXPECT_NEAR(observed("arrived", w, {{"lower", {10, -1, -1}}, {"upper", {12.5, 1, 1}}}), 1.0 / 3, 1e-12)
      << "those on the axis; others pass aside";
  EXPECT_NEAR(observed("present", w, {{"lower", {-9, -9, -9}}, {"upper", {9, 9, 0}}, {"until", {0}}}), 5.0 / 6, 1e-12);
  EXPECT_EQ(observed("trespass", w, {}), 4) << "the one behind, as long as 3 t < 1 + t / 4";
}

TEST(Behaviour, OfStimuli) {
  const Tracks tracks = motion(5, [](int k, double t) { return std::array<double, 3>{k + 1.0, t, 0}; });
  const Tracks stimuli = motion(1, [](int, double t) { return std::array<double, 3>{0, t, 0}; });
  const Witness w{.agents = tracks, .stimuli = &stimuli};
  EXPECT_NEAR(observed("stimulus_distance", w, {}), 3, 1e-12);
  EXPECT_NEAR(observed("nearest_to_stimulus", w, {}), 1, 1e-12);
  EXPECT_NEAR(observed("met", w, {{"radius", {2.5}}}), 0.4, 1e-12);
  EXPECT_TRUE(std::isnan(observed("stimulus_distance", {.agents = tracks}, {})));
}

std::string refusal(std::string_view measure, const Questions& asked) {
  try {
    check_question(measure, asked);
  } catch (const InputError& e) {
    return e.what();
  }
  return "nothing was refused";
}

TEST(Behaviour, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(refusal("joy", {}), HasSubstr("measure 'joy': unknown; expected one of polarisation, rotation"));
  EXPECT_THAT(refusal("met", {}), HasSubstr("measure met: no radius; expected radius = ..."));
  EXPECT_THAT(refusal("met", {{"radius", {1, 2}}}), HasSubstr("radius has 2 numbers; expected 1"));
  EXPECT_THAT(refusal("extent", {{"radius", {1}}}), HasSubstr("'radius' is not known; expected one of from, until, relative_to"));
  EXPECT_THAT(refusal("progress", {{"along", {1}}}), HasSubstr("along has 1 numbers; expected 2 or 3"));
}

}  // namespace
}  // namespace swarmfit
