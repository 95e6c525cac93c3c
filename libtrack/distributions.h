// SPDX-License-Identifier: MIT
// Quantiles and tails of distributions by Boost.Math, whose templates take seconds to compile: here they are compiled once.
#pragma once

#include <utility>

namespace swarmfit {

inline constexpr double kNormal95 = 1.959963984540054;  // standard deviations on either side hold 95 % of a normal distribution

// The value that Student's t with so many degrees of freedom (> 0) exceeds with probability `tail` (0 to 1, without the ends).
double student_t_above(double tail, double degrees);

// Probability that F with (m, n) degrees of freedom (> 0) exceeds x >= 0.
double fisher_f_tail(double x, double m, double n);

// The counts of n trials, each with this chance of success, below and above which lies at most `tail` of the distribution; rounded up.
std::pair<int, int> binomial_band(int n, double chance, double tail);

}  // namespace swarmfit
