// SPDX-License-Identifier: MIT
#include "fit/infer/posterior.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace swarmfit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kGrid = 200;

Simulator in_turn(const std::function<std::optional<VectorXd>(const Point&, const Rng&)>& simulate) {
  return [simulate](const std::vector<Draw>& draws) {
    std::vector<std::optional<VectorXd>> out;
    for (const Draw& draw : draws) out.push_back(simulate(draw.x, draw.rng));
    return out;
  };
}

// A problem whose posterior is known up to integrals on a grid.
struct Toy {
  int dimensions;
  std::function<std::optional<VectorXd>(const Point&, const Rng&)> simulate;  // one
  Simulator all() const { return in_turn(simulate); }
  std::function<double(const VectorXd& features, const Point& x)> log_likelihood;  // up to a constant
};

double normal(const Rng& rng, std::uint64_t tick) { return rng.normal2(Stream::noise, tick, 0)[0]; }

// One measurement of x with this error, and twenty features that are noise.
Toy mean_with_error(const std::function<double(double)>& error) {
  return {1,
          [error](const Point& x, const Rng& rng) -> std::optional<VectorXd> {
            VectorXd f(21);
            f[0] = x[0] + error(x[0]) * normal(rng, 0);
            for (int k = 1; k < 21; ++k) f[k] = normal(rng, static_cast<std::uint64_t>(k));
            return f;
          },
          [error](const VectorXd& f, const Point& x) {
            const double sd = error(x[0]);
            return -0.5 * std::pow((f[0] - x[0]) / sd, 2) - std::log(sd);
          }};
}

// Thirty values of a normal distribution, mean 4 x0 - 2 and log standard deviation 2 x1 - 1: its mean, its log sd and order statistics.
Toy mean_and_spread() {
  static constexpr int n = 30;
  return {2,
          [](const Point& x, const Rng& rng) -> std::optional<VectorXd> {
            std::vector<double> values;
            for (std::uint64_t i = 0; i < n; ++i) values.push_back(4 * x[0] - 2 + std::exp(2 * x[1] - 1) * normal(rng, i));
            std::sort(values.begin(), values.end());
            VectorXd f = VectorXd::Zero(10);
            for (const double v : values) f[0] += v / n;
            double square = 0;
            for (const double v : values) square += std::pow(v - f[0], 2);
            f[1] = 0.5 * std::log(square / (n - 1));
            for (int k = 0; k < 8; ++k) f[2 + k] = values[static_cast<std::size_t>(3 * k + 4)];
            return f;
          },
          [](const VectorXd& f, const Point& x) {
            const double log_sd = 2 * x[1] - 1, square = (n - 1) * std::exp(2 * f[1]) + n * std::pow(f[0] - 4 * x[0] + 2, 2);
            return -n * log_sd - 0.5 * square * std::exp(-2 * log_sd);
          }};
}

// The same with a third coordinate that nothing depends on.
Toy with_idle_coordinate() {
  Toy toy = mean_and_spread();
  toy.dimensions = 3;
  return toy;
}

// Only the sum is measured.
Toy sum_of_two() {
  return {2,
          [](const Point& x, const Rng& rng) -> std::optional<VectorXd> {
            VectorXd f(3);
            f << x[0] + x[1] + 0.05 * normal(rng, 0), normal(rng, 1), normal(rng, 2);
            return f;
          },
          [](const VectorXd& f, const Point& x) { return -0.5 * std::pow((f[0] - x[0] - x[1]) / 0.05, 2); }};
}

// Distribution functions of the first two coordinates (of one) at the upper ends of kGrid cells.
std::vector<std::vector<double>> exact_marginals(const Toy& toy, const VectorXd& observed) {
  const int d = std::min(toy.dimensions, 2);
  std::vector<std::vector<double>> density(static_cast<std::size_t>(d), std::vector<double>(kGrid, 0.0));
  Point x = Point::Constant(toy.dimensions, 0.5);
  std::vector<double> log_l;
  for (int i = 0; i < kGrid; ++i)
    for (int j = 0; j < (d == 2 ? kGrid : 1); ++j) {
      x[0] = (i + 0.5) / kGrid;
      if (d == 2) x[1] = (j + 0.5) / kGrid;
      log_l.push_back(toy.log_likelihood(observed, x));
    }
  const double most = *std::max_element(log_l.begin(), log_l.end());
  for (std::size_t k = 0; k < log_l.size(); ++k) {
    const double p = std::exp(log_l[k] - most);
    density[0][d == 2 ? k / kGrid : k] += p;
    if (d == 2) density[1][k % kGrid] += p;
  }
  for (auto& m : density) {
    std::partial_sum(m.begin(), m.end(), m.begin());
    for (double& c : m) c /= m.back();
  }
  if (toy.dimensions > 2) {
    density.emplace_back();
    for (int i = 0; i < kGrid; ++i) density.back().push_back((i + 1.0) / kGrid);
  }
  return density;
}

double weight_below(const Posterior& p, Index a, double at) {
  double sum = 0;
  for (std::size_t i = 0; i < p.sample.size(); ++i)
    if (p.sample[i][a] < at) sum += p.weight[i];
  return sum;
}

// Kolmogorov distance of one coordinate of the sample.
double distance(const Posterior& p, Index a, const std::vector<double>& exact) {
  double most = 0;
  for (int i = 0; i < kGrid; ++i)
    most = std::max(most, std::abs(weight_below(p, a, (i + 1.0) / kGrid) - exact[static_cast<std::size_t>(i)]));
  return most;
}

struct Trial {
  Point truth;
  Posterior posterior;
  std::vector<double> distances;
};

std::vector<Trial> trials(const Toy& toy, int count, const PosteriorOptions& options) {
  std::vector<Trial> out;
  for (int k = 0; k < count; ++k) {
    const Rng rng{static_cast<std::uint64_t>(k) + 1};
    Point truth(toy.dimensions);
    for (Index a = 0; a < truth.size(); ++a) truth[a] = rng.uniform(Stream::probe, 0, static_cast<std::uint32_t>(a));
    const VectorXd observed = *toy.simulate(truth, rng.derive(Stream::probe, 1));
    out.push_back({truth, posterior(observed, toy.dimensions, toy.all(), rng, options), {}});
    const auto exact = exact_marginals(toy, observed);
    for (std::size_t a = 0; a < exact.size(); ++a)
      out.back().distances.push_back(distance(out.back().posterior, static_cast<Index>(a), exact[a]));
  }
  return out;
}

double mean_distance(const std::vector<Trial>& all, std::size_t a) {
  double sum = 0;
  for (const Trial& t : all) sum += t.distances[a];
  return sum / static_cast<double>(all.size());
}

double mean_effective(const std::vector<Trial>& all) {
  double sum = 0;
  for (const Trial& t : all) sum += t.posterior.effective;
  return sum / static_cast<double>(all.size());
}

// Mean Kolmogorov distance of n independent draws from their own distribution: sqrt(pi / 2) ln 2 / sqrt(n).
double of_independent_draws(double n) { return std::sqrt(std::acos(-1.0) / 2) * std::log(2.0) / std::sqrt(n); }

TEST(Posterior, OfANormalMeanIsTheTruncatedNormal) {
  const auto all = trials(mean_with_error([](double) { return 0.1; }), 40, {3, 200, 0.3});
  // The regression's intercept is uncertain by a standard deviation over sqrt(n), too, which alone makes a mean distance of
  // sqrt(2 / pi) / sqrt(2 pi) = 0.32 / sqrt(n); and that of the learned statistic is as large again or less.
  const double n = mean_effective(all);
  EXPECT_LT(mean_distance(all, 0), of_independent_draws(n) + 2 * 0.32 / std::sqrt(n));
  for (const Trial& t : all) EXPECT_NE(t.posterior.marginals[0].verdict, Identifiability::flat);
}

// Steep growth of the error, and nearly everything kept: without rescaling, the spread of large parameters is taken for that of small ones
// (mean width 0.29 with, 0.40 without).
TEST(Posterior, ResidualsAreRescaledWhereTheSpreadDependsOnTheParameter) {
  const Toy toy = mean_with_error([](double x) { return 0.01 * std::exp(3.5 * x); });
  VectorXd observed = VectorXd::Zero(21);
  observed[0] = 0.15;
  double width = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Marginal m = posterior(observed, 1, toy.all(), Rng{seed}, {1, 600, 0.9}).marginals[0];
    width += (m.upper - m.lower) / 20;
  }
  EXPECT_LT(width, 0.35);
}

// Few points and many coordinates: residuals of what the regression was fitted to would be a tenth too small in variance.
TEST(Posterior, WhatNothingDependsOnKeepsThePriorsVariance) {
  double contraction = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto noise = [](const Point&, const Rng& rng) -> std::optional<VectorXd> {
      VectorXd f(8);
      for (int k = 0; k < 8; ++k) f[k] = normal(rng, static_cast<std::uint64_t>(k));
      return f;
    };
    for (const Marginal& m : posterior(VectorXd::Zero(8), 8, in_turn(noise), Rng{seed}, {1, 330, 0.3}).marginals)
      contraction += m.contraction / 160;
  }
  EXPECT_NEAR(contraction, 0, 0.06);
}

TEST(Posterior, OfMeanAndSpreadAndOfWhatNothingDependsOn) {
  const auto all = trials(with_idle_coordinate(), 40, {4, 300, 0.3});
  const double n = mean_effective(all);
  // Twice what exact draws have: straight lines through a curved regression (measured: 1.6 to 1.8 times).
  EXPECT_LT(mean_distance(all, 0), 2 * of_independent_draws(n));
  EXPECT_LT(mean_distance(all, 1), 2 * of_independent_draws(n));
  EXPECT_LT(mean_distance(all, 2), 1.3 * of_independent_draws(n));
  for (const Trial& t : all) {
    EXPECT_EQ(t.posterior.marginals[2].verdict, Identifiability::flat);
    EXPECT_LT(t.posterior.marginals[2].contraction, 0.3);
  }
}

TEST(Posterior, OfTwoThatOnlyCountTogetherIsARidge) {
  const Toy toy = sum_of_two();
  VectorXd observed(3);
  observed << 1.0, 0, 0;
  const Posterior p = posterior(observed, 2, toy.all(), Rng{7}, {3, 300, 0.3});
  for (std::size_t a = 0; a < 2; ++a) {
    EXPECT_EQ(p.marginals[a].verdict, Identifiability::flat);
    EXPECT_EQ(p.marginals[a].partner, static_cast<int>(1 - a));
    // Uniform along the diagonal with a spread of 0.05 across: 1 - 0.05² / (2 / 12) or so.
    EXPECT_LT(p.marginals[a].correlation, -0.95);
    EXPECT_LT(distance(p, static_cast<Index>(a), exact_marginals(toy, observed)[a]), 1.63 / std::sqrt(p.effective));  // 1 % level
  }
  double mean = 0, square = 0;
  for (std::size_t i = 0; i < p.sample.size(); ++i) mean += p.weight[i] * p.sample[i].sum();
  for (std::size_t i = 0; i < p.sample.size(); ++i) square += p.weight[i] * std::pow(p.sample[i].sum() - mean, 2);
  EXPECT_NEAR(mean, 1, 0.02);
  EXPECT_NEAR(std::sqrt(square), 0.05, 0.03) << "a straight ridge is bent a little where coordinates are stretched";
}

// Talts et al. 2018 (arXiv:1804.06788): the rank of a truth from the prior among draws from its posterior is uniform.
TEST(Posterior, IsCalibratedBySimulation) {
  constexpr int kRuns = 300, kDraws = 19;  // draws far fewer than the effective size: about independent
  const auto all = trials(with_idle_coordinate(), kRuns, {3, 240, 0.3});
  for (Index a = 0; a < 3; ++a) {
    std::vector<double> count(kDraws + 1, 0.0);
    int covered = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Posterior& p = all[k].posterior;
      EXPECT_GT(p.effective, 3 * kDraws);
      std::size_t rank = 0;
      for (std::uint32_t draw = 0; draw < kDraws; ++draw) {
        double rest = Rng{99}.uniform(Stream::probe, k, draw);
        std::size_t i = 0;
        while (i + 1 < p.weight.size() && rest >= p.weight[i]) rest -= p.weight[i++];
        rank += p.sample[i][a] < all[k].truth[a];
      }
      ++count[rank];
      const Marginal& m = p.marginals[static_cast<std::size_t>(a)];
      covered += m.lower <= all[k].truth[a] && all[k].truth[a] <= m.upper;
    }
    double chi2 = 0;
    for (const double c : count) chi2 += std::pow(c - kRuns / 20.0, 2) / (kRuns / 20.0);
    EXPECT_LT(chi2, 36.19) << "1 % level, 19 degrees of freedom; coordinate " << a;
    EXPECT_GE(covered, 275) << "99 % of a binomial with 300 and 0.95; coordinate " << a;
    EXPECT_LE(covered, 294) << a;
  }
}

TEST(Posterior, SameSeedSameBitsForAnyNumberOfThreads) {
  const Toy toy = with_idle_coordinate();
  const VectorXd observed = *toy.simulate(Point::Constant(3, 0.4), Rng{5});
  const int before = omp_get_max_threads();
  std::vector<Posterior> all;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    all.push_back(posterior(observed, 3, toy.all(), Rng{11}, {2, 150, 0.3}));
  }
  omp_set_num_threads(before);
  for (const Posterior& p : all) {
    EXPECT_EQ(p.sample, all[0].sample);
    EXPECT_EQ(p.weight, all[0].weight);
    EXPECT_EQ(p.marginals[0].upper, all[0].marginals[0].upper);
  }
  EXPECT_NE(posterior(observed, 3, toy.all(), Rng{12}, {2, 150, 0.3}).sample, all[0].sample);
}

TEST(Posterior, RunsThatBlowUpAreCountedAndWeighNothing) {
  const Toy toy = mean_with_error([](double) { return 0.2; });
  const auto fragile = [&](const Point& x, const Rng& rng) {
    auto f = toy.simulate(x, rng);
    if (x[0] > 0.8) f.reset();
    if (x[0] < 0.1) (*f)[3] = NAN;
    return f;
  };
  VectorXd observed = VectorXd::Zero(21);
  observed[0] = 0.7;
  const Posterior p = posterior(observed, 1, in_turn(fragile), Rng{3}, {2, 400, 0.3});
  EXPECT_NEAR(p.rounds[0].blew_up, 0.3 * 400, 3 * std::sqrt(400 * 0.3 * 0.7));
  EXPECT_EQ(p.rounds[0].in_box, 400 - p.rounds[0].blew_up);
  EXPECT_LE(p.rounds[1].in_box, 800 - p.rounds[0].blew_up - p.rounds[1].blew_up);
  EXPECT_GT(weight_below(p, 0, 0.82), 0.97) << "adjusted points may overshoot a little";
  EXPECT_LT(weight_below(p, 0, 0.4), 0.15);
}

TEST(Posterior, WithoutChanceIsAPointAndWithoutInformationThePrior) {
  const auto exact = [](const Point& x, const Rng&) { return std::optional<VectorXd>(x); };
  const Posterior point = posterior(Point::Constant(2, 0.3), 2, in_turn(exact), Rng{1}, {3, 200, 0.3});
  EXPECT_NEAR(point.marginals[1].median, 0.3, 0.01);
  EXPECT_LT(point.marginals[1].upper - point.marginals[1].lower, 0.05);
  const auto constant = [](const Point&, const Rng&) { return std::optional<VectorXd>(VectorXd::Ones(3)); };
  const Posterior prior = posterior(VectorXd::Ones(3), 2, in_turn(constant), Rng{1}, {2, 300, 0.3});
  EXPECT_EQ(prior.marginals[0].verdict, Identifiability::flat);
  EXPECT_NEAR(prior.marginals[0].median, 0.5, 0.1);
}

TEST(Posterior, IsThePriorWhereNothingEndsWell) {
  const Box start{Point::Zero(2), Point::Constant(2, 0.5)};
  const Posterior p =
      posterior(VectorXd::Zero(2), 2, in_turn([](const Point&, const Rng&) { return std::nullopt; }), Rng{1}, {2, 50, 0.3}, &start);
  EXPECT_TRUE(p.sample.empty());
  EXPECT_EQ(p.rounds[1].blew_up, 50);
  EXPECT_EQ(p.marginals[1].verdict, Identifiability::flat);
  EXPECT_NEAR(p.marginals[1].upper, 0.4875, 1e-12);
  VectorXd undefined = VectorXd::Zero(2);
  undefined[1] = NAN;
  EXPECT_THROW(posterior(undefined, 2, sum_of_two().all(), Rng{1}), std::invalid_argument);
}

TEST(Posterior, StaysInTheBoxItStartedFromAndSaysWhenItReachesABound) {
  const Toy toy = mean_with_error([](double) { return 0.1; });
  VectorXd observed = VectorXd::Zero(21);
  observed[0] = 0.7;
  const Box start{Point::Constant(1, 0.2), Point::Constant(1, 0.7)};
  const Posterior p = posterior(observed, 1, toy.all(), Rng{3}, {3, 300, 0.3}, &start);
  for (const Point& x : p.sample) EXPECT_TRUE(x[0] >= 0.2 && x[0] <= 0.7);
  EXPECT_EQ(p.marginals[0].verdict, Identifiability::one_sided);
  const Posterior free = posterior(observed, 1, toy.all(), Rng{3}, {3, 300, 0.3});
  EXPECT_EQ(free.marginals[0].verdict, Identifiability::identified);
  EXPECT_NEAR(free.marginals[0].median, 0.7, 0.03);
  EXPECT_NEAR(free.marginals[0].contraction, 1 - 12 * 0.01, 0.06) << "a variance of 0.1² of 1/12";
}

TEST(Posterior, RoundsNarrowTheBoxAndReuseWhatLiesInIt) {
  const Toy toy = mean_with_error([](double) { return 0.02; });
  VectorXd observed = VectorXd::Zero(21);
  observed[0] = 0.5;
  const Posterior p = posterior(observed, 1, toy.all(), Rng{3}, {3, 200, 0.3});
  EXPECT_EQ(p.rounds[0].volume, 1);
  EXPECT_LT(p.rounds[2].volume, 0.3);
  EXPECT_GT(p.rounds[2].volume, 4 * 0.02);
  EXPECT_GT(p.rounds[2].in_box, 200) << "and some of the earlier rounds";
  // Epanechnikov weights of distances that are uniform, as in one dimension they are: (2/3)² / (8/15).
  EXPECT_NEAR(p.effective / p.rounds[2].kept, 5.0 / 6, 0.04);
  EXPECT_NEAR(std::accumulate(p.weight.begin(), p.weight.end(), 0.0), 1, 1e-12);
}

TEST(WeightedQuantile, OfEqualWeightsHasEqualChanceInEveryGap) {
  std::vector<double> values, weights(19, 1.0 / 19);
  for (int k = 0; k < 19; ++k) values.push_back((k * 7) % 19 + 1);
  for (int k = 1; k <= 19; ++k) EXPECT_NEAR(weighted_quantile(values, weights, k / 20.0), k, 1e-9);
  EXPECT_NEAR(weighted_quantile(values, weights, 0.125), 2.5, 1e-9);
  EXPECT_EQ(weighted_quantile(values, weights, 0.0), 1);
  EXPECT_EQ(weighted_quantile(values, weights, 1.0), 19);
  EXPECT_EQ(weighted_quantile({3, 1, 2}, {0, 0, 1}, 0.5), 2);
}

// As the speed of a model in which all fly equally fast: boxes shrink to it, but never to nothing.
TEST(Posterior, ACoordinateThatIsReadOffExactlyStaysFinite) {
  const Simulator simulate = in_turn([](const Point& x, const Rng&) { return std::optional(VectorXd{{x[0] - 0.37}}); });
  const Posterior found = posterior(VectorXd{{0.0}}, 1, simulate, {3}, {40, 60});
  ASSERT_FALSE(found.sample.empty());
  for (const Point& x : found.sample) EXPECT_TRUE(x[0] >= 0 && x[0] <= 1) << x[0];
  EXPECT_NEAR(found.marginals[0].median, 0.37, 1e-5);
  EXPECT_EQ(found.marginals[0].verdict, Identifiability::identified);
}

}  // namespace
}  // namespace swarmfit
