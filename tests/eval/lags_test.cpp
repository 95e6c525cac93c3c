// SPDX-License-Identifier: MIT
#include "libeval/lags.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libeval/evaluation.h"
#include "libeval/localisation.h"
#include "libeval/skill.h"
#include "libtrack/error.h"
#include "tests/eval/build.h"

namespace swarmfit {
namespace {

using test::Row;
using test::rows_of;
using test::tracks_of;
using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

testing::Matcher<double> close_to(double x, double relative = 1e-12) { return testing::DoubleNear(x, relative * std::abs(x)); }

std::string refusal(const std::function<void()>& job) {
  try {
    job();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

// Rough motion with holes: a tenth of the rows is missing.
std::vector<Row> with_holes(std::int64_t frames = 80, double missing = 0.1) {
  auto rows = test::trapped(5, 9, frames, {.dt = 0.02});
  std::erase_if(rows, [&](const Row& r) { return test::uniform(9, static_cast<std::uint64_t>(r.frame), r.track) < missing; });
  return rows;
}

// Every unbroken run as a track of its own.
std::vector<Row> runs_apart(std::vector<Row> rows) {
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.track < b.track; });
  std::vector<Row> out = rows;
  std::uint32_t id = 0;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    id += rows[k].track != rows[k - 1].track || rows[k].frame != rows[k - 1].frame + 1;
    out[k].track = id;
  }
  out[0].track = 0;
  return out;
}

// ---- columns ------------------------------------------------------------------------------------------------------------------

TEST(Columns, TheFirstSevenAreTheMetricsWhateverTheLags) {
  const auto one = columns_at({1}), three = columns_at({4, 16, 64});
  ASSERT_EQ(one.size(), 7u);
  ASSERT_EQ(three.size(), 17u);
  for (std::size_t m = 0; m < kMetrics; ++m) {
    EXPECT_EQ(one[m].key(), kMetricInfo[m].key);
    EXPECT_EQ(three[m].metric, m);
  }
  EXPECT_EQ(three[kJerk].key(), "mu@4");
  EXPECT_EQ(three[kDistance].key(), "d");
  EXPECT_EQ(three[kVelocityDifference].key(), "eta");
  EXPECT_EQ(three[7].key(), "v@16");
  EXPECT_EQ(three[16].symbol(), "μ@64");
  EXPECT_EQ(three[14].name(), "angular velocity over 64 frames");
  EXPECT_THAT(lags_of(three), ElementsAre(4, 16, 64));
}

// ---- closed forms -------------------------------------------------------------------------------------------------------------

// On a circle of radius R with angle theta per frame, chords over l frames have length 2 R sin(l theta/2) and turn by l theta.
TEST(Lags, CircularMotionHasClosedForms) {
  const double radius = 3, theta = 0.1, dt = 0.05;
  const auto rows = rows_of(1, 40, dt, [&](std::uint32_t, double t) {
    const double phi = theta * t / dt;
    return std::array{radius * std::cos(phi), radius * std::sin(phi), 7.0};
  });
  for (const int lag : {1, 2, 5}) {
    const auto n = static_cast<std::size_t>(lag);
    const double s = std::sin(lag * theta / 2), T = lag * dt, v = 2 * radius * s / T;
    const auto values = metric_samples(tracks_of(rows, {.dt = dt}), {VelocitySource::difference, {lag}}).values;
    EXPECT_THAT(values[kSpeed], AllOf(SizeIs(40 - n), Each(close_to(v))));
    EXPECT_THAT(values[kAcceleration], AllOf(SizeIs(40 - 2 * n), Each(close_to(2 * v * s / T))));
    EXPECT_THAT(values[kAngularVelocity], AllOf(SizeIs(40 - 2 * n), Each(close_to(theta / dt))));
    EXPECT_THAT(values[kJerk], AllOf(SizeIs(40 - 3 * n), Each(close_to(4 * v * s * s / (T * T), 1e-11))));
    EXPECT_THAT(values[kAngularAcceleration], AllOf(SizeIs(40 - 3 * n), Each(testing::DoubleNear(0, 1e-10))));
    EXPECT_THAT(values[kDistance], IsEmpty());
  }
}

TEST(Lags, AStraightWalkerHasItsSpeedAtEveryLag) {
  const auto rows = rows_of(1, 30, 0.25, [](std::uint32_t, double t) { return std::array{2 * t, -4 * t, 4 * t}; });
  const auto s = metric_samples(tracks_of(rows, {.dt = 0.25}), {VelocitySource::difference, {1, 3, 8}});
  for (std::size_t j = 0; j < s.columns.size(); ++j) {
    if (!s.columns[j].motion()) continue;
    const double want = s.columns[j].metric == kSpeed ? 6 : 0;
    EXPECT_THAT(s.values[j], Each(testing::DoubleNear(want, 1e-9))) << s.columns[j].key();
  }
}

// White error of sd s moves a chord over l frames by sqrt(2) s, whatever l: its share of the speed falls as 1/l.
TEST(Lags, ErrorMattersLessOverLongerTimes) {
  const auto rows = rows_of(40, 120, 0.01, [](std::uint32_t i, double t) { return test::orbit(3, 80, 1.5, i, t); });
  const Eigen::Array3d sigma = Eigen::Array3d::Constant(0.4);
  const Tracks seen = with_error(tracks_of(rows, {.dt = 0.01}), sigma, 7);
  const auto share = error_share(seen, sigma, 8, {1, 4, 16});
  ASSERT_EQ(share.size(), 17u);
  for (std::size_t m = 0; m < kMotionMetrics; ++m) EXPECT_GT(share[m] + 1e-9, share[12 + m]) << kMetricInfo[m].key;
  EXPECT_GT(share[kJerk], 0.9);
  EXPECT_LT(share[12 + kJerk], 0.1);
}

// ---- against the brute-force twin ---------------------------------------------------------------------------------------------

// Lag l is lag 1 on each of the l recordings that keep every l-th frame, pooled.
TEST(Lags, AreThoseOfEverySubsampledRecordingPooled) {
  const auto rows = runs_apart(with_holes());
  for (const int lag : {2, 3, 7}) {
    const auto got = metric_samples(tracks_of(rows, {.dt = 0.02}), {VelocitySource::difference, {lag}});
    MetricSamples want;
    for (int offset = 0; offset < lag; ++offset) {
      std::vector<Row> part;
      for (const Row& r : rows)
        if (r.frame % lag == offset) part.push_back({r.track, r.frame / lag, r.p});
      const auto one = metric_samples(tracks_of(part, {.dt = lag * 0.02}));
      for (std::size_t m = 0; m < kMotionMetrics; ++m)
        want.values[m].insert(want.values[m].end(), one.values[m].begin(), one.values[m].end());
    }
    for (std::size_t m = 0; m < kMotionMetrics; ++m) {
      auto a = got.values[m], b = want.values[m];
      std::sort(a.begin(), a.end());
      std::sort(b.begin(), b.end());
      EXPECT_GT(a.size(), 20u);
      EXPECT_EQ(a, b) << kMetricInfo[m].key << " at lag " << lag;
    }
  }
}

// The counts of an unbroken run of n frames are n - l, n - 2l and n - 3l; a gap ends the run.
TEST(Lags, NothingIsTakenAcrossAGap) {
  std::vector<Row> rows;
  for (std::int64_t k = 0; k < 31; ++k)
    if (k != 13) rows.push_back({0, k, {static_cast<double>(k * k), 1.0 * static_cast<double>(k), 0}});
  const auto s = metric_samples(tracks_of(rows), {VelocitySource::difference, {1, 5}});
  const auto expected = [](std::int64_t frames) { return static_cast<std::size_t>(std::max<std::int64_t>(0, frames)); };
  for (std::size_t j : {std::size_t{0}, std::size_t{7}}) {
    const int l = s.columns[j].lag;
    EXPECT_EQ(s.values[j + kSpeed].size(), expected(13 - l) + expected(17 - l));
    EXPECT_EQ(s.values[j + kAcceleration].size(), expected(13 - 2 * l) + expected(17 - 2 * l));
    EXPECT_EQ(s.values[j + kAngularVelocity].size(), expected(13 - 2 * l) + expected(17 - 2 * l));
    EXPECT_EQ(s.values[j + kJerk].size(), expected(13 - 3 * l) + expected(17 - 3 * l));
    EXPECT_EQ(s.values[j + kAngularAcceleration].size(), expected(13 - 3 * l) + expected(17 - 3 * l));
  }
}

TEST(Lags, OneIsTheSameBesideOthersAndNeighboursHaveNone) {
  const Tracks tracks = tracks_of(with_holes(), {.dt = 0.02});
  const auto alone = metric_samples(tracks), beside = metric_samples(tracks, {VelocitySource::difference, {1, 2, 8}}),
             without = metric_samples(tracks, {VelocitySource::difference, {4}});
  for (std::size_t m = 0; m < kMetrics; ++m) {
    EXPECT_EQ(alone.values[m], beside.values[m]);
    EXPECT_EQ(alone.undefined[m], beside.undefined[m]);
    EXPECT_EQ(alone.natural[m], beside.natural[m]);
  }
  EXPECT_EQ(alone.values[kDistance], without.values[kDistance]);
  EXPECT_EQ(alone.values[kVelocityDifference], without.values[kVelocityDifference]);
  EXPECT_DOUBLE_EQ(beside.natural[7 + kAngularAcceleration], 1 / (0.04 * 0.04));
}

TEST(Lags, EnergiesAndSkillOfLagOneDoNotKnowTheOthers) {
  const Tracks real = tracks_of(test::trapped(1, 12, 160, {})), other = tracks_of(test::trapped(2, 12, 160, {}));
  const MetricOptions lags{VelocitySource::difference, {1, 4}};
  const auto energies = [&](const MetricOptions& o) {
    const Target target(metric_samples(real, o), {});
    return target.energies(target.distributions(metric_samples(other, o)));
  };
  const Energies alone = energies({}), both = energies(lags);
  const HalfDistance half(real), halves(real, lags);
  const auto distance = half.to(half.blocks(other)), distances = halves.to(halves.blocks(other));
  ASSERT_EQ(both.size(), 12u);
  ASSERT_EQ(distances.size(), 12u);
  for (std::size_t m = 0; m < kMetrics; ++m) {
    EXPECT_EQ(alone[m], both[m]);
    EXPECT_EQ(half.floor()[m], halves.floor()[m]);
    EXPECT_EQ(distance[m], distances[m]);
  }
  for (std::size_t j = kMetrics; j < 12; ++j) {
    EXPECT_GT(both[j], 0) << j;
    EXPECT_GT(halves.floor()[j], 0) << j;
  }
}

// ---- what is asked for --------------------------------------------------------------------------------------------------------

TEST(Lags, AreReadInAnyOrder) {
  EXPECT_THAT(parse_lags("16,1,4"), ElementsAre(1, 4, 16));
  EXPECT_THAT(parse_lags("3"), ElementsAre(3));
  EXPECT_THAT(parse_lags("auto"), IsEmpty());
  EXPECT_EQ(lags_text({1, 4, 16}), "1,4,16");
}

TEST(Lags, OddOnesAreRefusedInOneLine) {
  for (const char* bad : {"", "0", "-2", "1.5", "1,,4", "1,", "four", "1 4", "99999999999", "1000001", "auto,1"}) {
    const std::string message = refusal([&] { parse_lags(bad); });
    EXPECT_THAT(message, AllOf(HasSubstr(std::string("`lags` ") + bad), HasSubstr("positive whole numbers"))) << bad;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
  EXPECT_THAT(refusal([] { parse_lags("4,1,4"); }), HasSubstr("4 is named twice"));
}

TEST(Lags, LongerThanAnyTrackIsRefused) {
  const Tracks tracks = tracks_of(rows_of(2, 31, 0.1, [](std::uint32_t i, double t) { return std::array{t, 1.0 * i, 0.0}; }));
  require_lags(tracks, {1, 10});
  EXPECT_THAT(refusal([&] { require_lags(tracks, {1, 11}); }), AllOf(HasSubstr("34 frames in a row"), HasSubstr("at most 10")));
  EXPECT_THAT(refusal([&] { evaluate(tracks, tracks, {}, {VelocitySource::difference, {11}}); }), HasSubstr("at most 10"));
  // Lag 1 is not refused, however short the tracks: d needs one frame only.
  const Tracks brief = tracks_of(rows_of(2, 2, 0.1, [](std::uint32_t i, double t) { return std::array{t, 1.0 * i, 0.0}; }));
  require_lags(brief, {1});
  EXPECT_THAT(refusal([&] { require_lags(brief, {2}); }), HasSubstr("expected 1"));
}

TEST(Lags, RecordedVelocitiesHaveOneOnly) {
  const Tracks tracks = tracks_of(test::trapped(1, 3, 20, {.velocity = true}), {.velocity = true});
  EXPECT_THAT(refusal([&] { metric_samples(tracks, {VelocitySource::recorded, {1, 2}}); }), HasSubstr("`lags` 1"));
  EXPECT_EQ(metric_samples(tracks, {VelocitySource::recorded, {1}}).columns.size(), 7u);
}

// ---- what is chosen -----------------------------------------------------------------------------------------------------------

// One run of n frames carries n - 3l jerks at lag l: half of those at lag 1 up to l = (n + 3)/6, and 8 (3l + 1) <= n is stricter.
TEST(Lags, TheLongestLeavesEnoughOfTheRecording) {
  const auto of = [](std::int64_t frames) {
    return longest_lag(tracks_of(rows_of(1, frames, 0.1, [](std::uint32_t, double t) { return std::array{t, 0.0, 0.0}; })));
  };
  EXPECT_EQ(of(3), 1);
  EXPECT_EQ(of(55), 1);
  EXPECT_EQ(of(56), 2);  // 8 × 7
  EXPECT_EQ(of(103), 2);
  EXPECT_EQ(of(104), 4);  // 8 × 13
  EXPECT_EQ(of(200), 8);  // 8 × 25
  // Two hundred frames, but in runs of 12: 9 jerks each at lag 1, 6 at lag 2 and none at lag 4.
  std::vector<Row> rows;
  for (std::int64_t k = 0; k < 200; ++k)
    if (k % 13 != 12) rows.push_back({0, k, {static_cast<double>(k), 0, 0}});
  EXPECT_EQ(longest_lag(tracks_of(rows)), 2);
  EXPECT_EQ(longest_lag(tracks_of({})), 1);
}

TEST(Lags, AreChosenSoThatTheSignalExceedsTheError) {
  const auto rows = rows_of(20, 400, 0.01, [](std::uint32_t i, double t) { return test::orbit(3, 80, 1.5, i, t); });
  const Tracks clean = tracks_of(rows, {.dt = 0.01});
  const auto choice = [&](double sigma, double limit) {
    const Eigen::Array3d s = Eigen::Array3d::Constant(sigma);
    return choose_lags(sigma > 0 ? with_error(clean, s, 7) : clean, s, limit, 8);
  };
  EXPECT_THAT(choice(0, 0.5), ElementsAre(1));
  EXPECT_THAT(choice(1e-6, 0.5), ElementsAre(1));
  EXPECT_THAT(choice(0.4, 1), ElementsAre(1)) << "no share exceeds 1";
  const auto mild = choice(0.02, 0.5), strong = choice(0.4, 0.5);
  ASSERT_EQ(mild.size(), 2u);
  ASSERT_EQ(strong.size(), 2u);
  EXPECT_LT(mild[1], strong[1]);
  EXPECT_THAT(choice(1000, 0.5), ElementsAre(1, longest_lag(clean))) << "never enough";
  EXPECT_EQ(longest_lag(clean), 16);
  // No shorter one would have done, and the one chosen does.
  const Eigen::Array3d sigma = Eigen::Array3d::Constant(0.4);
  const auto share = error_share(with_error(clean, sigma, 7), sigma, 8, {strong[1] / 2, strong[1]});
  EXPECT_GT(*std::max_element(share.begin(), share.begin() + kMotionMetrics), 0.5);
  EXPECT_LT(*std::max_element(share.begin() + kMetrics, share.end()), 0.5);
}

}  // namespace
}  // namespace swarmfit
