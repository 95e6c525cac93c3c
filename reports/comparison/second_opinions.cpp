// SPDX-License-Identifier: MIT
#include "reports/comparison/second_opinions.h"

#include <fmt/format.h>

#include <cmath>

#include "reports/write/number.h"
#include "reports/write/unit_text.h"

namespace swarmfit {

namespace {

// "tau_v 0.61 (0.55 .. 0.68) s, ..."
std::string opinions(const ModelFit& r, SecondOpinion ParameterResult::*which) {
  std::string out;
  for (const ParameterResult& p : r.parameters)
    if (const SecondOpinion& o = p.*which; std::isfinite(o.value))
      out += fmt::format("{}{} {}{}{}", out.empty() ? "" : ", ", p.name, opinion_text(o), p.unit.empty() ? "" : " ", unit_in_print(p.unit));
  return out;
}

}  // namespace

std::string opinion_text(const SecondOpinion& o) {
  if (!std::isfinite(o.value)) return kUndefined;
  return std::isfinite(o.lower) ? fmt::format("{} ({} .. {})", rounded(o.value), rounded(o.lower), rounded(o.upper))
                                : fmt::format("{} (no interval)", rounded(o.value));
}

std::string most_likely_values(const ModelFit& r) {
  if (!std::isfinite(r.likelihood.log_likelihood)) return {};
  return opinions(r, &ParameterResult::likelihood) +
         fmt::format("; log-likelihood {:.1f}, measurement error {}", r.likelihood.log_likelihood, rounded(r.likelihood.error, 2));
}

std::string regressed_values(const ModelFit& r) {
  if (r.regression.rows == 0) return {};
  const std::string memory = r.regression.memory > 0 ? fmt::format(", noise with a memory of {} s", rounded(r.regression.memory, 2)) : "";
  return opinions(r, &ParameterResult::regression) + fmt::format("; {} accelerations{}", r.regression.rows, memory);
}

}  // namespace swarmfit
