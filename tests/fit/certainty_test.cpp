// SPDX-License-Identifier: MIT
#include "fit/compare/certainty.h"

#include <gmock/gmock.h>
#include <omp.h>

#include <cmath>

#include "fit/model_fit/race.h"
#include "fit/study/recovery.h"
#include "libtrack/quantile.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

using testing::Each;
using testing::IsNan;

constexpr int kPooled = 3;

// A swarm made by bswarm, and models on it that are fitted to it by decree.
struct Scene {
  explicit Scene(std::uint64_t seed, Binning how = Binning::standard(Normalisation::reference))
      : recording(test::planted_swarm(seed)), binning(how) {}

  // The truth, with the noise times a factor.
  std::vector<double> values(double noise) const {
    auto out = scene_parameters(model, test::midge_parameters());
    out[static_cast<std::size_t>(model.spec->find("noise"))] *= noise;
    return out;
  }

  void add(double noise, int recordings = 39) {
    const auto seeds = replicate_seeds({1}, Stream::final_seeds, kPooled);
    const Energies raw = objective.evaluate(values(noise), seeds).raw;
    fits.push_back({-cost_of(raw, weighting), raw});
    bootstraps.of.push_back(bootstrap_of(objective, values(noise), {1}, recordings));
    bootstraps.scatter.push_back(0);
  }
  void fill() {
    bootstraps.recordings = bootstraps.of.front();
    certainty = certainties(std::array{trial()}, kPooled);
  }

  Trial trial() const { return {fits, bootstraps, &target, weighting}; }

  ModelChoice model = parse_model("bswarm");
  Tracks recording;
  Binning binning;
  Conditions conditions = make_conditions(recording, {});
  Target target{metric_samples(recording), binning};
  Objective objective{model, conditions, target};
  Weighting weighting = initial_weighting(std::vector<bool>(kMetrics, true), target.worst());
  std::vector<Scored> fits;
  std::vector<Certainty> certainty;
  Bootstraps bootstraps{{}, {}, {}, {1}};
};

TEST(Certainty, TheTruthExplainsAndWhatIsWrongDoesNot) {
  Scene s(3);
  s.add(1);
  s.add(2);
  s.fill();
  EXPECT_GT(s.certainty[0].gof_p, 0.05);
  EXPECT_EQ(s.certainty[1].gof_p, 1.0 / 40);
  EXPECT_EQ(s.certainty[0].group, 1);
  EXPECT_EQ(s.certainty[1].group, 2);
  EXPECT_EQ(s.certainty[0].set_p, 1);
  for (std::size_t m = 0; m < s.fits.size(); ++m) {
    EXPECT_LT(s.certainty[m].lower, s.fits[m].score);
    EXPECT_GT(s.certainty[m].upper, s.fits[m].score);
  }
  EXPECT_GT(s.certainty[1].lead_lower, 0);
  EXPECT_LT(s.certainty[1].lead_lower, s.fits[0].score - s.fits[1].score);
  EXPECT_GT(s.certainty[1].lead_upper, s.fits[0].score - s.fits[1].score);
  EXPECT_EQ(s.certainty[0].lead_lower, 0);
}

// The scatter of the draws about their mean, turned round the value, 2.2281 / 1.9600 times as wide.
TEST(Certainty, IntervalsAreTurnedAndWidened) {
  Scene s(3);
  s.add(1);
  s.add(1.3);
  s.fill();
  const ScoreDraws all = score_draws(s.trial(), kPooled);
  std::vector<double> leads;
  for (Index b = 0; b < all.draws.rows(); ++b) leads.push_back(all.draws(b, 0) - all.draws(b, 1));
  double mean = 0;
  for (const double lead : leads) mean += lead / static_cast<double>(leads.size());
  const double lead = s.fits[0].score - s.fits[1].score, wider = 2.2281 / 1.9600;
  EXPECT_NEAR(s.certainty[1].lead_lower, lead - wider * (quantile(leads, 0.975) - mean), 1e-12);
  EXPECT_NEAR(s.certainty[1].lead_upper, lead + wider * (mean - quantile(leads, 0.025)), 1e-12);
}

TEST(Certainty, NearlyEqualModelsAreOneGroup) {
  Scene s(3);
  s.add(1);
  s.add(1.001);
  s.fill();
  EXPECT_EQ(s.certainty[0].group, 1);
  EXPECT_EQ(s.certainty[1].group, 1);
}

// The same two models as in the first test, but searches that miss by as much as the models differ.
TEST(Certainty, SearchesThatMissTellNothingApart) {
  Scene s(3);
  s.add(1);
  s.add(2);
  s.bootstraps.scatter.assign(2, s.fits[0].score - s.fits[1].score);
  s.fill();
  EXPECT_EQ(s.certainty[1].group, 1);
}

// One column, whose score is minus its energy. Changes 0.3 and 0.1: variance (0.09 + 0.01) / 2 / 2. The median of three holds for the
// third, which did not move; and for one that moved less.
TEST(Certainty, SearchScatterByHand) {
  Weighting w;
  w.weights = {1};
  w.p1 = {0};
  w.p2 = {1};
  const auto passes = [](std::initializer_list<double> energies) {
    std::vector<Energies> out;
    for (const double e : energies) out.push_back(Energies(1, e));
    return out;
  };
  const double moved = std::sqrt(0.1 / 4), little = std::sqrt(0.01 / 4);
  EXPECT_THAT(search_scatter({passes({1, 0.7, 0.8}), passes({1, 1, 0.9}), passes({2, 2, 2})}, w),
              testing::Pointwise(testing::DoubleNear(1e-12), {moved, little, little}));
  EXPECT_THAT(search_scatter({passes({1})}, w), testing::ElementsAre(0));
  EXPECT_THAT(search_scatter({passes({1, NAN}), passes({1, NAN})}, w), Each(0));
}

double l1(const Histogram& a, const Histogram& b) {
  const auto p = density(a, -5, 10), q = density(b, -5, 10);
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += std::abs(p[i] - q[i]);
  return sum;
}

// A model's five runs, one of which blew up; every other is measured against the next three. By hand, as pooled distances and as scores.
TEST(Certainty, OwnEnergiesAreThoseOfTheNextRuns) {
  for (const bool pooled : {false, true}) {
    Binning binning = Binning::standard(Normalisation::reference);
    binning.pooled = pooled;
    Scene s(3, binning);
    s.add(1, kPooled + 2);
    Bootstrap& bootstrap = s.bootstraps.of[0];
    bootstrap[2].failed = true;
    bootstrap[2].distributions = PerColumn<Distribution>(kMetrics);
    s.fill();
    const auto speeds = [&](std::size_t k) -> const Histogram& { return bootstrap[k].distributions[kSpeed].histogram; };
    double pairs = 0;
    for (const std::size_t a : {0u, 1u, 3u, 4u})
      for (const std::size_t b : {0u, 1u, 3u, 4u}) pairs += l1(speeds(a), speeds(b)) / 12;
    double expected = 0;
    for (const std::size_t k : {0u, 1u, 3u, 4u}) {
      Histogram pool;
      double away = 0;
      int failed = 0;
      for (std::size_t i = 1; i <= kPooled; ++i) {
        const std::size_t other = (k + i) % 5;
        if (other == 2) {
          ++failed;
          continue;
        }
        pool.add(speeds(other));
        away += l1(speeds(k), speeds(other));
      }
      const double good = pooled ? l1(speeds(k), pool) : away / (kPooled - failed) - pairs / 2;
      expected += ((kPooled - failed) * good + failed * s.target.worst()) / kPooled / 4;
    }
    EXPECT_NEAR(s.certainty[0].own[kSpeed], expected, 1e-12);
  }
}

// Shares 1/40 .. 40/40 in the first bin: quantiles 2.5 % and 97.5 % are those of an even ladder.
TEST(Certainty, BandHoldsTheMiddleOfTheRecordingsBinByBin) {
  Scene s(3);
  Bootstrap bootstrap;
  for (std::uint64_t k = 1; k <= 40; ++k) {
    bootstrap.push_back({PerColumn<Distribution>(kMetrics), false});
    bootstrap.back().distributions[kSpeed].histogram = {{k, 40 - k}, 40, 0};
  }
  bootstrap.push_back({PerColumn<Distribution>(kMetrics), true});  // blew up
  const Band band = band_of(bootstrap, s.target);
  EXPECT_THAT(band.lower[kSpeed], testing::Pointwise(testing::DoubleNear(1e-12), {(1 + 0.025 * 39) / 40, 0.025 * 39 / 40}));
  EXPECT_THAT(band.upper[kSpeed], testing::Pointwise(testing::DoubleNear(1e-12), {(1 + 0.975 * 39) / 40, 0.975 * 39 / 40}));
  EXPECT_TRUE(band.lower[kDistance].empty());
  bootstrap.resize(38);
  EXPECT_TRUE(band_of(bootstrap, s.target).lower[kSpeed].empty());
}

TEST(Certainty, TooFewRecordingsTellNothing) {
  for (const int recordings : {0, kPooled + 1}) {
    Scene s(3);
    s.add(1, recordings);
    s.fill();
    const Certainty& c = s.certainty[0];
    EXPECT_THAT((std::vector{c.gof_p, c.set_p, c.lower, c.upper}), Each(IsNan()));
    EXPECT_THAT(c.own, Each(IsNan()));
    EXPECT_EQ(c.group, 0);
  }
}

TEST(Certainty, AModelThatAlwaysBlowsUpIsNotExplainedAway) {
  Scene s(3);
  s.add(1);
  s.add(1);
  for (SingleRun& run : s.bootstraps.of[1]) run = {PerColumn<Distribution>(kMetrics), true};
  s.fits[1].raw = Energies(kMetrics, s.target.worst());
  s.fits[1].score = -cost_of(s.fits[1].raw, s.weighting);
  s.fill();
  EXPECT_THAT(s.certainty[1].gof_p, IsNan());
  EXPECT_EQ(s.certainty[1].group, 2);
  EXPECT_GT(s.certainty[0].gof_p, 0.05);
}

TEST(Certainty, SameBitsForAnyNumberOfThreads) {
  const int before = omp_get_max_threads();
  std::vector<std::vector<double>> found;
  for (const int threads : {1, 3}) {
    omp_set_num_threads(threads);
    Scene s(3);
    s.add(1, 9);
    s.add(1.3, 9);
    s.fill();
    found.emplace_back();
    for (const Certainty& c : s.certainty)
      for (const double x : {c.gof_p, c.set_p, c.lower, c.upper, c.own[kJerk]}) found.back().push_back(x);
  }
  omp_set_num_threads(before);
  EXPECT_EQ(found[0], found[1]);
}

// The p of the model that made the recording, without fitting, is uniform: of 60, at most 8 are 0.05 or less and 18 to 42 are 0.5 or less
// (99 % of the binomial).
TEST(Certainty, GoodnessIsUniformUnderTheTruth) {
  int low = 0, half = 0;
  for (std::uint64_t seed = 101; seed <= 160; ++seed) {
    Scene s(seed);
    s.add(1, 19);
    s.fill();
    const double p = s.certainty[0].gof_p;
    low += p <= 0.05;
    half += p <= 0.5;
  }
  EXPECT_LE(low, 8);
  EXPECT_GE(half, 20);
  EXPECT_LE(half, 40);
}

// Planted parameters, unfitted, of every model that compare knows by default: p <= 0.05 should be rare. Of 48 recordings more than four
// happen to a uniform p once in ten times, and none to these seeds; eight if animals enter with exact velocities, five if an error that
// shows in no metric is simulated.
TEST(Certainty, EveryModelExplainsItsOwnRecordings) {
  constexpr Scales scales{100, 70, 225};
  constexpr int pooled = 12;
  int rejected = 0;
  for (const char* name : {"bswarm", "noise_aware", "boids", "rvo", "brownian", "langevin"}) {
    const ModelChoice model = parse_model(name);
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      PlantOptions film;
      film.frames = 300;
      film.unit = "mm";
      film.agents = 20;
      const auto truth = varied(model, planted_parameters(model, scales), scales, 2, seed);
      ConditionOptions options;
      options.steps = 10;  // as filmed
      const Conditions conditions = make_conditions(planted_recording(model, truth, film, scales, seed), options);
      const Target target(metric_samples(conditions.recording, conditions.metrics), Binning::standard(Normalisation::reference));
      const Objective objective(model, conditions, target);
      std::vector<bool> used;
      for (std::size_t j = 0; j < kMetrics; ++j) used.push_back(target.defined(j));
      const Weighting weighting = initial_weighting(used, target.worst());
      const Energies raw = objective.evaluate(truth, replicate_seeds({seed}, Stream::final_seeds, pooled)).raw;
      const Bootstrap bootstrap = bootstrap_of(objective, truth, {seed}, 39);
      const auto sure =
          certainties(std::array{Trial{{{-cost_of(raw, weighting), raw}}, {bootstrap, {bootstrap}, {0}, {1}}, &target, weighting}}, pooled);
      rejected += sure[0].gof_p <= 0.05;
    }
  }
  EXPECT_LE(rejected, 4);
}

}  // namespace
}  // namespace swarmfit
