// SPDX-License-Identifier: MIT
#include "libtrack/curve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "libtrack/error.h"
#include "libtrack/read/read_curve.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using testing::HasSubstr;

const Curve kSquare{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, true};

TEST(Curve, LengthsAndDistances) {
  EXPECT_EQ(kSquare.length(), 8);
  EXPECT_EQ(kSquare.spacing(), 2);
  EXPECT_EQ((Curve{kSquare.points, false}.length()), 6);
  EXPECT_NEAR(distance_to(kSquare, {1, 1, 0}), 1, 1e-15);
  EXPECT_NEAR(distance_to(kSquare, {1, -3, 4}), 5, 1e-15);
  EXPECT_NEAR(distance_to(kSquare, {-3, -4, 0}), 5, 1e-15);
  EXPECT_NEAR(distance_to(kSquare, {-0.5, 1, 0}), 0.5, 1e-15);                // the side that closes it
  EXPECT_NEAR(distance_to({kSquare.points, false}, {0.25, 1, 0}), 1, 1e-15);  // which an open one has not
}

TEST(Curve, PlacesAreEvenlySpaced) {
  const auto places = places_along(kSquare, 16);
  ASSERT_EQ(places.size(), 16u);
  for (std::size_t k = 0; k < 16; ++k) {
    EXPECT_NEAR(distance_to(kSquare, places[k]), 0, 1e-12);
    EXPECT_NEAR((places[(k + 1) % 16] - places[k]).abs().sum(), 0.5, 1e-12);  // along the sides
  }
  const auto open = places_along({{{0, 0, 0}, {3, 0, 0}}, false}, 4);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(open[static_cast<std::size_t>(k)][0], k, 1e-12);
}

TEST(Curve, HeartAndStarHaveTheKeyPointsOfThePaper) {
  EXPECT_EQ(heart().points.size(), 11u);
  EXPECT_EQ(star().points.size(), 10u);
  EXPECT_TRUE(heart().closed && star().closed);
  EXPECT_NEAR(heart().points[0][1], 5, 1e-12);  // 13 - 5 - 2 - 1
  EXPECT_NEAR(star().points[0].matrix().norm() / star().points[1].matrix().norm(), 1 / 0.382, 1e-12);
  const Curve upright = placed(star(), 3, {1, 2, 3}, true);
  EXPECT_NEAR(upright.spacing(), 3 * star().spacing(), 1e-12);
  EXPECT_NEAR(upright.points[0][2] - 3, 3, 0.01);  // its top is up
  for (const Array3d& p : upright.points) EXPECT_NEAR(p[1], 2, 1e-12);
}

class CurveFile : public testing::Test {
 protected:
  ~CurveFile() override { std::filesystem::remove(path_); }
  DrawnCurve read(const std::string& text, const char* ending = ".csv") {
    std::filesystem::remove(path_);
    path_ = std::filesystem::temp_directory_path() / ("swarmfit_curve_" + std::to_string(getpid()) + ending);
    std::ofstream(path_) << text;
    return read_curve(path_.string());
  }
  std::string error(const std::string& text, const char* ending = ".csv") {
    try {
      read(text, ending);
    } catch (const InputError& e) {
      return std::string(e.what()).substr(path_.string().size());
    }
    return "none";
  }
  std::filesystem::path path_;
};

TEST_F(CurveFile, OfLines) {
  const auto drawn = read("x,y,z\n# a corner\n0,0,0\n1,0,0\n1,2.5,-1\n");
  EXPECT_TRUE(drawn.in_units);
  EXPECT_FALSE(drawn.curve.closed);
  ASSERT_EQ(drawn.curve.points.size(), 3u);
  EXPECT_TRUE((drawn.curve.points[2] == Array3d(1, 2.5, -1)).all());
  const auto closed = read("0 0\n1 0\n1 1\n0 0\n").curve;
  EXPECT_TRUE(closed.closed);
  EXPECT_EQ(closed.points.size(), 3u);
}

TEST_F(CurveFile, OfPictures) {
  const auto polygon = read(R"(<svg xmlns="http://www.w3.org/2000/svg"><g><polygon points="0,0 4,0 4,3"/></g></svg>)", ".svg");
  EXPECT_FALSE(polygon.in_units);
  EXPECT_TRUE(polygon.curve.closed);
  EXPECT_TRUE((polygon.curve.points[2] == Array3d(4, -3, 0)).all());  // y points down in pictures
  const auto path = read(R"(<svg><path d="M1 2 h3 v-1 l-1,-1 L 0 0 z"/></svg>)", ".svg").curve;
  EXPECT_TRUE(path.closed);
  ASSERT_EQ(path.points.size(), 5u);
  const double expected[5][2] = {{1, -2}, {4, -2}, {4, -1}, {3, 0}, {0, 0}};
  for (std::size_t k = 0; k < 5; ++k) EXPECT_TRUE((path.points[k] == Array3d(expected[k][0], expected[k][1], 0)).all()) << k;
  EXPECT_FALSE(read(R"(<svg><polyline points="0 0 1 1"/></svg>)", ".svg").curve.closed);
}

TEST_F(CurveFile, RefusesWhatIsNoCurve) {
  EXPECT_EQ(error("x,y\n1,2\n"), ": 1 point; expected a curve of at least two");
  EXPECT_EQ(error("1,2\n3,four\n"), ":2:3: no point; expected two or three numbers: x,y or x,y,z");
  EXPECT_EQ(error("1,2\n3,4,5,6\n"), ":2:7: no point; expected two or three numbers: x,y or x,y,z");
  EXPECT_EQ(error("1,2\n1,2\n1,2\n"), ": all points are at one place; expected a curve");
  EXPECT_THAT(error("<svg><circle r=\"1\"/></svg>", ".svg"), HasSubstr("no curve; expected a polyline, a polygon or a path"));
  EXPECT_THAT(error("<svg>\n<path d=\"M0 0 C1 1 2 2 3 3\"/></svg>", ".svg"), HasSubstr("expected straight lines only"));
  EXPECT_THAT(error("<svg><polyline points=\"0 0 1\"/></svg>", ".svg"), HasSubstr("an x without its y"));
}

}  // namespace
}  // namespace swarmfit
