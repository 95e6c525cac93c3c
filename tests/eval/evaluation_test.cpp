// SPDX-License-Identifier: MIT
#include "libeval/evaluation.h"

#include <gmock/gmock.h>

#include <cmath>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

using ::testing::HasSubstr;

Tracks walkers(double speed, const std::string& unit = "m", double dt = 0.1) {
  TrackColumns c;
  c.names = {"a", "b", "c"};
  for (std::int64_t f = 0; f < 40; ++f)
    for (std::uint32_t t = 0; t < 3; ++t) c.track.push_back(t), c.frame.push_back(f);
  c.pos.resize(static_cast<Index>(c.track.size()), 3);
  for (std::size_t i = 0; i < c.track.size(); ++i) {
    const double t = static_cast<double>(c.frame[i]) * dt;
    c.pos.row(static_cast<Index>(i)) << std::sin(speed * t + c.track[i]), std::cos(1.3 * speed * t * (1 + c.track[i])),
        0.2 * c.track[i] + 0.1 * t;
  }
  TrackMeta meta;
  meta.dt = dt;
  meta.unit = unit;
  meta.from.path = "walkers";
  return Tracks(std::move(c), meta);
}

std::string error_of(const Tracks& a, const Tracks& b) {
  try {
    evaluate(a, b, Binning::standard(Normalisation::reference));
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Evaluate, ARecordingIsAtNoDistanceFromItself) {
  const auto e = evaluate(walkers(1), walkers(1), Binning::standard(Normalisation::reference));
  for (std::size_t m = 0; m < kMetrics; ++m) EXPECT_EQ(e.raw_energies[m], 0) << m;
  EXPECT_EQ(e.real_order.extent, e.simulated_order.extent);
}

TEST(Evaluate, FasterMotionCostsEnergy) {
  const auto e = evaluate(walkers(1), walkers(3), Binning::standard(Normalisation::reference));
  EXPECT_GT(e.raw_energies[kSpeed], 1);
}

TEST(Evaluate, RefusesWhatCannotBeCompared) {
  EXPECT_THAT(error_of(walkers(1), walkers(1, "mm")), HasSubstr("is in mm; expected m"));
  EXPECT_THAT(error_of(walkers(1), walkers(1, "m", 0.2)), HasSubstr("frame interval is 0.2 s; expected 0.1 s"));
}

// The table of the method's description, weighed by hand there.
constexpr const char* kTable = "model,v,a,omega\nA,.2,.9,.5\nB,.8,.1,.5\n# a comment\nC,.5,.4,.5\nD,.35,.2,.5\n";

TEST(Weigh, KnownTable) {
  const auto t = weigh("t.csv", kTable);
  EXPECT_EQ(t.models, (std::vector<std::string>{"A", "B", "C", "D"}));
  EXPECT_EQ(t.metrics, (std::vector<std::string>{"v", "a", "omega"}));
  EXPECT_NEAR(t.weighting.weights[0], .515582, 1e-6);
  EXPECT_NEAR(t.weighting.weights[1], .484418, 1e-6);
  EXPECT_EQ(t.weighting.weights[2], 0);
  EXPECT_NEAR(t.scores[3], .810552, 1e-6);
}

TEST(Weigh, AnEmptyFieldMakesItsColumnUnused) {
  const auto t = weigh("t.csv", "model,v,a\nA,1,\nB,2,3\nC,4,5\n");
  EXPECT_TRUE(std::isnan(t.energies(0, 1)));
  EXPECT_EQ(t.weighting.weights[1], 0);
}

std::string weigh_error(const char* csv) {
  try {
    weigh("t.csv", csv);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Weigh, NamesThePlaceOfAFault) {
  EXPECT_THAT(weigh_error("model,v,a\nA,1,2\nB,x,3\n"), HasSubstr("t.csv:3:3: 'x' is not a number"));
  EXPECT_THAT(weigh_error("model,v,a\nA,1,2\nB,3\n"), HasSubstr("t.csv:3:1: 1 energies; expected 2"));
  EXPECT_THAT(weigh_error("model\nA\n"), HasSubstr("t.csv:1:1: no metric"));
  EXPECT_THAT(weigh_error("# nothing\n"), HasSubstr("no energies"));
}

}  // namespace
}  // namespace swarmfit
