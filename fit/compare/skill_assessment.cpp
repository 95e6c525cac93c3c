// SPDX-License-Identifier: MIT
#include "fit/compare/skill_assessment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/compare/refute.h"
#include "fit/compare/warn.h"
#include "fit/experiment/outcome.h"
#include "fit/store/checkpointed.h"
#include "libeval/distance.h"
#include "libeval/surrogate.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

constexpr std::size_t kSurrogates = 99;  // of each kind that is tested: so that p can reach 0.01
constexpr std::size_t kPlaced = 10;

Estimate estimate(const std::vector<double>& values) {
  Moments m;
  for (const double v : values) m.add(v);
  return {m.count > 0 ? m.mean : kNaN, m.standard_error()};
}

std::vector<Estimate> estimates(const std::vector<double>& value, const std::vector<double>& se) {
  std::vector<Estimate> out;
  for (std::size_t k = 0; k < value.size(); ++k) out.push_back({value[k], se[k]});
  return out;
}

double column_mean(const std::vector<PerColumn<double>>& values, std::size_t j) {
  Moments m;
  for (const auto& v : values) m.add(v[j]);
  return m.count > 0 ? m.mean : kNaN;
}

// Mean and standard error of each number over replicates.
std::vector<Estimate> over_replicates(const std::vector<Panel>& panels, std::vector<double> Panel::*part) {
  std::vector<Estimate> out;
  for (std::size_t k = 0; !panels.empty() && k < (panels.front().*part).size(); ++k) {
    std::vector<double> column;
    for (const Panel& p : panels) column.push_back((p.*part)[k]);
    out.push_back(estimate(column));
  }
  return out;
}

struct Surrogate {
  PerColumn<double> distance;  // from the recording; NaN where it says nothing
  PerColumn<Histogram> pooled;
};
auto fields(Surrogate& s) { return std::tie(s.distance, s.pooled); }

}  // namespace

// Surrogates beside the recording.
struct SkillAssessment::Nulls {
  std::vector<PerColumn<double>> shifted, walked, placed;  // distances; NaN where they say nothing
  std::vector<PerColumn<Histogram>> of_shifted, of_walked;
};

SkillAssessment::SkillAssessment(const Conditions& conditions, const PerColumn<bool>& used, std::uint64_t seed, const Runtime& runtime)
    : conditions_(conditions),
      distance_(conditions.recording, conditions.metrics),
      plan_(panel_plan(conditions.recording)),
      panel_(panel_with_error(conditions.recording, plan_)) {
  facts_.floor = distance_.floor();
  facts_.floor_sd = distance_.floor_sd();
  const Nulls nulls = measured_nulls({seed}, runtime);
  const auto& columns = distance_.columns();
  facts_.null = facts_.places = PerColumn<double>(columns.size());
  facts_.informative = PerColumn<bool>(columns.size());
  for (std::size_t j = 0; j < columns.size(); ++j) {
    facts_.null[j] = column_mean(columns[j].motion() ? nulls.walked : nulls.shifted, j);
    facts_.places[j] = column_mean(nulls.placed, j);
    facts_.informative[j] = facts_.null[j] > facts_.floor[j] + kStandardErrors * facts_.floor_sd[j];
  }
  choose_scale(used);

  const auto observed = HalfDistance::pooled(distance_.recording());
  facts_.surrogates = static_cast<int>(kSurrogates);
  PerColumn<bool> motion = facts_.used;
  for (std::size_t j = 0; j < columns.size(); ++j) {
    motion[j] = motion[j] && columns[j].motion();
    if (columns[j].motion()) continue;
    PerColumn<bool> only(columns.size());
    only[j] = true;
    facts_.interaction_p[j - kDistance] = surrogate_p(observed, nulls.of_shifted, only);
  }
  facts_.memory_p = surrogate_p(observed, nulls.of_walked, motion);
  // A walk has no d and eta of its own: it takes those of the tracks shifted in time.
  std::vector<double> walkers;
  for (PerColumn<double> walk : nulls.walked) {
    for (std::size_t j = 0; j < columns.size(); ++j)
      if (!columns[j].motion()) walk[j] = facts_.null[j];
    walkers.push_back(mean_used(walk, facts_.used));
  }
  const Estimate walker = estimate(walkers);
  if (std::find(motion.begin(), motion.end(), true) != motion.end())
    facts_.walker = {scale_.skill(walker.value), scale_.slope() * walker.se};
}

SkillAssessment::Nulls SkillAssessment::measured_nulls(const Rng& rng, const Runtime& runtime) {
  const Tracks& recording = conditions_.recording;
  const auto& columns = distance_.columns();
  PerColumn<bool> motion(columns.size()), rest(columns.size());
  for (std::size_t j = 0; j < columns.size(); ++j) motion[j] = columns[j].motion(), rest[j] = !motion[j];
  const auto kind_of = [](std::size_t k) { return k / kSurrogates; };
  const auto surrogate = [&](std::size_t k) {
    const Rng own = rng.derive(Stream::surrogate, k);
    const std::size_t kind = kind_of(k);
    const auto blocks = distance_.blocks(kind == 0   ? timeshift(recording, own)
                                         : kind == 1 ? shuffled_walker(recording, own)
                                                     : shuffled_places(recording, own));
    if (kind == 2) return Surrogate{distance_.to(blocks), {}};
    return Surrogate{distance_.to(blocks, kind == 0 ? rest : motion), HalfDistance::pooled(blocks)};
  };
  const std::string name = fmt::format("surrogates {} {}", rng.seed, fingerprint(conditions_));
  auto surrogates = *checkpointed<std::vector<Surrogate>>(
      runtime.checkpoint, name, [&] { return std::optional(runtime.executor->each<Surrogate>(2 * kSurrogates + kPlaced, surrogate)); });
  Nulls out;
  for (std::size_t k = 0; k < surrogates.size(); ++k) {
    const std::size_t kind = kind_of(k);
    (kind == 0 ? out.shifted : kind == 1 ? out.walked : out.placed).push_back(std::move(surrogates[k].distance));
    if (kind < 2) (kind == 0 ? out.of_shifted : out.of_walked).push_back(std::move(surrogates[k].pooled));
  }
  return out;
}

// Takes this scale if the null is farther than halves of the recording are.
bool SkillAssessment::fits(const PerColumn<bool>& used, SkillNull null) {
  const Moments floor = distance_.floor_over(used);
  const SkillScale scale = skill_scale(facts_.floor, null == SkillNull::steps ? facts_.null : facts_.places, used);
  if (!(scale.null > scale.floor + kStandardErrors * floor.sd())) return false;
  scale_ = scale;
  facts_.null_of = null;
  facts_.used = used;
  facts_.mean_floor_sd = floor.sd();
  return true;
}

void SkillAssessment::choose_scale(const PerColumn<bool>& wanted) {
  const auto measured = [&](std::size_t j) { return std::isfinite(facts_.floor[j]) && std::isfinite(facts_.null[j]); };
  PerColumn<bool> scored = wanted, all(wanted.size());
  // An eighth of the recording can be too short for a lag that the whole carries.
  for (std::size_t j = 0; j < wanted.size(); ++j) {
    scored[j] = wanted[j] && (distance_.columns()[j].lag == 1 || measured(j));
    all[j] = measured(j);
  }
  if (!fits(scored, SkillNull::steps) && !fits(all, SkillNull::steps) && !fits(scored, SkillNull::places) && !fits(all, SkillNull::places))
    facts_.used = scored;
  facts_.mean_floor = scale_.floor;
  facts_.mean_null = scale_.null;
}

AssessedRun SkillAssessment::of(const Run& run) const {
  const auto real = HalfDistance::pooled(distance_.recording());
  const auto blocks = run.blew_up ? distance_.no_blocks() : distance_.blocks(run.seen);
  const auto pooled = HalfDistance::pooled(blocks);
  AssessedRun out{distance_.to(blocks), PerColumn<double>(real.size()), {}};
  for (std::size_t j = 0; j < real.size(); ++j) {
    if (std::isnan(out.distance[j]) && !std::isnan(distance_.floor()[j])) out.distance[j] = 1;
    out.wasserstein[j] = wasserstein(real[j], pooled[j], distance_.bin_width());
  }
  if (!run.blew_up) out.panel = swarmfit::panel(run.seen, plan_);
  return out;
}

Likeness SkillAssessment::likeness(std::span<const AssessedRun> runs) const {
  Likeness out;
  const std::size_t columns = distance_.columns().size();
  std::vector<double> means;
  std::vector<Panel> panels;
  for (const AssessedRun& run : runs) {
    means.push_back(mean_used(run.distance, facts_.used));
    if (!run.panel.values.empty()) panels.push_back(run.panel);
  }
  const Estimate d = estimate(means);
  out.skill = {scale_.skill(d.value), scale_.slope() * d.se};
  out.total_variation = out.wasserstein = PerColumn<double>(columns);
  for (std::size_t j = 0; j < columns; ++j) {
    std::vector<double> distances, shifts;
    for (const AssessedRun& run : runs) distances.push_back(run.distance[j]), shifts.push_back(run.wasserstein[j]);
    out.total_variation[j] = estimate(distances).value;
    out.wasserstein[j] = estimate(shifts).value;
  }
  out.panel = over_replicates(panels, &Panel::values);
  out.vacf = over_replicates(panels, &Panel::vacf);
  out.panel.resize(plan_.items().size());
  out.vacf.resize(plan_.vacf_lags.size());
  out.refuted_by = refutations(plan_, panel_, panels);
  return out;
}

PanelFacts SkillAssessment::panel() const {
  const auto& [value, se] = panel_;
  PanelFacts out{plan_.items(), estimates(value.values, se.values), {}, estimates(value.vacf, se.vacf)};
  for (const Index lag : plan_.vacf_lags) out.lags.push_back(static_cast<double>(lag) * plan_.dt);
  return out;
}

bool walk_suffices(const SkillFacts& facts, const std::vector<ModelFit>& models) {
  const Estimate& walker = facts.walker;
  if (!std::isfinite(walker.value)) return false;
  bool any = false;
  for (const ModelFit& m : models) {
    const Estimate& skill = m.likeness.skill;
    if (!std::isfinite(skill.value)) continue;
    any = true;
    const double se = std::isfinite(skill.se) ? skill.se : 0;
    if (skill.value - walker.value > kStandardErrors * std::hypot(se, walker.se)) return false;
  }
  return any;
}

}  // namespace swarmfit
