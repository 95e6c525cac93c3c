// SPDX-License-Identifier: MIT
#include "fit/compare/without_one.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace swarmfit {
namespace {

// The energies of leave_one_out_test: without d, a overtakes b.
TEST(WithoutEach, RanksTheOthers) {
  RecordingFacts recording;
  recording.observation.used = PerColumn<bool>{};
  recording.observation.used[0] = recording.observation.used[1] = true;
  std::vector<ModelFit> models;
  const std::array<std::pair<const char*, std::array<double, 2>>, 4> table{
      {{"b", {1, 0}}, {"a", {0, 4}}, {"d", {10, 1}}, {"c", {0.9, 10}}}};
  for (const auto& [name, raw] : table) {
    models.emplace_back().model = name;
    std::copy(raw.begin(), raw.end(), models.back().runs.raw_energies.begin());
    models.back().standing.in_sample.score = -static_cast<double>(models.size());
  }
  const auto without = without_each(models, recording);
  ASSERT_EQ(without.size(), 4u);
  EXPECT_EQ(without[2].model, "d");
  EXPECT_EQ(without[2].ranking.front().first, "a");
  EXPECT_TRUE(without[2].reordered);
  EXPECT_TRUE(without[2].winner_changed);
  EXPECT_FALSE(without[0].winner_changed) << "b itself was left out";
}

}  // namespace
}  // namespace swarmfit
