// SPDX-License-Identifier: MIT
#include "libtrack/read/timestamp.h"

#include <gmock/gmock.h>

namespace swarmfit {
namespace {

using testing::Optional;

TEST(Timestamp, ClockTimes) {
  EXPECT_THAT(parse_clock("7:00"), Optional(25200.0));
  EXPECT_THAT(parse_clock("07:00:01"), Optional(25201.0));
  EXPECT_THAT(parse_clock("23:59:59.25"), Optional(86399.25));
  EXPECT_THAT(parse_clock("24:00:00"), Optional(86400.0));
  for (const auto* wrong : {"", "7", "25:00:34", "24:00:01", "7:60:00", "7:00:61", "7:0:00", "7:00:00x", "7:00:00.", ":00:00", "-1:00:00"})
    EXPECT_EQ(parse_clock(wrong), std::nullopt) << wrong;
}

TEST(Timestamp, Dates) {
  EXPECT_THAT(parse_date("1970-01-01"), Optional(0.0));
  EXPECT_THAT(parse_date("2015-09-10"), Optional(1441843200.0));  // date -u -d 2015-09-10 +%s
  EXPECT_THAT(parse_date("2000/2/29"), Optional(951782400.0));
  for (const auto* wrong : {"", "2015-02-29", "2015-13-01", "2015-09/10", "15-09-10", "2015-09-10 "})
    EXPECT_EQ(parse_date(wrong), std::nullopt) << wrong;
}

TEST(Timestamp, DateAndTime) {
  EXPECT_THAT(parse_timestamp("2015-09-10T07:00:01"), Optional(1441868401.0));
  EXPECT_THAT(parse_timestamp("2015-09-10 07:00:01.5Z"), Optional(1441868401.5));
  EXPECT_THAT(parse_timestamp("2015-09-10T09:00:01+02:00"), Optional(1441868401.0));
  EXPECT_THAT(parse_timestamp("2015-09-10T06:30:01-0030"), Optional(1441868401.0));
  EXPECT_THAT(parse_timestamp("7:00"), Optional(25200.0));
  for (const auto* wrong : {"2015-09-10", "2015-09-10T", "2015-09-10x07:00:01", "2015-09-10T25:00:00", "2015-09-10T07:00:01 "})
    EXPECT_EQ(parse_timestamp(wrong), std::nullopt) << wrong;
}

}  // namespace
}  // namespace swarmfit
