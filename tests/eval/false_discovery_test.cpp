// SPDX-License-Identifier: MIT
#include "libeval/false_discovery.h"

#include <gmock/gmock.h>

#include <cmath>

namespace swarmfit {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::NanSensitiveDoubleEq;

// Numbers of scipy.stats.false_discovery_control 1.11.
TEST(FalseDiscovery, AgreesWithScipy) {
  EXPECT_THAT(adjusted_p({0.01, 0.04, 0.03, 0.5}),
              ElementsAre(DoubleNear(0.04, 1e-15), DoubleNear(0.16 / 3, 1e-15), DoubleNear(0.16 / 3, 1e-15), DoubleNear(0.5, 1e-15)));
}

TEST(FalseDiscovery, OneTestIsNotAdjustedAndUndefinedOnesDoNotCount) {
  EXPECT_THAT(adjusted_p({0.03}), ElementsAre(0.03));
  EXPECT_THAT(adjusted_p({0.03, NAN}), ElementsAre(NanSensitiveDoubleEq(0.03), NanSensitiveDoubleEq(NAN)));
  EXPECT_THAT(adjusted_p({}), IsEmpty());
}

TEST(FalseDiscovery, EqualOnesStayEqual) { EXPECT_THAT(adjusted_p({0.01, 0.01, 0.01}), ElementsAre(0.01, 0.01, 0.01)); }

}  // namespace
}  // namespace swarmfit
