// SPDX-License-Identifier: MIT
// Real recordings against counts that were made with other programs when the files were collected (SciPy and NumPy; the SOURCE.md beside
// each file). They are not part of the repository.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <numeric>

#include "libtrack/cut.h"
#include "libtrack/kinematics.h"
#include "tests/track/build.h"

namespace swarmfit {
namespace {

using testing::HasSubstr;

std::string data(const std::string& name) { return std::string(SWARMFIT_SOURCE_DIR) + "/../shared/data/" + name; }

#define NEEDS(name) \
  if (!std::filesystem::exists(data(name))) GTEST_SKIP() << "SKIPPED: the recording " << name << " is not on this machine"

double median_length(const Tracks& tracks) {
  std::vector<std::size_t> length;
  for (std::uint32_t t = 0; t < tracks.track_count(); ++t) length.push_back(tracks.rows_of(t).size());
  std::sort(length.begin(), length.end());
  return static_cast<double>(length[length.size() / 2] + length[(length.size() - 1) / 2]) / 2;
}

Index most_at_once(const Tracks& tracks) {
  Index most = 0;
  for (const auto& frame : tracks.frames()) most = std::max(most, frame.count);
  return most;
}

// Mean of the speed in rows for which keep(row) holds.
template <class Keep>
double mean_speed(const Rows& velocity, Keep&& keep) {
  double sum = 0, n = 0;
  for (Index i = 0; i < velocity.rows(); ++i) {
    if (!std::isfinite(velocity(i, 0)) || !keep(i)) continue;
    sum += std::sqrt(velocity.row(i).square().sum());
    n += 1;
  }
  return sum / n;
}

double mean_speed(const Rows& velocity) {
  return mean_speed(velocity, [](Index) { return true; });
}

struct Expected {
  const char* file;
  std::size_t tracks, frames;
  double mean;  // individuals per frame
  Index most;
  double median;  // track length
  double speed;   // of differences, as given with two decimals of m/s
};

void compare(const Tracks& tracks, const Expected& e) {
  SCOPED_TRACE(e.file);
  EXPECT_EQ(tracks.track_count(), e.tracks);
  EXPECT_EQ(tracks.frames().size(), e.frames);
  EXPECT_NEAR(static_cast<double>(tracks.rows()) / static_cast<double>(e.frames), e.mean, 0.0501);  // given with one decimal
  EXPECT_EQ(most_at_once(tracks), e.most);
  EXPECT_NEAR(median_length(tracks), e.median, 1);  // upper or lower median
  const double unit = tracks.meta().unit == "m" ? 1 : 100;
  EXPECT_NEAR(mean_speed(forward_velocity(tracks)), e.speed, 0.00501 * unit);
}

TEST(RealFiles, Midges) {
  NEEDS("midge-lab-3d");
  const auto tracks =
      read_tracks(data("midge-lab-3d/BiologicalSwarmTimeSeries.txt"), {.columns = "id,x,y,z,t,vx,vy,vz,ax,ay,az", .unit = "mm"});
  compare(tracks, {"midges", 10, 502, 10, 10, 502, 225});
  EXPECT_EQ(tracks.rows(), 5020);
  EXPECT_EQ(tracks.dt(), 0.01);
  EXPECT_NEAR(tracks.time(tracks.frames().front().number), 0.06, 1e-12);
  EXPECT_NEAR(tracks.time(tracks.frames().back().number), 5.07, 1e-12);
  EXPECT_THAT(tracks.names(), testing::ElementsAre("5", "6", "10", "17", "30", "33", "34", "42", "70", "78"));
  EXPECT_THAT(tracks.meta().from.notes, testing::IsEmpty());
  EXPECT_EQ(tracks.pos()(0, 0), 29.23);
}

TEST(RealFiles, Jackdaws) {
  NEEDS("jackdaw-flocks-3d");
  const std::vector<Expected> table = {{"mob_04_p1", 15, 2209, 3.0, 7, 386, 7.17},   {"mob_04_p2", 26, 3548, 3.1, 8, 332, 7.14},
                                       {"mob_05_p1", 36, 2627, 3.3, 8, 216, 6.53},   {"mob_05_p2", 64, 2381, 7.0, 17, 206, 5.93},
                                       {"mob_10", 17, 1825, 3.0, 6, 250, 7.41},      {"transit_02", 232, 1220, 28.6, 81, 105, 9.47},
                                       {"transit_05", 56, 587, 15.2, 33, 192, 11.15}};
  for (const auto& e : table) {
    const auto tracks = read_tracks(data("jackdaw-flocks-3d/") + e.file + ".mat", {.unit = "m"});
    compare(tracks, e);
    EXPECT_EQ(tracks.dt(), 1.0 / 60) << e.file;
    EXPECT_TRUE(tracks.has_acceleration());
  }
}

// The authors count frames along the sorted unique times, from 1; without a stretch without birds that is a shift.
TEST(RealFiles, GoodStretchesOfTheTransitFlocks) {
  NEEDS("jackdaw-flocks-3d");
  const auto part = [](const std::string& file, double first, double last) {
    const auto path = data("jackdaw-flocks-3d/" + file);
    const double shift = static_cast<double>(read_tracks(path, {.unit = "m"}).frames().front().number) - 1;
    return read_tracks(path, {.unit = "m", .frames = Interval{first + shift, last + shift}});
  };
  compare(part("transit_02.mat", 750, 950), {"transit_02 good", 81, 201, 31.1, 42, 58, 14.25});
  compare(part("transit_05.mat", 100, 300), {"transit_05 good", 45, 201, 27.7, 33, 141, 11.43});
}

TEST(RealFiles, UnfilteredJackdawsByName) {
  NEEDS("jackdaw-flocks-3d");
  const auto path = data("jackdaw-flocks-3d/mob_10.mat");
  EXPECT_EQ(read_tracks(path, {.unit = "m", .variable = "tracks"}).rows(), 5424);
  EXPECT_EQ(read_tracks(path, {.columns = "id,x,y,_,t,_,_,_,_,_,_,_", .unit = "m"}).dims(), 2);
}

TEST(RealFiles, Pedestrians) {
  NEEDS("pedestrians-2d");
  const auto folder = data("pedestrians-2d/");
  compare(read_tracks(folder + "040_c_56_h-.txt"), {"bottleneck", 75, 1657, 38.1, 75, 820, 0.21});
  compare(read_tracks(folder + "bi_corr_400_b_03.txt"), {"counterflow", 480, 3247, 37.2, 50, 252, 104});
  compare(read_tracks(folder + "traj_UNI_CORR_500_01.txt", {.unit = "m"}), {"corridor", 148, 1889, 13.5, 20, 170, 1.47});
  compare(read_tracks(folder + "uo-100-180-180.txt", {.fps = 16, .unit = "cm"}), {"uo-100", 121, 944, 23.0, 31, 180, 125});
  compare(read_tracks(folder + "uo-180-180-070.txt", {.fps = 16, .unit = "cm"}), {"uo-180", 148, 1600, 47.1, 76, 557, 48.7});
  for (const auto* file : {"uo-100-180-180.txt", "uo-180-180-070.txt"})
    EXPECT_THAT([&] { read_tracks(folder + file); }, testing::ThrowsMessage<InputError>(HasSubstr("`fps` 25 `unit` m")));
}

TEST(RealFiles, SheepDogAndShepherd) {
  NEEDS("sheep-dog-2d");
  const auto tracks = read_tracks(data("sheep-dog-2d/drives_data.mat"), {.unit = "m"});
  EXPECT_EQ(tracks.track_count(), 16u);
  EXPECT_EQ(tracks.frames().size(), 8556u);
  EXPECT_EQ(tracks.rows(), 16 * 8556);
  EXPECT_EQ(tracks.episodes().size(), 28u) << "29 drives";
  EXPECT_EQ(kind_named(tracks, "dog"), 1);
  EXPECT_EQ(of_kind(tracks, 0).track_count(), 14u);
  EXPECT_EQ(tracks.dt(), 0.1);
  EXPECT_EQ(tracks.dims(), 2);
  const auto v = forward_velocity(tracks);
  const auto kind = [&](std::uint8_t k) { return [&tracks, k](Index i) { return tracks.kind(i) == k; }; };
  EXPECT_NEAR(mean_speed(v, kind(0)), 1.28, 0.005);
  EXPECT_NEAR(mean_speed(v, kind(1)), 1.47, 0.005);
  EXPECT_NEAR(mean_speed(v, kind(2)), 0.57, 0.005);
  // Across a seam between two drives the apparent speed is up to 490 m/s.
  double fastest = 0;
  for (Index i = 0; i < v.rows(); ++i)
    if (std::isfinite(v(i, 0))) fastest = std::max(fastest, std::hypot(v(i, 0), v(i, 1)));
  EXPECT_LT(fastest, 20);
}

std::string refusal(const std::string& name) {
  try {
    read_tracks(data(name));
  } catch (const InputError& error) {
    return std::string(error.what()).substr(data(name).size());
  }
  return "no error";
}

// Pickles of two protocols. Counts by NumPy.
TEST(RealFiles, Zebrafish) {
  NEEDS("zebrafish-2d");
  const auto eight = read_tracks(data("zebrafish-2d/test_trajectories_idtrackerai_with_border.npy"));
  EXPECT_EQ(eight.meta().from.format, "idtracker-npy");
  EXPECT_EQ(eight.meta().unit, "px");
  EXPECT_EQ(eight.track_count(), 8U);
  EXPECT_EQ(eight.frames().size(), 508U);
  EXPECT_NEAR(eight.dt(), 1.0 / 28, 1e-12);
  EXPECT_NEAR(mean_speed(forward_velocity(eight), [](Index) { return true; }), 147, 1);
  const auto fifteen = read_tracks(data("zebrafish-2d/trajectories_with_points.npy"));
  EXPECT_EQ(fifteen.track_count(), 15U);
  EXPECT_EQ(fifteen.frames().size(), 1000U);
  EXPECT_NEAR(fifteen.dt(), 1.0 / 32, 1e-12);
  EXPECT_NEAR(mean_speed(forward_velocity(fifteen), [](Index) { return true; }), 372, 1);
}

TEST(RealFiles, Refusals) {
  NEEDS("goats-gps-2d");
  NEEDS("grevys-zebra-drone-2d");
  EXPECT_THAT(refusal("goats-gps-2d/01.csv"), HasSubstr(":35:12: '25:00:34' is not a time"));
  EXPECT_THAT(refusal("goats-gps-2d/10.csv"), HasSubstr("expected one row per individual and frame"));
  EXPECT_EQ(refusal("goats-gps-2d/02.csv"), "no error") << "degrees are projected";
  EXPECT_THAT(refusal("grevys-zebra-drone-2d/trackIDs.csv"), HasSubstr(":1: no position columns among trackID, ob_name, focal, indID"));
  EXPECT_THAT(refusal("grevys-zebra-drone-2d/trackspps.csv"), HasSubstr(":1: no position columns among indID, species, age, sex"));
  EXPECT_THAT(refusal("grevys-zebra-drone-2d/tracks027_final.npy"), HasSubstr("the array is 7 x 15979 x 2; expected `columns`"));
}

}  // namespace
}  // namespace swarmfit
