// SPDX-License-Identifier: MIT
#include "fit/experiment/observe.h"

#include <gtest/gtest.h>

#include <cmath>

#include "libeval/energy.h"

namespace swarmfit {
namespace {

// A recording of three tracks in five frames with a gap of track 1 in frame 12 and track 2 from frame 13 on.
Tracks recording() {
  TrackColumns c;
  c.names = {"a", "b", "c"};
  for (std::int64_t f = 10; f < 15; ++f)
    for (std::uint32_t t = 0; t < 3; ++t) {
      if ((t == 1 && f == 12) || (t == 2 && f < 13)) continue;
      c.track.push_back(t);
      c.frame.push_back(f);
    }
  c.pos = Rows::Zero(static_cast<Index>(c.track.size()), 3);
  TrackMeta meta;
  meta.dt = 0.1;
  return Tracks(std::move(c), meta);
}

// Streams `agents` resting agents for the frames first .. last.
void stream(FrameSink& sink, std::uint32_t agents, std::int64_t first, std::int64_t last) {
  std::vector<std::uint32_t> id;
  for (std::uint32_t i = 0; i < agents; ++i) id.push_back(agents - 1 - i);  // rows need not be in the order of ids
  const std::vector<std::uint8_t> kind(agents, 0);
  Rows pos(agents, 3);
  for (Index i = 0; i < agents; ++i) pos.row(i).setConstant(static_cast<double>(id[static_cast<std::size_t>(i)]));
  for (auto f = first; f <= last; ++f) sink.frame({f, id, kind, pos, pos});
}

TEST(Observer, SeesExactlyWhoWasRecorded) {
  const Tracks mask = recording();
  TrackCollector collector(mask.names());
  Observer camera(&mask, Eigen::Array3d::Zero(), {1}, collector);
  stream(camera, 3, 8, 16);
  const Tracks seen = collector.take(mask.meta());
  ASSERT_EQ(seen.rows(), mask.rows());
  for (Index i = 0; i < seen.rows(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_EQ(seen.frame()[k], mask.frame()[k]);
    EXPECT_EQ(seen.track()[k], mask.track()[k]);
    EXPECT_EQ(seen.pos()(i, 0), seen.track()[k]);
  }
}

TEST(Observer, WithoutMaskSeesEverybody) {
  TrackCollector collector;
  Observer camera(nullptr, Eigen::Array3d::Zero(), {1}, collector);
  stream(camera, 4, 0, 2);
  EXPECT_EQ(collector.take(recording().meta()).rows(), 12);
}

TEST(Observer, ErrorHasTheGivenDeviationPerAxisAndNoMemory) {
  TrackCollector collector;
  Observer camera(nullptr, {0.5, 1.0, 2.0}, {3}, collector);
  stream(camera, 20, 0, 999);
  const Tracks seen = collector.take(recording().meta());
  for (Index axis = 0; axis < 3; ++axis) {
    Moments error, product;
    for (Index i = 0; i < seen.rows(); ++i) {
      const double e = seen.pos()(i, axis) - seen.track()[static_cast<std::size_t>(i)];
      error.add(e);
      if (const Index n = seen.next()[static_cast<std::size_t>(i)]; n >= 0)
        product.add(e * (seen.pos()(n, axis) - seen.track()[static_cast<std::size_t>(n)]));
    }
    const double sigma = std::array{0.5, 1.0, 2.0}[static_cast<std::size_t>(axis)];
    // n = 20 000 draws: the deviation's standard error is sigma/sqrt(2n) = 0.5 %, the mean's 0.7 %; four of them (level 6e-5 each).
    EXPECT_NEAR(error.sd(), sigma, 4 * 0.005 * sigma);
    EXPECT_NEAR(error.mean, 0, 4 * 0.0071 * sigma);
    EXPECT_NEAR(product.mean, 0, 4 * 0.0071 * sigma * sigma);
  }
}

TEST(Observer, RoundsAsTheFileDoes) {
  TrackCollector collector;
  Observer camera(nullptr, {0.3, 0.3, 0.3}, {3}, collector, UINT32_MAX, Grid{{0.1, 0, 0}, {0.5, 0.25, 0}});
  stream(camera, 5, 0, 9);
  const Tracks seen = collector.take(recording().meta());
  for (Index i = 0; i < seen.rows(); ++i) {
    EXPECT_NEAR(std::remainder(seen.pos()(i, 0) - 0.1, 0.5), 0, 1e-12);
    EXPECT_NEAR(std::remainder(seen.pos()(i, 1), 0.25), 0, 1e-12);
    EXPECT_GT(std::abs(std::remainder(seen.pos()(i, 2), 0.001)), 1e-9);  // as it is
  }
}

TEST(Observer, FlatMotionStaysFlat) {
  TrackCollector collector;
  Observer camera(nullptr, {1, 1, 0}, {3}, collector);
  stream(camera, 1, 0, 9);
  const Tracks seen = collector.take(recording().meta());
  EXPECT_TRUE((seen.pos().col(2) == 0).all());
}

}  // namespace
}  // namespace swarmfit
