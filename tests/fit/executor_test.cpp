// SPDX-License-Identifier: MIT
// Who does the work, by themselves and at once with who keeps it: what a thread sanitizer is to look at.
#include "fit/experiment/executor.h"

#include <gtest/gtest.h>
#include <omp.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>

#include "fit/store/checkpoint.h"

namespace swarmfit {
namespace {

namespace fs = std::filesystem;

struct FourThreads : testing::Test {
  FourThreads() { omp_set_num_threads(4); }
  ~FourThreads() override { omp_set_num_threads(before_); }

 private:
  int before_ = omp_get_max_threads();
};

std::string key(std::size_t k) { return sha256_hex(std::to_string(k)); }

TEST_F(FourThreads, ResultsStandInOrder) {
  const auto results = threads().each<std::uint64_t>(200, [](std::size_t k) { return std::uint64_t{k * k}; });
  ASSERT_EQ(results.size(), 200U);
  for (std::size_t k = 0; k < results.size(); ++k) EXPECT_EQ(results[k], k * k);
}

TEST_F(FourThreads, LongPiecesAreStoppedFromWithin) {
  std::atomic<bool> stop = false;
  const Threads here([&] { return stop.load(); });
  const auto forever = [&](std::size_t) -> std::string {
    for (int turn = 0;; ++turn) {
      if (turn == 1000) stop = true;
      here.stop_if_asked();
    }
  };
  EXPECT_THROW(static_cast<void>(here.run(8, forever)), Interrupted);
  EXPECT_NO_THROW(threads().stop_if_asked());
}

// Whether or not another thread adds at that moment, what was there is found, and in the end all of it is.
TEST_F(FourThreads, ACheckpointMayBeAskedByAll) {
  const fs::path dir = fs::temp_directory_path() / ("swarmfit_executor_" + std::to_string(::getpid()));
  fs::create_directories(dir);
  const std::string path = (dir / "checkpoint").string();
  const RunIdentity run{"1", "", "[fit]\n"};
  const Checkpoint::Record first{key(0), "0"};
  Checkpoint(path, run, [] {}).add({&first, 1});
  std::atomic<int> told = 0;
  {
    Checkpoint checkpoint(path, run);
    checkpoint.on_add([&] { ++told; });
    const auto found = threads().each<std::string>(100, [&](std::size_t k) {
      const Checkpoint::Record record{key(k + 1), std::to_string(k + 1)};
      checkpoint.add({&record, 1});
      return checkpoint.find(key(0)).value_or("lost");
    });
    for (const std::string& value : found) EXPECT_EQ(value, "0");
  }
  EXPECT_EQ(told, 100);
  EXPECT_EQ(Checkpoint(path, run).size(), 101U);
  fs::remove_all(dir);
}

}  // namespace
}  // namespace swarmfit
