// SPDX-License-Identifier: MIT
#include "fit/results/axis_scale.h"

#include <gtest/gtest.h>

namespace swarmfit {
namespace {

TEST(AxisScale, FollowsTheLowerBound) {
  EXPECT_EQ(scale_of(true, 0.1), AxisScale::logarithmic);
  EXPECT_EQ(scale_of(false, 0), AxisScale::root);
  EXPECT_EQ(scale_of(false, -1), AxisScale::linear);
  EXPECT_EQ(scale_of(false, 0.1), AxisScale::linear);
}

TEST(AxisScale, Places) {
  EXPECT_DOUBLE_EQ(place_on(AxisScale::linear, 2, 10, 4), 0.25);
  EXPECT_DOUBLE_EQ(place_on(AxisScale::root, 0, 16, 4), 0.5);
  EXPECT_DOUBLE_EQ(place_on(AxisScale::root, 1, 16, 4), 1. / 3);
  EXPECT_DOUBLE_EQ(place_on(AxisScale::logarithmic, 1, 16, 4), 0.5);
  EXPECT_EQ(place_on(AxisScale::root, 0, 16, -1), 0);
}

TEST(AxisScale, ValuesAndPlacesAreInverse) {
  for (const auto scale : {AxisScale::linear, AxisScale::root, AxisScale::logarithmic})
    for (const double lower : {0.0, 0.5}) {
      if (lower == 0 && scale == AxisScale::logarithmic) continue;
      EXPECT_DOUBLE_EQ(value_at(scale, lower, 7, 0), lower);
      EXPECT_NEAR(value_at(scale, lower, 7, 1), 7, 1e-14);
      for (const double u : {0.1, 0.4, 0.9}) EXPECT_NEAR(place_on(scale, lower, 7, value_at(scale, lower, 7, u)), u, 1e-14);
    }
}

}  // namespace
}  // namespace swarmfit
