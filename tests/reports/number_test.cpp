// SPDX-License-Identifier: MIT
#include "reports/write/number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace swarmfit {
namespace {

TEST(Number, ExactReadsBackUnchanged) {
  for (const double value : {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, 123456789.123456789, -1e23, 0.0})
    EXPECT_EQ(std::strtod(exact(value).c_str(), nullptr), value);
  EXPECT_EQ(exact(0.1), "0.1");
  EXPECT_EQ(exact(NAN), "");
  EXPECT_EQ(exact(-INFINITY), "");
}

TEST(Number, RoundedKeepsSignificantDigits) {
  EXPECT_EQ(rounded(12345.6), "12300");
  EXPECT_EQ(rounded(9.996), "10.0");
  EXPECT_EQ(rounded(0.012345), "0.0123");
  EXPECT_EQ(rounded(-2.5), "-2.50");
  EXPECT_EQ(rounded(1.234e-7), "1.23e-07");
  EXPECT_EQ(rounded(2.1e8), "2.1e+08");
  EXPECT_EQ(rounded(0), "0");
  EXPECT_EQ(rounded(NAN), "–");
}

TEST(Number, ErrorsDoNotVanish) {
  EXPECT_EQ(with_error(0.923, 0.031, 2), "0.92 ± 0.03");
  EXPECT_EQ(with_error(0.998, 0.0042, 2), "1.00 ± 0.004");
  EXPECT_EQ(with_error(1, 0, 2), "1.00 ± 0.00");
  EXPECT_EQ(with_error(1, NAN, 2), "1.00");
}

TEST(Number, InPrintHasMinusSignsAndPowers) {
  EXPECT_EQ(in_print("-0.04 .. 0.15"), "−0.04 to 0.15");
  EXPECT_EQ(in_print("0.1 ± 0.2 (-0.83)"), "0.1 ± 0.2 (−0.83)");
  EXPECT_EQ(in_print("1.2e-07"), "1.2×10⁻⁷");
  EXPECT_EQ(in_print("2.1e+08 a"), "2.1×10⁸ a");
  EXPECT_EQ(in_print("one-sided e-mail 2e"), "one-sided e-mail 2e");
  EXPECT_EQ(in_print("–"), "–");
}

TEST(Number, UnitsInPrintHavePowers) {
  EXPECT_EQ(unit_in_print("mm/s^2"), "mm/s²");
  EXPECT_EQ(unit_in_print("mm/s^1.5"), "mm/s¹·⁵");
  EXPECT_EQ(unit_in_print("s^-1 m^10"), "s⁻¹ m¹⁰");
  EXPECT_EQ(unit_in_print("x^y ^"), "x^y ^");
}

TEST(Number, BriefDropsTrailingZeros) {
  EXPECT_EQ(brief(0.01), "0.01");
  EXPECT_EQ(brief(100), "100");
  EXPECT_EQ(brief(48.62, 3), "48.6");
  EXPECT_EQ(brief(20.0), "20");
  EXPECT_EQ(brief(1.5e-9), "1.5e-09");
  EXPECT_EQ(brief(0), "0");
  EXPECT_EQ(brief(NAN), "–");
}

TEST(Number, FixedHasNoNegativeZero) {
  EXPECT_EQ(fixed(-0.0004, 3), "0.000");
  EXPECT_EQ(fixed(-0.0006, 3), "-0.001");
  EXPECT_EQ(fixed(INFINITY, 2), "–");
}

TEST(Number, PercentAndCounts) {
  EXPECT_EQ(percent(0.673), "67 %");
  EXPECT_EQ(percent(0.0021), "0.2 %");
  EXPECT_EQ(percent(0), "0 %");
  EXPECT_EQ(counted(1234), "1234");
  EXPECT_EQ(counted(1234567), "1\u202f234\u202f567");
  EXPECT_EQ(counted(-12345), "-12\u202f345");
  EXPECT_EQ(counted(1, "track"), "1 track");
  EXPECT_EQ(counted(0, "gap"), "0 gaps");
}

}  // namespace
}  // namespace swarmfit
