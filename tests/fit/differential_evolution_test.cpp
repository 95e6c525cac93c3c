// SPDX-License-Identifier: MIT
#include "fit/optimise/differential_evolution.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

#include "libtrack/error.h"
#include "tests/fit/test_functions.h"

namespace swarmfit {
namespace {

using namespace swarmfit::testing;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::Le;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Remembers every batch it was asked for.
struct Recorder {
  std::function<double(const Point&)> f;
  std::vector<std::vector<Point>> batches;

  BatchCost batch() {
    return [this](const std::vector<Point>& points) {
      batches.push_back(points);
      std::vector<double> costs;
      for (const Point& x : points) costs.push_back(f(x));
      return costs;
    };
  }
  std::vector<Point> all() const {
    std::vector<Point> points;
    for (const auto& batch : batches) points.insert(points.end(), batch.begin(), batch.end());
    return points;
  }
};

EvolutionOptions budget_of(std::int64_t evaluations) {
  EvolutionOptions options;
  options.generations = 1000;
  options.max_evaluations = evaluations;
  return options;
}

TEST(TestFunctions, AreZeroAtTheirOptimumAndNowhereElse) {
  for (const int d : {1, 2, 7}) {
    for (const TestFunction& f :
         {rastrigin(d, 3), rotated_rastrigin(d, 3), sphere(d, 3), histograms(d, 3), rosenbrock(std::max(2, d), 3)}) {
      EXPECT_NEAR(f.truth(f.optimum), 0, 1e-12) << f.name;
      EXPECT_GT(f.truth(f.optimum + Point::Constant(f.optimum.size(), 0.01)), 1e-3) << f.name;
    }
  }
}

TEST(TestFunctions, NoiseIsFrozenStandardNormalAndIndependentBetweenNeighbours) {
  double sum = 0, squares = 0, products = 0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const Point x = Point::Constant(3, i * 1e-9), y = Point::Constant(3, (i + 1) * 1e-9);
    EXPECT_EQ(noise_at(x, 5), noise_at(x, 5));
    sum += noise_at(x, 5);
    squares += noise_at(x, 5) * noise_at(x, 5);
    products += noise_at(x, 5) * noise_at(y, 5);
  }
  EXPECT_NEAR(sum / n, 0, 4 / std::sqrt(n));  // four standard errors
  EXPECT_NEAR(squares / n, 1, 4 * std::sqrt(2.0 / n));
  EXPECT_NEAR(products / n, 0, 4 / std::sqrt(n));
}

TEST(DifferentialEvolution, FirstGenerationIsALatinHypercube) {
  Recorder recorder{sphere(5, 1).cost, {}};
  differential_evolution(5, recorder.batch(), budget_of(40), Rng{1});
  ASSERT_EQ(recorder.batches.size(), 1u);
  ASSERT_EQ(recorder.batches[0].size(), 40u);
  for (int k = 0; k < 5; ++k) {
    std::vector<int> hits(40);
    for (const Point& x : recorder.batches[0]) ++hits.at(static_cast<std::size_t>(x[k] * 40));
    EXPECT_THAT(hits, Each(1)) << "coordinate " << k;
  }
}

TEST(DifferentialEvolution, FindsThePlantedOptimum) {
  for (const int d : {1, 2, 5}) {
    const auto f = sphere(d, 4);
    const auto result = differential_evolution(d, f.batch(), budget_of(1500), Rng{2});
    EXPECT_LT((result.best.front().x - f.optimum).lpNorm<Eigen::Infinity>(), 1e-4) << d << " dimensions";
  }
}

// A curved valley (Rosenbrock's) is found sooner by who sees what the cost is made of.
TEST(DifferentialEvolution, PartsOfTheCostShowTheWay) {
  const auto parts = [](const Point& x) {
    Eigen::VectorXd out(2 * (x.size() - 1));
    for (Eigen::Index k = 0; k + 1 < x.size(); ++k) {
      const double u = 4 * x[k] - 2, v = 4 * x[k + 1] - 2;
      out[2 * k] = 10 * (v - u * u), out[2 * k + 1] = 1 - u;
    }
    return out;
  };
  const BatchCost cost = [&](const std::vector<Point>& points) {
    std::vector<double> costs;
    for (const Point& x : points) costs.push_back(parts(x).squaredNorm());
    return costs;
  };
  EvolutionOptions options{.population = 20, .generations = 25};
  const double blind = differential_evolution(5, cost, options, Rng{1}).best.front().cost;
  options.parts = parts;
  EXPECT_LT(differential_evolution(5, cost, options, Rng{1}).best.front().cost, 1e-3 * blind);
}

TEST(DifferentialEvolution, NeverLeavesTheCubeEvenWithTheOptimumInACorner) {
  Recorder recorder{[](const Point& x) { return x.sum(); }, {}};
  const auto result = differential_evolution(4, recorder.batch(), budget_of(1500), Rng{3});
  for (const Point& x : recorder.all()) EXPECT_THAT(x, Each(AllOf(Ge(0.0), Le(1.0))));
  EXPECT_LT(result.best.front().cost, 1e-3);
}

TEST(DifferentialEvolution, BudgetIsNeverExceeded) {
  for (const std::int64_t limit : {1, 3, 39, 40, 41, 97, 500}) {
    Recorder recorder{rastrigin(3, 1).cost, {}};
    const auto result = differential_evolution(3, recorder.batch(), budget_of(limit), Rng{1});
    EXPECT_EQ(static_cast<std::int64_t>(recorder.all().size()), limit);
    EXPECT_EQ(result.evaluations, limit);
    EXPECT_EQ(static_cast<std::int64_t>(result.visited.size()), limit);
    EXPECT_EQ(result.stop, Stop::evaluations);
  }
}

TEST(DifferentialEvolution, ChildrenRaceAgainstTheirOwnParents) {
  const auto f = rastrigin(3, 1);
  EvolutionOptions options = budget_of(400);
  Recorder recorder{f.cost, {}};
  const auto plain = differential_evolution(3, recorder.batch(), options, Rng{1});
  int given_up = 0;
  options.race = [&](const std::vector<Point>& children, const std::vector<Point>& parents) {
    std::vector<double> costs;
    EXPECT_EQ(children.size(), parents.size());
    for (std::size_t i = 0; i < children.size(); ++i) {
      const bool worse = f.cost(children[i]) >= f.cost(parents[i]);
      given_up += worse;
      costs.push_back(worse ? std::numeric_limits<double>::infinity() : f.cost(children[i]));
    }
    return costs;
  };
  Recorder first{f.cost, {}};
  const auto raced = differential_evolution(3, first.batch(), options, Rng{1});
  EXPECT_EQ(static_cast<int>(first.all().size()), options.population) << "the first population has no parents";
  EXPECT_EQ(raced.evaluations, plain.evaluations) << "who was given up counts as well";
  EXPECT_GT(given_up, 100);
  EXPECT_EQ(
      static_cast<int>(std::count_if(raced.visited.begin(), raced.visited.end(), [](const Evaluated& e) { return std::isinf(e.cost); })),
      given_up);
  EXPECT_LT(raced.best.front().cost, 5) << "and the search still works";
}

TEST(DifferentialEvolution, PlanIsPopulationTimesGenerations) {
  EvolutionOptions options;
  options.population = 20;
  options.generations = 10;
  Recorder recorder{rastrigin(6, 1).cost, {}};
  const auto result = differential_evolution(6, recorder.batch(), options, Rng{1});
  EXPECT_EQ(result.evaluations, 200);
  EXPECT_EQ(result.stop, Stop::generations);
  EXPECT_EQ(result.generations, static_cast<int>(recorder.batches.size()));
}

TEST(DifferentialEvolution, PopulationShrinksToAFifth) {
  Recorder recorder{rastrigin(6, 1).cost, {}};
  differential_evolution(6, recorder.batch(), budget_of(2400), Rng{1});
  const auto& batches = recorder.batches;
  for (std::size_t g = 1; g < batches.size(); ++g) EXPECT_LE(batches[g].size(), batches[g - 1].size());
  EXPECT_EQ(batches[batches.size() - 2].size(), 8u);
}

TEST(DifferentialEvolution, BestIsAscendingDistinctAndAmongTheVisited) {
  const auto f = rastrigin(3, 2);
  const auto result = differential_evolution(3, f.batch(), budget_of(600), Rng{7});
  ASSERT_FALSE(result.best.empty());
  for (std::size_t i = 0; i < result.best.size(); ++i) {
    EXPECT_EQ(result.best[i].cost, f.cost(result.best[i].x));
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(same(result.best[i].x, result.best[j].x));
  }
  EXPECT_TRUE(std::is_sorted(result.best.begin(), result.best.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; }));
  double lowest = nan;
  for (const auto& v : result.visited) lowest = std::fmin(lowest, v.cost);
  EXPECT_EQ(result.best.front().cost, lowest) << "elitism: the best ever seen survives";
}

TEST(DifferentialEvolution, NoCandidateIsTriedTwiceInAGeneration) {
  // The corner attracts everything, and many different steps end on the same two points of one dimension.
  Recorder recorder{[](const Point& x) { return x[0]; }, {}};
  differential_evolution(1, recorder.batch(), budget_of(600), Rng{1});
  for (const auto& batch : recorder.batches) {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(same(batch[i], batch[j]));
    }
  }
}

TEST(DifferentialEvolution, SameSeedSameBitsAndAnotherSeedAnotherSearch) {
  const auto f = noisy(rastrigin(4, 1), 0.5, 9);
  const auto a = differential_evolution(4, f.batch(), budget_of(700), Rng{5});
  const auto b = differential_evolution(4, f.batch(), budget_of(700), Rng{5});
  const auto c = differential_evolution(4, f.batch(), budget_of(700), Rng{6});
  ASSERT_EQ(a.visited.size(), b.visited.size());
  for (std::size_t i = 0; i < a.visited.size(); ++i) EXPECT_EQ(a.visited[i].x, b.visited[i].x);
  EXPECT_NE(a.visited[0].x, c.visited[0].x);
}

TEST(DifferentialEvolution, ConstantObjectiveStallsAndSaysSo) {
  EvolutionOptions options;
  options.stall = 3;
  const auto result = differential_evolution(
      3, [](const auto& points) { return std::vector<double>(points.size(), 1.0); }, options, Rng{1});
  EXPECT_EQ(result.stop, Stop::stalled);
  // Gains are counted from the first generation's end, and the stall is noticed at the end of one.
  EXPECT_GE(result.evaluations, 4 * 40);
  EXPECT_LT(result.evaluations, 5 * 40);
  EXPECT_EQ(to_string(result.stop), "stalled");
}

TEST(DifferentialEvolution, ProgressOfTheEliteIsNoStall) {
  // The start is the optimum itself, so the best cannot gain; the others still do.
  const auto f = sphere(4, 1);
  EvolutionOptions options;
  options.stall = 2;
  options.generations = 20;
  const auto result = differential_evolution(4, f.batch(), options, Rng{1}, {{f.optimum, -1.0}});
  EXPECT_GT(result.evaluations, 6 * 40);
}

TEST(DifferentialEvolution, FailedCandidatesNeverWin) {
  const auto f = sphere(3, 6);
  Recorder recorder{[&](const Point& x) {
                      if (x[0] < 0.1) return nan;
                      if (x[1] < 0.1) return -std::numeric_limits<double>::infinity();
                      return x[2] < 0.1 ? std::numeric_limits<double>::infinity() : f.cost(x);
                    },
                    {}};
  const auto result = differential_evolution(3, recorder.batch(), budget_of(800), Rng{1});
  EXPECT_LT((result.best.front().x - f.optimum).norm(), 0.01);
  EXPECT_EQ(result.visited.size(), 800u);
  int failures = 0;
  for (const auto& e : result.visited) {
    EXPECT_FALSE(std::isnan(e.cost));
    failures += std::isinf(e.cost);
    if (std::isinf(e.cost)) {
      EXPECT_GT(e.cost, 0);
    }
  }
  EXPECT_GT(failures, 0);
}

TEST(DifferentialEvolution, FailuresOnlyEndWithoutABest) {
  EvolutionOptions options;
  options.stall = 2;
  double reported = 0;
  const auto result = differential_evolution(
      2, [](const auto& points) { return std::vector<double>(points.size(), nan); }, options, Rng{1}, {},
      [&](const GenerationReport& report) { return (reported = report.best, true); });
  EXPECT_TRUE(result.best.empty());
  EXPECT_EQ(static_cast<std::int64_t>(result.visited.size()), result.evaluations);
  EXPECT_EQ(result.stop, Stop::stalled);
  EXPECT_TRUE(std::isinf(reported));
}

TEST(DifferentialEvolution, LeavesAFailedRegionAsSoonAsOneCandidateSucceeds) {
  // Only a hundredth of the square is alive, and the first sample misses it.
  const Point alive = Point::Constant(2, 0.93);
  Recorder recorder{[&](const Point& x) { return (x - alive).lpNorm<Eigen::Infinity>() < 0.05 ? (x - alive).norm() : nan; }, {}};
  const auto result = differential_evolution(2, recorder.batch(), budget_of(2000), Rng{8});
  ASSERT_FALSE(result.best.empty());
  EXPECT_LT(result.best.front().cost, 1e-3);
}

TEST(DifferentialEvolution, WarmStartIsTrustedAndNotEvaluatedAgain) {
  const auto f = sphere(3, 2);
  const std::vector<Evaluated> start{{Point::Constant(3, 0.9), 5}, {f.optimum, -7}, {Point::Constant(3, 0.2), nan}};
  Recorder recorder{f.cost, {}};
  const auto result = differential_evolution(3, recorder.batch(), budget_of(400), Rng{1}, start);
  EXPECT_EQ(recorder.batches[0].size(), 38u) << "two finite starts, the rest is sampled";
  for (const Point& x : recorder.all()) EXPECT_NE(x, f.optimum);
  EXPECT_EQ(result.best.front().cost, -7);
  EXPECT_EQ(result.best.front().x, f.optimum);
  EXPECT_EQ(result.visited.size(), 400u) << "starts were not visited";
}

TEST(DifferentialEvolution, OfTooManyStartsTheBestArePopulation) {
  std::vector<Evaluated> start;
  for (int i = 0; i < 100; ++i) start.push_back({Point::Constant(2, i / 100.0), 100.0 - i});
  EvolutionOptions options;
  options.max_evaluations = 40;
  Recorder recorder{[](const Point&) { return 1000.0; }, {}};
  const auto result = differential_evolution(2, recorder.batch(), options, Rng{1}, start);
  ASSERT_GE(result.best.size(), 8u);
  EXPECT_EQ(result.best[0].cost, 1);
  EXPECT_EQ(result.best[7].cost, 8);
}

TEST(DifferentialEvolution, RepeatedStartsCountOnce) {
  const std::vector<Evaluated> start(10, {Point::Constant(2, 0.5), 1});
  Recorder recorder{sphere(2, 1).cost, {}};
  differential_evolution(2, recorder.batch(), budget_of(100), Rng{1}, start);
  EXPECT_EQ(recorder.batches[0].size(), 39u);
}

TEST(DifferentialEvolution, CallbackSeesEveryGenerationAndInterrupts) {
  std::vector<GenerationReport> reports;
  const auto f = sphere(2, 1);
  const auto result = differential_evolution(2, f.batch(), {}, Rng{1}, {}, [&](const GenerationReport& report) {
    reports.push_back(report);
    return report.generation < 4;
  });
  EXPECT_EQ(result.stop, Stop::interrupted);
  ASSERT_EQ(reports.size(), 4u);
  EXPECT_EQ(reports[0].generation, 1);
  EXPECT_EQ(reports[0].evaluations, 40);
  for (std::size_t i = 1; i < reports.size(); ++i) EXPECT_LE(reports[i].best, reports[i - 1].best);
  EXPECT_EQ(result.evaluations, reports.back().evaluations);
  EXPECT_EQ(result.best.front().cost, reports.back().best);
}

TEST(DifferentialEvolution, SmallestPopulationWorks) {
  EvolutionOptions options;
  options.population = 4;
  options.generations = 100;
  const auto f = sphere(2, 3);
  EXPECT_LT(differential_evolution(2, f.batch(), options, Rng{1}).best.front().cost, 0.1);
}

TEST(DifferentialEvolution, OptionsOutOfRangeAreNamed) {
  const auto message = [](int dimensions, const EvolutionOptions& options) -> std::string {
    try {
      differential_evolution(dimensions, sphere(2, 1).batch(), options, Rng{1});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EvolutionOptions options;
  EXPECT_EQ(message(0, options), "search: dimensions 0; expected at least 1");
  options.population = 3;
  EXPECT_THAT(message(2, options), HasSubstr("population 3"));
  options = {};
  options.generations = 0;
  EXPECT_THAT(message(2, options), HasSubstr("generations 0"));
  options = {};
  options.stall = 0;
  EXPECT_THAT(message(2, options), HasSubstr("stall 0"));
  options = {};
  options.max_evaluations = -1;
  EXPECT_THAT(message(2, options), HasSubstr("max_evaluations -1"));
}

}  // namespace
}  // namespace swarmfit
