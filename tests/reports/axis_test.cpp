// SPDX-License-Identifier: MIT
#include "reports/draw/axis.h"

#include <gmock/gmock.h>

#include <cmath>

namespace swarmfit::plot {
namespace {

using testing::ElementsAre;

std::vector<std::string> labels(const Axis& axis) {
  std::vector<std::string> out;
  for (const Tick& tick : axis.ticks) out.push_back(tick.label.markup);
  return out;
}

TEST(Axis, TicksAreRound) {
  EXPECT_THAT(labels(linear(0, 390)), ElementsAre("0", "100", "200", "300"));
  EXPECT_THAT(labels(linear(-0.04, 1.05)), ElementsAre("0.0", "0.5", "1.0"));
  EXPECT_THAT(labels(linear(-1100, 1050)), ElementsAre("−1000", "0", "1000")) << "a minus sign, not a hyphen";
  EXPECT_THAT(labels(linear(0.3, 0.4, {2})), ElementsAre("0.30", "0.35", "0.40")) << "the ends are ticks in spite of rounding";
}

TEST(Axis, PlacesByRootsAndLogarithms) {
  Axis axis{.lower = 0, .upper = 16};
  EXPECT_DOUBLE_EQ(axis.place(4), 0.25);
  axis.root = true;
  EXPECT_DOUBLE_EQ(axis.place(4), 0.5);
  axis.lower = 1;
  EXPECT_DOUBLE_EQ(axis.place(4), 1. / 3);
  axis.logarithmic = true;
  EXPECT_DOUBLE_EQ(axis.place(4), 0.5);
}

TEST(Axis, LongLabelsAreInPowersOfAThousand) {
  const Axis large = linear(0, 250000, {4, 0, true}), small = linear(0, 0.0066, {4, 0, true});
  EXPECT_EQ(large.exponent, 3);
  EXPECT_THAT(labels(large), ElementsAre("0", "100", "200"));
  EXPECT_EQ(small.exponent, -3);
  EXPECT_THAT(labels(small), ElementsAre("0", "2", "4", "6"));
  EXPECT_EQ(linear(0, 1.2, {4, 0, true}).exponent, 0);
  EXPECT_EQ(linear(0, 250000).exponent, 0) << "only where the title says so";
  EXPECT_EQ(in_units(large, "mm/s").markup.find("10<tspan") != std::string::npos, true);
  EXPECT_NE(in_units(small, "1/(mm/s)").markup.find(">/(mm/s)]<"), std::string::npos) << "10⁻³/(mm/s), not 10⁻³ 1/(mm/s)";
  EXPECT_EQ(in_units(linear(0, 1), "mm").markup, " [mm]");
  EXPECT_EQ(in_units(linear(0, 1), "").markup, "");
}

TEST(Axis, NearOneHasThreeDecimals) {
  EXPECT_THAT(labels(linear(0.982, 0.992, {3, 0, true})), ElementsAre("0.982", "0.984", "0.986", "0.988", "0.990", "0.992"));
  EXPECT_THAT(labels(linear(0.0982, 0.0992, {3, 0, true})), ElementsAre("98.2", "98.4", "98.6", "98.8", "99.0", "99.2")) << "times 10⁻³";
}

TEST(Axis, AConstantStandsInTheMiddle) {
  for (const double value : {1.0, -4.0, 0.02}) {
    const Axis axis = linear(value, value);
    EXPECT_DOUBLE_EQ(axis.place(value), 0.5) << value;
  }
  EXPECT_DOUBLE_EQ(linear(0, 0).place(0), 0) << "counts of nothing";
}

TEST(Axis, LabelsStandApart) {
  for (const double room : {30.0, 50.0, 72.0, 200.0}) {
    const Axis axis = linear(-6500, 11000, {5, room, true});
    for (std::size_t k = 1; k < axis.ticks.size(); ++k) {
      const double between = room * (axis.place(axis.ticks[k].value) - axis.place(axis.ticks[k - 1].value));
      EXPECT_GT(between, 0.5 * (axis.ticks[k].label.width + axis.ticks[k - 1].label.width)) << room;
    }
  }
}

TEST(Axis, EndsThatAreNoneAreMovedApart) {
  for (const auto& [a, b] : {std::pair(NAN, 1.0), {0.0, NAN}, {2.0, 2.0}, {INFINITY, -INFINITY}, {3.0, 1.0}}) {
    const Axis axis = linear(a, b), log = logarithmic(a, b);
    EXPECT_LT(axis.lower, axis.upper);
    EXPECT_TRUE(std::isfinite(axis.upper));
    EXPECT_LT(log.lower, log.upper);
    EXPECT_GT(log.lower, 0);
  }
}

TEST(Axis, LogarithmicEndsAtRoundNumbers) {
  const Axis axis = logarithmic(0.6, 16);
  EXPECT_DOUBLE_EQ(axis.lower, 0.5);
  EXPECT_DOUBLE_EQ(axis.upper, 20);
  EXPECT_DOUBLE_EQ(axis.place(0.5), 0);
  EXPECT_DOUBLE_EQ(axis.place(std::sqrt(0.5 * 20)), 0.5);
  EXPECT_FALSE(std::isfinite(axis.place(0)) && axis.place(0) > 0);
  EXPECT_THAT(labels(axis), ElementsAre("0.5", "", "", "", "", "1", "2", "", "", "5", "", "", "", "", "10", "20"));
  const std::vector<std::string> powers = labels(logarithmic(1e-5, 2));
  EXPECT_EQ(powers.front(), "10<tspan dy=\"-2.6\" font-size=\"5\">−5</tspan>");
}

}  // namespace
}  // namespace swarmfit::plot
