// SPDX-License-Identifier: MIT
// What the score cannot say: how good a model is whoever else is compared, whether the recording shows interaction at all, how much the
// ranking depends on who was ranked, and whether what was not fitted comes out right.
#pragma once

#include "fit/objective.h"
#include "fit/results.h"
#include "libeval/skill.h"

namespace swarmfit {

// Measures the recording and its surrogates once. Holds references, so the conditions must outlive it.
class Judge {
 public:
  // used: columns on which the skill rests. seed: of the surrogates, the same for all models.
  Judge(const Conditions& conditions, const PerColumn<bool>& used, std::uint64_t seed);

  // Fills skill, total_variation, wasserstein, panel and vacf from runs of these parameters on these seeds. A run that blew up counts as
  // disjoint, and has no panel.
  void judge(FitResult& fit, const Objective& objective, const std::vector<double>& parameters, std::span<const Rng> seeds) const;

  // Fills skill, without and panel of a comparison whose models are ranked.
  void tell(Comparison& result) const;

 private:
  void measure_nulls(const Rng& rng);

  const Conditions& conditions_;
  PerColumn<bool> used_;
  HalfDistance distance_;
  PanelPlan plan_;
  SkillFacts facts_;
  SkillScale scale_;
};

// One sentence each, from a finished result.
std::vector<std::string> warnings_of_skill(const Comparison& result);

}  // namespace swarmfit
