// SPDX-License-Identifier: MIT
#include "libtrack/distributions.h"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace swarmfit {

namespace math = boost::math;

double student_t_above(double tail, double degrees) { return quantile(complement(math::students_t(degrees), tail)); }

double fisher_f_tail(double x, double m, double n) { return cdf(complement(math::fisher_f(m, n), x)); }

std::pair<int, int> binomial_band(int n, double chance, double tail) {
  using Upwards = math::policies::policy<math::policies::discrete_quantile<math::policies::integer_round_up>>;
  const math::binomial_distribution<double, Upwards> count(n, chance);
  return {static_cast<int>(quantile(count, tail)), static_cast<int>(quantile(count, 1 - tail))};
}

}  // namespace swarmfit
