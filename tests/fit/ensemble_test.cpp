// SPDX-License-Identifier: MIT
#include "fit/experiment/ensemble.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>

#include "fit/experiment/plant.h"
#include "libtrack/cut.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

namespace fs = std::filesystem;

const RunIdentity kRun{"1.2.3", "abcdef", "[fit]\n"};

class EnsembleTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(dir_); }
  void TearDown() override { fs::remove_all(dir_); }
  std::string path() const { return (dir_ / "checkpoint").string(); }

  std::vector<Job> jobs(int count) const {
    return jobs_on(scene_parameters(model, test::midge_parameters()), replicate_seeds({1}, Stream::replicate, count));
  }
  // Sum of the positions that were seen: another one for every seed.
  std::vector<double> sums(const Conditions& under, int count, Checkpoint* checkpoint, const std::string& name = "sum", int stop_at = -1) {
    const Threads here([&, stop_at] { return stop_at >= 0 && asked++ >= stop_at; });
    return Ensemble(model, under, {&here, checkpoint}).measured<double>(jobs(count), name, [&](const swarmfit::Run& run, std::size_t) {
      ++made;
      return run.seen.pos().sum();
    });
  }

  fs::path dir_ = fs::temp_directory_path() / ("swarmfit_ensemble_" + std::to_string(::getpid()));
  ModelChoice model = parse_model("bswarm[avoidance=none]");
  Tracks recording = test::planted_swarm(3);
  Conditions conditions = make_conditions(recording, {});
  std::atomic<int> made = 0, asked = 0;
};

TEST_F(EnsembleTest, MeasuresEachRunAsItIsMadeAlone) {
  const auto found = sums(conditions, 5, nullptr);
  const Ensemble ensemble(model, conditions);
  const auto one_by_one = jobs(5);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(found[k], ensemble.run(one_by_one[k]).seen.pos().sum()) << k;
  EXPECT_EQ(made, 5);
}

TEST_F(EnsembleTest, SimulatesNothingTwice) {
  const auto first = [&] {
    Checkpoint checkpoint(path(), kRun, [] {});
    return sums(conditions, 5, &checkpoint);
  }();
  Checkpoint checkpoint(path(), kRun);
  const auto more = sums(conditions, 8, &checkpoint);
  EXPECT_EQ(made, 5 + 3);
  EXPECT_EQ(std::vector<double>(more.begin(), more.begin() + 5), first);
  sums(conditions, 5, &checkpoint, "another number");
  EXPECT_EQ(made, 5 + 3 + 5);
  sums(conditions, 5, &checkpoint, "");
  EXPECT_EQ(made, 5 + 3 + 5 + 5) << "what has no name is not kept";
}

// Asked once before its only piece, and then between frames.
TEST_F(EnsembleTest, StopsWithinASimulation) {
  EXPECT_THROW(sums(conditions, 1, nullptr, "", 5), Interrupted);
  EXPECT_EQ(made, 0);
  EXPECT_EQ(asked, 6);
}

TEST_F(EnsembleTest, KeepsWhatWasDoneWhenItIsStopped) {
  constexpr int kAll = 150;
  const int per_run = 1 + static_cast<int>(conditions.frames);
  {
    Checkpoint checkpoint(path(), kRun, [] {});
    EXPECT_THROW(sums(conditions, kAll, &checkpoint, "sum", 140 * per_run), Interrupted);
  }
  made = 0;
  Checkpoint checkpoint(path(), kRun);
  EXPECT_EQ(sums(conditions, kAll, &checkpoint), sums(conditions, kAll, nullptr));
  EXPECT_EQ(made, kAll - 2 * 64 + kAll) << "two batches of 64 were kept";
}

TEST_F(EnsembleTest, TellsConditionsAndStepsApart) {
  {
    Checkpoint checkpoint(path(), kRun, [] {});
    sums(conditions, 2, &checkpoint);
  }
  Checkpoint checkpoint(path(), kRun);
  const Conditions half = make_conditions(cut(recording, 0, recording.frames().back().number / 2), {});
  sums(half, 2, &checkpoint);
  EXPECT_EQ(made, 4);
  Conditions blurred = conditions;
  blurred.sigma += 1;
  sums(blurred, 2, &checkpoint);
  EXPECT_EQ(made, 6);
  Conditions fine = conditions;
  fine.options.steps = 2 * Ensemble(model, conditions).steps();
  sums(fine, 2, &checkpoint);
  EXPECT_EQ(made, 8);
}

TEST_F(EnsembleTest, PassesOnWhatAMeasureThrows) {
  const Ensemble ensemble(model, conditions);
  const auto broken = [](const swarmfit::Run&, std::size_t k) -> double { return k == 3 ? throw std::domain_error("no") : 1.0; };
  EXPECT_THROW(ensemble.measured<double>(jobs(6), "", broken), std::domain_error);
}

TEST(Bytes, HoldWhatIsPutIn) {
  const std::optional<std::vector<double>> maybe(std::vector<double>{1.5, -2});
  const std::string words("two\0words", 9);
  PerColumn<std::vector<double>> columns(2);
  columns[1] = {3};
  const std::string bytes = to_bytes(maybe) + to_bytes(words) + to_bytes(columns);
  ByteReader from(bytes);
  EXPECT_EQ(from.take<std::optional<std::vector<double>>>(), maybe);
  EXPECT_EQ(from.take<std::string>(), words);
  EXPECT_EQ(from.take<PerColumn<std::vector<double>>>(), columns);
  EXPECT_TRUE(from.ended());
  EXPECT_THROW(from_bytes<double>("1234567"), std::logic_error);
  EXPECT_THROW(from_bytes<std::vector<double>>("\xff\xff\xff\xff"), std::logic_error);
}

}  // namespace
}  // namespace swarmfit
