// SPDX-License-Identifier: MIT
#include "libeval/energy.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "libtrack/quantile.h"
#include "tests/eval/build.h"

namespace swarmfit {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
const double kNaN = std::nan("");
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Samples with the same values in every metric.
MetricSamples all(const std::vector<double>& values, double natural = 0) {
  MetricSamples s;
  s.values.fill(values);
  s.natural.fill(natural);
  return s;
}

std::vector<double> normals(std::uint64_t seed, int n, double mean = 0, double sd = 1) {
  std::vector<double> out;
  for (int i = 0; i < n; ++i) out.push_back(mean + sd * test::normal(seed, static_cast<std::uint64_t>(i), 0));
  return out;
}

Energies energies(const Target& target, const MetricSamples& s) { return target.energies(target.distributions(s)); }

double total(const std::vector<double>& q) { return std::accumulate(q.begin(), q.end(), 0.0); }

TEST(Binning, Standards) {
  const Binning reference = Binning::standard(Normalisation::reference), separate = Binning::standard(Normalisation::separate);
  EXPECT_EQ(reference.upper, 10);
  EXPECT_EQ(reference.bins, 150);
  EXPECT_TRUE(reference.clip);
  EXPECT_EQ(separate.upper, 5);
  EXPECT_EQ(separate.bins, 100);
  EXPECT_FALSE(separate.clip);
  EXPECT_EQ(Binning::standard(Normalisation::none).normalisation, Normalisation::none);
  for (const Binning& b : {reference, separate})  // equal bin widths, so that energies of both modes are of one size
    EXPECT_DOUBLE_EQ((b.upper - b.lower) / b.bins, 0.1);
  EXPECT_THROW(Target(all({1, 2}), Binning{.bins = 0}), std::invalid_argument);
  EXPECT_THROW(Target(all({1, 2}), Binning{.lower = 1, .upper = 1}), std::invalid_argument);
}

TEST(Density, ByHand) {
  EXPECT_THAT(density({{1, 0, 3}, 8, 4}, -1, 2), ElementsAre(0.125, 0, 0.375));  // S_i M / (S (u2 - u1)); half of them outside
  EXPECT_THAT(density({{0, 0}, 0, 0}, 0, 1), IsEmpty());
}

TEST(Histogram, AddsUp) {
  Histogram h{{1, 2}, 4, 1};
  h.add({{10, 20}, 40, 10});
  EXPECT_THAT(h.counts, ElementsAre(11, 22));
  EXPECT_EQ(h.samples, 44u);
  EXPECT_EQ(h.outside, 11u);
  Histogram empty;
  empty.add(h);
  EXPECT_THAT(empty.counts, ElementsAre(11, 22));
  h.add({});
  EXPECT_EQ(h.samples, 44u);
  EXPECT_THROW(h.add({{1, 2, 3}, 6, 0}), std::invalid_argument);
}

// Mean 0 and population SD 1 by construction, so z = x.
TEST(Histogram, BinEdgesAndEnds) {
  const std::vector<double> x = {-1, 1};
  const Binning b{.normalisation = Normalisation::reference, .lower = -2, .upper = 2, .bins = 4, .clip = false};
  const Target target(all(x), b);
  const auto bins = [&](const Binning& binning, std::vector<double> values) {
    return Target(all(x), binning).distributions(all(values))[0].histogram;
  };
  EXPECT_THAT(target.recording()[0].histogram.counts, ElementsAre(0, 1, 0, 1));  // lower edges belong to their bin
  EXPECT_THAT(bins(b, {-2, -1.5, 0, 1.999}).counts, ElementsAre(2, 0, 1, 1));
  EXPECT_THAT(bins(b, {2}).counts, ElementsAre(0, 0, 0, 1));  // the last bin is closed
  const std::vector<double> wild = {-3, 3, 1e300, -kInfinity, kInfinity, kNaN, 0.5};
  const Histogram open = bins(b, wild);
  EXPECT_THAT(open.counts, ElementsAre(0, 0, 1, 0));
  EXPECT_EQ(open.samples, 6u);  // NaN is none
  EXPECT_EQ(open.outside, 5u);
  Binning clipped = b;
  clipped.clip = true;
  EXPECT_THAT(bins(clipped, wild).counts, ElementsAre(2, 0, 1, 3));
  EXPECT_EQ(bins(clipped, wild).outside, 5u);
}

TEST(Moments, OfKnownNumbersAndInParts) {
  const std::vector<double> x = {2, 4, 4, 4, 5, 5, 7, 9};
  Moments whole, first, second;
  for (const double v : x) whole.add(v);
  for (std::size_t i = 0; i < x.size(); ++i) (i < 3 ? first : second).add(x[i]);
  first.add(second);
  first.add(Moments{});
  for (const Moments& m : {whole, first}) {
    EXPECT_EQ(m.count, 8u);
    EXPECT_DOUBLE_EQ(m.mean, 5);
    EXPECT_DOUBLE_EQ(m.sd(), 2);
  }
  Moments empty;
  EXPECT_TRUE(std::isnan(empty.sd()));
  empty.add(kNaN);
  empty.add(kInfinity);
  EXPECT_EQ(empty.count, 0u);
  empty.add(whole);
  EXPECT_DOUBLE_EQ(empty.sd(), 2);
}

TEST(Moments, DoNotCancelFarFromZero) {
  Moments m;
  for (const double v : {4.0, 7.0, 13.0, 16.0}) m.add(1e9 + v);
  EXPECT_DOUBLE_EQ(m.mean, 1e9 + 10);
  EXPECT_DOUBLE_EQ(m.sd(), std::sqrt(22.5));
}

// Four samples at a time, in blocks, against one after the other; among them edges, ends, and values far outside.
TEST(Histogram, InBlocksEqualsOneByOne) {
  for (const Normalisation normalisation : {Normalisation::reference, Normalisation::separate, Normalisation::none})
    for (const int n : {3, 255, 256, 257, 1500}) {
      const Binning binning = Binning::standard(normalisation);
      std::vector<double> values = normals(11, n, 3, 2);
      if (n > 1000) values[10] = 500, values[700] = -800, values[701] = 3;
      const Target target(all(normals(12, 4000, 3, 2)), binning);
      const Distribution d = target.distributions(all(values))[0];
      Moments one_by_one;
      for (const double x : values) one_by_one.add(x);
      EXPECT_EQ(d.moments.count, one_by_one.count);
      EXPECT_NEAR(d.moments.mean, one_by_one.mean, 1e-12);
      EXPECT_NEAR(d.moments.m2, one_by_one.m2, 1e-12 * one_by_one.m2);
      Histogram expected{std::vector<std::uint64_t>(static_cast<std::size_t>(binning.bins), 0), 0, 0};
      const bool own = normalisation == Normalisation::separate;
      const Target::Axis axis = own ? Target::Axis{d.moments.mean + d.moments.sd() * binning.lower,
                                                   d.moments.sd() * (binning.upper - binning.lower) / binning.bins}
                                    : target.axis(0);
      for (const double x : values) {
        const double place = (x - axis.lower) / axis.width;  // no sample is near enough to an edge for the rounding to matter
        const bool inside = place >= 0 && place <= binning.bins;
        ++expected.samples;
        expected.outside += !inside;
        if (inside || binning.clip) ++expected.counts[static_cast<std::size_t>(std::clamp(place, 0.0, binning.bins - 1.0))];
      }
      EXPECT_EQ(d.histogram.counts, expected.counts) << n;
      EXPECT_EQ(d.histogram.samples, expected.samples);
      EXPECT_EQ(d.histogram.outside, expected.outside);
    }
}

TEST(Quantile, InterpolatesBetweenOrderStatistics) {
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0), 1);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 1), 4);
  EXPECT_DOUBLE_EQ(quantile({10, 20, 30}, 0.125), 12.5);
  EXPECT_EQ(quantile({7}, 0.3), 7);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(Energy, ByHand) {
  // z = x: recording (0, 1/2, 0, 1/2), simulation (1/4, 1/4, 1/2, 0); differences 1/4 + 1/4 + 1/2 + 1/2
  const Target target(all({-1, 1}), {Normalisation::reference, -2, 2, 4, true});
  EXPECT_THAT(energies(target, all({-1.5, -0.5, 0.5, 0.5})), Each(1.5));
  EXPECT_EQ(target.worst(), 2);
}

TEST(Energy, OfASetWithItselfIsZeroAndOfDisjointSetsIsWorst) {
  for (const auto mode : {Normalisation::reference, Normalisation::separate, Normalisation::none}) {
    const Binning b = Binning::standard(mode);
    const Target target(all(normals(1, 5000, 3, 2)), b);
    EXPECT_THAT(energies(target, all(normals(1, 5000, 3, 2))), Each(0));
    EXPECT_EQ(target.worst(), 20);
    EXPECT_DOUBLE_EQ(total(density(target.recording()[0].histogram, b.lower, b.upper)) * 0.1, 1);
    if (mode == Normalisation::separate) continue;
    const auto far = energies(target, all(normals(2, 100, 1e6)));  // all in the last bin, where the recording has next to nothing
    const double tail = density(target.recording()[0].histogram, b.lower, b.upper).back();
    EXPECT_THAT(far, Each(testing::DoubleNear(20 - 2 * tail, 1e-12)));
  }
  const Target target(all({-1, 1}), {Normalisation::separate, -2, 2, 4, false});
  EXPECT_THAT(energies(target, all({-1.1, -1.1, 0.2, 2.0})), Each(testing::Gt(0)));
  EXPECT_EQ(energies(Target(all({-1, 1}), {}), all({0, 0.01}))[0], 20);
}

TEST(Energy, SeparateNormalisationSeesOnlyShapeReferenceSeesScale) {
  const auto x = normals(3, 20000, 10, 2), y = normals(4, 20000, 10, 2);
  std::vector<double> scaled;
  for (const double v : y) scaled.push_back(16 * v + 1024);  // exact in binary, so bins do not move
  const Target separate(all(x), Binning::standard(Normalisation::separate)), reference(all(x), {});
  EXPECT_NEAR(energies(separate, all(y))[0], energies(separate, all(scaled))[0], 1e-3);
  EXPECT_LT(energies(reference, all(y))[0], 1);
  EXPECT_GT(energies(reference, all(scaled))[0], 19.9);
}

TEST(Energy, IsTwiceTheTotalVariationOverTheBinWidth) {
  // Normals one standard deviation apart: total variation 2 Phi(1/2) - 1 = 0.382925
  const Target target(all(normals(5, 400000)), {});
  EXPECT_NEAR(energies(target, all(normals(6, 400000, 1)))[0] * 0.1, 2 * 0.382925, 0.01);
}

TEST(Energy, DoesNotDependOnTheOrderOfSamplesOrOnReplicatesBeingPooled) {
  const Target target(all(normals(7, 3000)), {});
  const auto a = normals(8, 500), b = normals(9, 700);
  auto both = b;
  both.insert(both.end(), a.rbegin(), a.rend());
  auto pooled = target.distributions(all(a));
  const auto second = target.distributions(all(b)), at_once = target.distributions(all(both));
  for (std::size_t m = 0; m < kMetrics; ++m) {
    pooled[m].histogram.add(second[m].histogram);
    pooled[m].moments.add(second[m].moments);
    EXPECT_NEAR(pooled[m].moments.sd(), at_once[m].moments.sd(), 1e-13);
  }
  EXPECT_EQ(target.energies(pooled), target.energies(at_once));
}

TEST(Energy, ConstantMetricsAreUndefined) {
  const auto x = normals(10, 100, 5);
  std::vector<double> constant(100, 5.0), rounding = constant;
  for (std::size_t i = 0; i < rounding.size(); ++i) rounding[i] += 1e-10 * x[i];
  for (const auto mode : {Normalisation::reference, Normalisation::separate, Normalisation::none}) {
    const Binning b = Binning::standard(mode);
    for (const auto& still : {constant, rounding}) {
      const Target target(all(still, 5), b);
      EXPECT_FALSE(target.defined(0));
      EXPECT_THAT(energies(target, all(x)), Each(testing::IsNan()));
      const bool undefined = mode == Normalisation::separate;  // otherwise a model without spread is simply wrong
      EXPECT_EQ(std::isnan(energies(Target(all(x), b), all(still, 5))[0]), undefined);
    }
  }
  EXPECT_TRUE(Target(all(rounding, 0.01), {}).defined(0));  // small beside the mean, large beside the natural scale
}

TEST(Energy, SpreadIsFlooredAtOnePercentOfTheMean) {
  const std::vector<double> narrow = {99.99, 100.01};
  const Target target(all(narrow), {});
  EXPECT_DOUBLE_EQ(target.axis(0).width, 0.1);         // 0.1 of 1 % of 100, not of 0.01
  EXPECT_DOUBLE_EQ(target.axis(0).lower, 100 - 5.05);  // 100 lies in the middle of its bin
  EXPECT_DOUBLE_EQ(target.recording()[0].moments.sd(), 100.01 - 100);
}

TEST(Energy, WithoutSamplesIsUndefined) {
  const Target target(all(normals(11, 50)), {});
  EXPECT_THAT(energies(target, all({})), Each(testing::IsNan()));
  EXPECT_THAT(energies(target, all({kNaN, kNaN})), Each(testing::IsNan()));
  EXPECT_THAT(energies(Target(all({}), {}), all({1, 2})), Each(testing::IsNan()));
  EXPECT_EQ(energies(target, all({kInfinity, -kInfinity}))[0] > 19, true);  // a blown-up simulation pays
}

TEST(Energy, PhysicalUnitsUseThePercentileRange) {
  std::vector<double> x;
  for (int i = 0; i <= 1000; ++i) x.push_back(i);
  const Target target(all(x), Binning::standard(Normalisation::none));
  EXPECT_NEAR(target.axis(0).lower, 5, 1e-9);
  EXPECT_NEAR(target.axis(0).width, 9.9, 1e-12);
  EXPECT_EQ(target.recording()[0].histogram.outside, 10u);
  EXPECT_EQ(target.worst(), 20);
}

TEST(Misplacement, SaysWhichOfTwoDisjointSimulationsIsNearer) {
  const auto spread = normals(1, 2000, 100, 10);
  const Target target(all(spread), Binning::standard(Normalisation::reference));
  const double mean = target.recording()[kSpeed].moments.mean, sd = target.recording()[kSpeed].moments.sd();
  const auto far = target.distributions(all({mean + 50 * sd, mean + 50 * sd})), farther = target.distributions(all({mean - 400 * sd}));
  EXPECT_DOUBLE_EQ(target.energies(far)[kSpeed], target.energies(farther)[kSpeed]) << "the energy cannot tell";
  EXPECT_NEAR(target.misplacement(far)[kSpeed], std::log(51), 1e-12);
  EXPECT_NEAR(target.misplacement(farther)[kSpeed], std::log(401), 1e-12);
  EXPECT_EQ(target.misplacement(target.distributions(all({mean + 1e9 * sd})))[kSpeed], kMostMisplaced);
  EXPECT_EQ(target.misplacement(target.distributions(all(spread)))[kSpeed], 0);
  EXPECT_EQ(target.misplacement(target.distributions(MetricSamples()))[kSpeed], 0) << "nothing to say";
  const Target shape(all(spread), Binning::standard(Normalisation::separate));
  EXPECT_THAT(shape.misplacement(far), Each(0.0)) << "only the shape counts";
}

TEST(Differences, AreSignedAndZeroForTheRecordingItself) {
  const auto spread = normals(1, 4000, 100, 10);
  const Target target(all(spread), Binning::standard(Normalisation::reference));
  EXPECT_THAT(target.differences(target.distributions(all(spread))), Each(0.0));
  EXPECT_THAT(target.differences(target.distributions(MetricSamples())), Each(0.0)) << "nothing to say";
  std::vector<double> lower = spread, wider = spread;
  for (double& x : lower) x -= 20;
  for (double& x : wider) x += x - 100;
  const auto moved = target.differences(target.distributions(all(lower))), stretched = target.differences(target.distributions(all(wider)));
  const std::size_t at = kSpeed * kDifferences;
  const double two = std::log(3);  // 2 standard deviations
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(moved[at + k], -two, 0.03) << k;
  EXPECT_NEAR(moved[at + 4], 0, 1e-9);
  EXPECT_NEAR(stretched[at], -std::log(1.6745), 0.03);  // quartiles of normal numbers lie .6745 from the mean
  EXPECT_NEAR(stretched[at + 1], 0, 0.03);
  EXPECT_NEAR(stretched[at + 2], std::log(1.6745), 0.03);
  EXPECT_NEAR(stretched[at + 4], std::log(2), 0.01);
  const Target shape(all(spread), Binning::standard(Normalisation::separate));
  const auto no_moments = shape.differences(shape.distributions(all(lower)));
  EXPECT_EQ(no_moments[at + 3], 0);
  EXPECT_EQ(no_moments[at + 4], 0);
}

TEST(Energy, ChecksTheNumberOfBins) {
  const auto x = all(normals(12, 50));
  EXPECT_THROW(Target(x, {}).energies(Target(x, {.bins = 50}).distributions(x)), std::invalid_argument);
}

// The whole path on motion that has every metric.
TEST(Energy, SevenEnergiesOfTwoSwarms) {
  const test::Settings settings{.dt = 0.01};
  const auto real = metric_samples(test::tracks_of(test::trapped(1, 10, 200, settings), settings));
  const auto alike = metric_samples(test::tracks_of(test::trapped(2, 10, 200, settings), settings));
  const auto other = metric_samples(test::tracks_of(test::trapped(2, 10, 200, settings, 4000), settings));
  const Target target(real, {});
  const auto near = energies(target, alike), far = energies(target, other);
  for (std::size_t m = 0; m < kMetrics; ++m) {
    if (m == kDistance) continue;
    EXPECT_LT(near[m], far[m]) << kMetricInfo[m].key;
  }
}

}  // namespace
}  // namespace swarmfit
