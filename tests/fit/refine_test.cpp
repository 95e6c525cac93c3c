// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <stdexcept>

#include "fit/optimise/differential_evolution.h"
#include "tests/fit/test_functions.h"

namespace swarmfit {
namespace {

using namespace swarmfit::testing;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::Ge;
using ::testing::Le;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

BatchCost each(const std::function<double(const Point&)>& cost) {
  return [cost](const std::vector<Point>& points) {
    std::vector<double> costs;
    for (const Point& x : points) costs.push_back(cost(x));
    return costs;
  };
}

std::vector<Evaluated> starts_of(const TestFunction& f, int count, double distance) {
  std::vector<Evaluated> starts;
  for (int i = 1; i <= count; ++i) {
    Point x = f.optimum.array() + distance * i;
    starts.push_back({x, f.cost(x)});
  }
  return starts;
}

TEST(Refine, FollowsRosenbrocksValleyToTheEnd) {
  const auto f = rosenbrock(4, 1);
  RefineOptions options;
  options.evaluations = 2000;
  const auto result = refine(starts_of(f, 2, 0.02), each(f.cost), options);
  EXPECT_LT(result.best.front().cost, 1e-8);
  EXPECT_EQ(result.stop, Stop::converged);
  EXPECT_LT(result.evaluations, 4000) << "it stops by itself";
}

TEST(Refine, IsNeverWorseThanTheStart) {
  const auto f = sphere(3, 1);
  const std::vector<Evaluated> optimum{{f.optimum, 0}};
  EXPECT_EQ(refine(optimum, each(f.cost), {}).best.front().x, f.optimum);
  const auto rough = noisy(rastrigin(5, 1), 3, 2);
  auto starts = starts_of(rough, 2, 0.01);
  std::sort(starts.begin(), starts.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; });
  EXPECT_LE(refine(starts, each(rough.cost), {}).best.front().cost, starts.front().cost);
}

TEST(Refine, CapIsHardAndUnrefinedStartsAreKept) {
  const auto f = rosenbrock(6, 1);
  const auto starts = starts_of(f, 5, 0.01);
  for (const int cap : {0, 1, 2, 5, 7, 50}) {
    std::atomic<int> calls = 0;
    RefineOptions options;
    options.evaluations = cap;
    const auto result = refine(starts, each([&](const Point& x) { return (++calls, f.cost(x)); }), options);
    EXPECT_LE(calls, 2 * cap);
    EXPECT_EQ(result.evaluations, calls);
    EXPECT_EQ(static_cast<int>(result.visited.size()), calls);
    EXPECT_EQ(result.best.size(), starts.size());
    EXPECT_TRUE(std::is_sorted(result.best.begin(), result.best.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; }));
    EXPECT_EQ(result.stop, cap > 0 ? Stop::evaluations : Stop::converged);
  }
}

TEST(Refine, StaysInTheCubeAndReachesItsCorner) {
  const std::vector<Evaluated> starts{{Point::Constant(3, 0.02), 0.06}, {Point::Constant(3, 0.98), 2.94}};
  RefineOptions options;
  options.evaluations = 500;
  const auto result = refine(starts, each([](const Point& x) { return x.sum(); }), options);
  for (const auto& e : result.visited) EXPECT_THAT(e.x, Each(AllOf(Ge(0.0), Le(1.0))));
  EXPECT_LT(result.best.front().cost, 1e-5);
}

TEST(Refine, FailuresNeverWin) {
  const auto f = sphere(3, 1);
  const double edge = f.optimum[0] + 0.01;
  const auto result = refine(starts_of(f, 2, 0.05), each([&](const Point& x) { return x[0] < edge ? nan : f.cost(x); }), {});
  EXPECT_GE(result.best.front().x[0], edge);
  EXPECT_LT(result.best.front().cost, starts_of(f, 1, 0.05)[0].cost);
  EXPECT_TRUE(std::any_of(result.visited.begin(), result.visited.end(), [](const auto& e) { return std::isinf(e.cost); }));
}

TEST(Refine, SameBitsForAnyNumberOfThreads) {
  const auto f = noisy(rosenbrock(4, 2), 0.1, 3);
  const auto starts = starts_of(f, 4, 0.02);
  RefineOptions options;
  options.starts = 4;
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const auto one = refine(starts, each(f.cost), options);
  omp_set_num_threads(4);
  const auto four = refine(starts, each(f.cost), options);
  omp_set_num_threads(threads);
  ASSERT_EQ(one.visited.size(), four.visited.size());
  for (std::size_t i = 0; i < one.visited.size(); ++i) EXPECT_EQ(one.visited[i].x, four.visited[i].x);
  ASSERT_EQ(one.best.size(), four.best.size());
  for (std::size_t i = 0; i < one.best.size(); ++i) EXPECT_EQ(one.best[i].x, four.best[i].x);
}

TEST(Refine, StartsThatMeetAreOneResult) {
  const auto f = sphere(2, 1);
  const Point x = f.optimum.array() + 0.1;
  const std::vector<Evaluated> twice(2, {x, f.cost(x)});
  EXPECT_EQ(refine(twice, each(f.cost), {}).best.size(), 1u);
}

TEST(Refine, ExceptionsOfTheObjectiveArePassedOn) {
  const auto f = sphere(2, 1);
  EXPECT_THROW(refine(starts_of(f, 2, 0.1), each([](const Point&) -> double { throw std::domain_error("no"); }), {}), std::domain_error);
}

TEST(Refine, NothingToDoIsFine) { EXPECT_TRUE(refine({}, each(sphere(2, 1).cost), {}).best.empty()); }

}  // namespace
}  // namespace swarmfit
