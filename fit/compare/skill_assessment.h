// SPDX-License-Identifier: MIT
// What the score cannot say: how good a model is whoever else is compared, whether the recording shows interaction or memory at all, how
// much the ranking depends on who was ranked, and whether what was not fitted comes out right.
#pragma once

#include "fit/experiment/ensemble.h"
#include "fit/results/comparison.h"
#include "libeval/skill.h"

namespace swarmfit {

// One run beside the recording.
struct AssessedRun {
  PerColumn<double> distance, wasserstein;  // from the recording: of halves against halves; [sd of the recording]
  Panel panel;                              // empty if it blew up
};
inline auto fields(Panel& p) { return std::tie(p.values, p.vacf); }  // as bytes (fit/store/bytes.h)
inline auto fields(AssessedRun& r) { return std::tie(r.distance, r.wasserstein, r.panel); }

// Measures the recording and its surrogates once. Holds references, so the conditions must outlive it.
//
// The scale of skill: 1 is the distance between halves of the recording, 0 that of its surrogates (libeval/surrogate.h). Those are a random
// walk of its own steps, and for d and eta its tracks shifted in time, where these lie farther than the halves do: by more than two
// standard deviations over the choices of halves, in the mean over the columns. Where they do not, in the columns of the score or in all
// that are defined, the scale is that of a coarser null: its places in random order.
class SkillAssessment {
 public:
  // used: columns on which the skill rests. seed: of the surrogates, the same for all models.
  SkillAssessment(const Conditions& conditions, const PerColumn<bool>& used, std::uint64_t seed, const Runtime& runtime = {});

  // One run: disjoint from the recording, and without a panel, if it blew up. From any thread.
  AssessedRun of(const Run& run) const;

  // How a model looks, from its runs; the scales of the group are not known here.
  Likeness likeness(std::span<const AssessedRun> runs) const;

  const SkillFacts& skill() const { return facts_; }
  PanelFacts panel() const;

 private:
  struct Nulls;
  Nulls measured_nulls(const Rng& rng, const Runtime& runtime);
  bool fits(const PerColumn<bool>& used, SkillNull null);
  void choose_scale(const PerColumn<bool>& wanted);

  const Conditions& conditions_;
  HalfDistance distance_;
  PanelPlan plan_;
  PanelEstimate panel_;  // of the recording
  SkillFacts facts_;
  SkillScale scale_;
};

// Has no model with a skill more of it than the random walk?
bool walk_suffices(const SkillFacts& facts, const std::vector<ModelFit>& models);

}  // namespace swarmfit
