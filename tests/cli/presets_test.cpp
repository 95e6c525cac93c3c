// SPDX-License-Identifier: MIT
#include "cli/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace swarmfit::cli {
namespace {

using testing::HasSubstr;

std::set<std::string> models_of(const std::string& preset) {
  std::set<std::string> names;
  for (const ModelChoice& choice : preset_models(preset)) EXPECT_TRUE(names.insert(choice.name).second) << choice.name << " twice";
  return names;
}

TEST(Presets, AreSeveralModelsEachAndSayWhich) {
  for (const auto name : preset_names()) {
    EXPECT_GE(models_of(std::string(name)).size(), 3u) << name;
    EXPECT_THAT(std::string(preset_help()), HasSubstr(std::string(name) + ": "));
    EXPECT_THAT(preset_list(), HasSubstr(std::string(name)));
  }
}

TEST(Presets, FlocksAreComparedByModelsOfFlocks) {
  EXPECT_EQ(models_of("flocks"), (std::set<std::string>{"bswarm", "boids", "vicsek", "zonal", "local_attraction",
                                                        "local_attraction[repulsion=on]", "pigeon", "langevin", "learned"}));
}

// Two controls: a force with a memory but no field, and a field that nobody shares. The paper has neither.
TEST(Presets, NoisesHaveControlsThatThePaperHasNot) {
  const auto ours = models_of("noise");
  EXPECT_EQ(ours.size(), 6u);
  EXPECT_TRUE(ours.contains("bswarm[noise=ou]") && ours.contains("bswarm[offset=per_agent]"));
  EXPECT_EQ(preset_models("noise", true).size(), 4u);
}

// All others, and every model that any recording can be compared with.
TEST(Presets, AllAreAllThatMoveInTwoAndThreeDimensions) {
  const auto all = models_of("all");
  for (const auto name : preset_names())
    for (const auto& model : models_of(std::string(name))) EXPECT_TRUE(all.contains(model)) << model;
  for (const ModelSpec& spec : models()) EXPECT_EQ(all.contains(spec.name), spec.dims.size() == 2 && spec.name != "fastswarm") << spec.name;
}

TEST(Presets, StudiesWithoutARecordingLeaveOutWhatLearnsFromOne) {
  auto models = preset_models("models");
  EXPECT_EQ(models.back().name, "learned");
  without_learners(models);
  EXPECT_EQ(models.back().name, "langevin");
}

}  // namespace
}  // namespace swarmfit::cli
