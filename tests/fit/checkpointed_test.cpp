// SPDX-License-Identifier: MIT
#include "fit/store/checkpointed.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "fit/study/parameter_recovery.h"

namespace swarmfit {
namespace {

namespace fs = std::filesystem;

const RunIdentity kRun{"1.2.3", "", "[recover]\n"};

class KeptTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(dir_); }
  void TearDown() override { fs::remove_all(dir_); }
  std::string path() const { return (dir_ / "checkpoint").string(); }

  fs::path dir_ = fs::temp_directory_path() / ("swarmfit_kept_" + std::to_string(::getpid()));
};

RecoveryCase recovery_example() { return {1, 7, {0.1, -2}, {"bswarm", "boids"}, {0.9, NAN}, {0.01, 0.02}, {1, 2}, {0.5, 0.01}, 1}; }

std::string bytes_of(const auto& part) {
  std::string out;
  put(out, part);
  return out;
}

TEST_F(KeptTest, IsMadeOnceAndThenFound) {
  int made = 0;
  const auto make = [&] { return ++made, std::optional(recovery_example()); };
  {
    Checkpoint checkpoint(path(), kRun, [] {});
    checkpointed<RecoveryCase>(&checkpoint, "one", make);
    checkpointed<RecoveryCase>(&checkpoint, "other", make);
    EXPECT_EQ(made, 2);
  }
  Checkpoint checkpoint(path(), kRun);
  const auto found = checkpointed<RecoveryCase>(&checkpoint, "one", make);
  EXPECT_EQ(made, 2);
  ASSERT_TRUE(found);
  EXPECT_EQ(bytes_of(*found), bytes_of(recovery_example()));
  EXPECT_EQ(found->order, recovery_example().order);
  EXPECT_EQ(found->group, recovery_example().group);
  checkpointed<RecoveryCase>(nullptr, "one", make);
  EXPECT_EQ(made, 3) << "nothing is kept without a checkpoint";
}

TEST_F(KeptTest, NothingIsKeptAsNothing) {
  int made = 0;
  const auto make = [&]() -> std::optional<RecoveryCase> { return ++made, std::nullopt; };
  {
    Checkpoint checkpoint(path(), kRun, [] {});
    EXPECT_FALSE(checkpointed<RecoveryCase>(&checkpoint, "blew up", make));
  }
  Checkpoint checkpoint(path(), kRun);
  EXPECT_FALSE(checkpointed<RecoveryCase>(&checkpoint, "blew up", make));
  EXPECT_EQ(made, 1);
}

TEST_F(KeptTest, WhatCannotBeReadIsMadeAgain) {
  const std::string whole = bytes_of(std::uint8_t{1}) + bytes_of(recovery_example());
  for (const std::string& bytes : {whole.substr(0, whole.size() - 1), whole + '\0', std::string("\1\xff\xff\xff\xff", 5), std::string()}) {
    const Checkpoint::Record record{sha256_hex("one"), bytes};
    Checkpoint(path(), kRun, [] {}).add({&record, 1});
    Checkpoint checkpoint(path(), kRun);
    int made = 0;
    checkpointed<RecoveryCase>(&checkpoint, "one", [&] { return ++made, std::optional(recovery_example()); });
    EXPECT_EQ(made, 1) << bytes.size();
  }
}

TEST_F(KeptTest, ParametersSurviveToTheBit) {
  ParameterCase one;
  one.seed = 3;
  one.truth = {1.5, NAN};
  one.found = {{0, "gamma", 0.1, 0.05, 0.2, 0.9, Identifiability::identified, "noise", -0.8},
               {4, "noise", 1, 0, 2, 0.1, Identifiability::flat, "", 0}};
  one.truth_place = {0.3, 0.4};
  one.median_place = {0.5, 0.6};
  one.width = {0.1, 1};
  const std::string bytes = bytes_of(one);
  ByteReader from(bytes);
  ParameterCase again;
  from.take(again);
  EXPECT_TRUE(from.ended());
  EXPECT_EQ(bytes_of(again), bytes);
  ASSERT_EQ(again.found.size(), 2u);
  EXPECT_EQ(again.found[0].partner, "noise");
  EXPECT_EQ(again.found[1].verdict, Identifiability::flat);
  EXPECT_EQ(again.found[0].correlation, -0.8);
}

}  // namespace
}  // namespace swarmfit
