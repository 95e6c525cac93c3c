// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <filesystem>

#include "libtrack/error.h"
#include "libtrack/read.h"

namespace swarmfit {
namespace {

TEST(ReadText, MidgeFile) {
  const std::string path = SWARMFIT_SOURCE_DIR "/../shared/data/midge-lab-3d/BiologicalSwarmTimeSeries.txt";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "SKIPPED: " << path << " is not on this machine";
  const Tracks tracks = read_tracks(path, {.columns = "id,x,y,z,t,vx,vy,vz,ax,ay,az", .unit = "mm"});
  EXPECT_EQ(tracks.rows(), 5020);
  EXPECT_EQ(tracks.track_count(), 10u);
  EXPECT_EQ(tracks.frames().size(), 502u);
  EXPECT_EQ(tracks.frames().front().number, 6);
  EXPECT_EQ(tracks.dt(), 0.01);
  EXPECT_EQ(tracks.meta().t0, 0);
}

}  // namespace
}  // namespace swarmfit
