// SPDX-License-Identifier: MIT
#include "reports/study/measure_figures.h"

#include <gmock/gmock.h>

namespace swarmfit {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

MeasuredGroup with_curve(const std::vector<double>& y, const std::vector<double>& se) {
  MeasuredGroup group;
  group.curves.curves = {{.key = "drag", .name = "drag", .x_name = "speed", .x = {10, 20, 30}, .y = y, .se = se}};
  return group;
}

// 1.3 ± 0.4: the axis goes from 0.9 to 1.7.
TEST(GroupCurves, AConstantIsDrawnWithItsBand) {
  EXPECT_THAT(group_curves_svg({}, with_curve({1.3, 1.3, 1.3}, {0.2, 0.2, 0.2})),
              AllOf(HasSubstr(">1.2<"), HasSubstr(">1.6<"), Not(HasSubstr(">2.0<"))));
}

// A band that is wide at one end leaves room for the curve.
TEST(GroupCurves, ABandTakesNoMoreThanTheCurveToEitherSide) {
  EXPECT_THAT(group_curves_svg({}, with_curve({0, 1, 2}, {0.1, 0.1, 500})), AllOf(HasSubstr(">4<"), Not(HasSubstr(">1000<"))));
}

}  // namespace
}  // namespace swarmfit
