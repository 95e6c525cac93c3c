// SPDX-License-Identifier: MIT
#include "fit/model_fit/scout.h"

#include <gmock/gmock.h>
#include <omp.h>

#include <atomic>
#include <cmath>

#include "fit/study/recovery.h"

namespace swarmfit {
namespace {

// Where regressions find the parameters of a planted model, on the axes of its search.
struct Scene {
  Scene(const char* name, std::uint64_t seed) : model(parse_model(name)) {
    constexpr Scales kScales{100, 70, 225};
    PlantOptions film;
    film.agents = 10;
    film.frames = 120;
    film.unit = "mm";
    truth = varied(model, planted_parameters(model, kScales), kScales, 2, seed);
    recording = planted_recording(model, truth, film, kScales, seed);
    ConditionOptions options;
    options.error = ConditionOptions::Error::none;
    conditions = make_conditions(recording, options);
  }
  std::vector<Point> points(const ScoutSize& size, const OnScout& on_scout = {}, const Executor& executor = threads()) const {
    const Target target(metric_samples(recording), Binning::standard(Normalisation::reference));
    const Objective objective(model, conditions, target, {&executor});
    return scout(SearchSpace(model, conditions.scales, {}), objective, {1}, size, on_scout);
  }

  ModelChoice model;
  std::vector<double> truth;
  Tracks recording;
  Conditions conditions;
};

// The noise of ten recordings, on a logarithmic scale: the medians err by less than half of what the table's default does.
TEST(Scout, ReadsTheNoiseOffTheRecording) {
  double scouted = 0, by_default = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Scene s("brownian", seed);
    const SearchSpace space(s.model, s.conditions.scales, {});
    const auto row = static_cast<std::size_t>(s.model.spec->find("D"));
    const auto error = [&](const Point& x) { return std::abs(std::log(space.parameters(x)[row] / s.truth[row])); };
    scouted += error(s.points({2, 100}).front());
    by_default += error(space.start());
  }
  EXPECT_LT(scouted, 0.5 * by_default);
}

TEST(Scout, SameBitsForAnyNumberOfThreads) {
  const int before = omp_get_max_threads();
  const Scene s("bswarm", 1);
  std::vector<std::vector<Point>> found;
  for (const int threads : {1, 3}) {
    omp_set_num_threads(threads);
    found.push_back(s.points({1, 330}));
  }
  omp_set_num_threads(before);
  ASSERT_EQ(found[0].size(), 12u);
  for (std::size_t k = 0; k < found[0].size(); ++k) {
    EXPECT_TRUE(found[0][k] == found[1][k]);
    EXPECT_TRUE((found[0][k].array() >= 0).all() && (found[0][k].array() <= 1).all());
  }
}

// In the fourth round, when there is a sample already.
TEST(Scout, EndsWhenToldTo) {
  std::atomic<int> asked = 0;
  const Threads stopping([&] { return ++asked > 350; });
  std::vector<std::int64_t> told;
  EXPECT_THROW(Scene("brownian", 1)
                   .points(
                       {4, 100}, [&](std::int64_t done) { told.push_back(done); }, stopping),
               Interrupted);
  EXPECT_EQ(told, (std::vector<std::int64_t>{100, 200, 300}));
}

}  // namespace
}  // namespace swarmfit
