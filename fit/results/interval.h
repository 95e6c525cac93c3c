// SPDX-License-Identifier: MIT
// What a recording says of one parameter.
#pragma once

#include <cstddef>
#include <string>
#include <tuple>

namespace swarmfit {

enum class Identifiability {
  identified,
  one_sided,  // the interval reaches a bound of the prior: only the other end says something
  flat        // hardly narrower than the prior's
};

inline std::string to_string(Identifiability verdict) {
  switch (verdict) {
    case Identifiability::identified:
      return "identified";
    case Identifiability::one_sided:
      return "one-sided";
    case Identifiability::flat:
      return "flat";
  }
  return "";
}

// One searched parameter, in physical units; where the search's axis is logarithmic or a square root, so is that of the prior.
struct ParameterInterval {
  std::size_t row = 0;  // of the model's parameter table
  std::string name;
  double median = 0, lower = 0, upper = 0;  // posterior, ends of the central 95 %
  double contraction = 0;                   // 1 - variance / variance of the prior, on the search's axis
  Identifiability verdict = Identifiability::flat;
  std::string partner;  // the parameter with the strongest correlation, and that, on the search's axes; "": there is no other
  double correlation = 0;
};
inline auto fields(ParameterInterval& p) {  // as bytes (fit/store/bytes.h)
  return std::tie(p.row, p.name, p.median, p.lower, p.upper, p.contraction, p.verdict, p.partner, p.correlation);
}

}  // namespace swarmfit
