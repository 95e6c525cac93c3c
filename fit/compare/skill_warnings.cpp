// SPDX-License-Identifier: MIT
#include "fit/compare/skill_warnings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "fit/compare/warn.h"

namespace swarmfit {
namespace {

constexpr double kRepeats = 0.5;  // of the distance of new motion from that which is known

// Models by skill, those without one last.
std::vector<const ModelFit*> by_skill(const Comparison& r) {
  std::vector<const ModelFit*> order;
  for (const auto& m : r.models) order.push_back(&m);
  const auto value = [](const ModelFit* m) { return std::isfinite(m->likeness.skill.value) ? m->likeness.skill.value : -INFINITY; };
  std::stable_sort(order.begin(), order.end(), [&](const ModelFit* a, const ModelFit* b) { return value(a) > value(b); });
  return order;
}

bool no_interaction(const SkillFacts& s) { return s.interaction_p[0] > kAlpha && s.interaction_p[1] > kAlpha; }

// The random walk as an answer: what the recording shows at all.
void warn_of_walk(const Comparison& r, std::vector<Warning>& out) {
  const SkillFacts& s = r.recording.skill;
  if (s.memory_p > kAlpha)
    warn(out, Gravity::claim,
         "No detectable memory of direction: the recording cannot be distinguished from random walks of its own steps (p = {:.2f}, {} "
         "walks), "
         "so the ranking says little about how the animals steer.",
         s.memory_p, s.surrogates);
  else if (r.ranking.walk_suffices)
    warn(out, Gravity::claim,
         "No model is closer to the recording than a random walk of its own steps (the walk's skill is {:.2f}; the best model, {}, has "
         "{:.2f} ± {:.2f}).",
         s.walker.value, by_skill(r).front()->model, by_skill(r).front()->likeness.skill.value, by_skill(r).front()->likeness.skill.se);
  if (s.null_of == SkillNull::places)
    warn(out, Gravity::note,
         "A random walk of the recording's own steps is as close to it as its two halves are to each other, so skill uses a coarser zero: "
         "its own positions in random order.");
}

// Rejected, and yet as close as can be?
void warn_of_rejected(const Comparison& r, std::vector<Warning>& out) {
  const ModelFit& first = r.models.front();
  const SkillFacts& s = r.recording.skill;
  const double floor_error = s.mean_floor_sd / (s.mean_null - s.mean_floor);
  if (!(first.standing.certainty.gof_p <= kAlpha) ||
      !(first.likeness.skill.value >= 1 - std::hypot(kStandardErrors * first.likeness.skill.se, floor_error)))
    return;
  warn(out, Gravity::claim,
       "{} is rejected although its skill is {:.2f}: each metric alone is about as close as two halves of the recording are to each other, "
       "but all metrics together differ (fit p {} {:.2f}). Trust fit p.",
       first.model, first.likeness.skill.value, first.standing.certainty.gof_p * (1 + r.ranking.bootstrap_recordings) < 1.5 ? "≤" : "=",
       first.standing.certainty.gof_p);
}

// A posterior takes its model for granted.
void warn_of_identified(const Comparison& r, std::vector<Warning>& out) {
  if (!no_interaction(r.recording.skill)) return;
  for (const ModelFit& m : r.models) {
    std::vector<std::string_view> names;
    for (const ParameterResult& p : m.parameters)
      if (p.interaction && p.posterior.verdict == "identified") names.push_back(p.name);
    if (!names.empty())
      warn(out, Gravity::meaning,
           "{}: {} {} identified although no interaction is detectable. A posterior assumes that its model is true: the {} which strength "
           "imitates the recording best, not that animals interact.",
           m.model, fmt::join(names, ", "), names.size() > 1 ? "are" : "is", names.size() > 1 ? "intervals say" : "interval says");
  }
}

// Which models come before others by skill that are before them by score, beyond the scatter of the simulations: "b before a and c".
std::vector<std::string> overtaking(const Comparison& r) {
  std::vector<std::string> out;
  for (std::size_t b = 1; b < r.models.size(); ++b) {
    std::vector<std::string> overtaken;
    for (std::size_t a = 0; a < b; ++a) {
      const Estimate &above = r.models[a].likeness.skill, &below = r.models[b].likeness.skill;
      if (below.value - above.value > kStandardErrors * std::hypot(above.se, below.se)) overtaken.push_back(r.models[a].model);
    }
    if (!overtaken.empty()) out.push_back(fmt::format("{} before {}", r.models[b].model, fmt::join(overtaken, " and ")));
  }
  return out;
}

void warn_of_order(const Comparison& r, std::vector<Warning>& out) {
  const auto found = overtaking(r);
  if (found.empty()) return;
  std::vector<std::string> order;
  for (const ModelFit* m : by_skill(r))
    order.push_back(fmt::format("{} ({:.2f})", m->model, std::round(100 * m->likeness.skill.value) / 100 + 0.0));  // no "-0.00"
  warn(out, Gravity::result,
       "Score and skill disagree. By skill the order is {}. Beyond chance, skill puts {}. The score depends on which models are compared, "
       "skill does not.",
       fmt::join(order, ", "), fmt::join(found, ", "));
}

// Does the skill rest on other columns than the score?
void warn_of_basis(const Comparison& r, std::vector<Warning>& out) {
  bool more = false;
  std::vector<std::string> missing;
  for (std::size_t j = 0; j < r.recording.skill.used.size(); ++j) {
    const bool expected = r.recording.observation.used[j] && !r.recording.observation.error_dominated[j];
    more = more || (r.recording.skill.used[j] && !expected);
    if (!r.recording.skill.used[j] && expected) missing.push_back(r.recording.columns[j].key());
  }
  if (more)
    warn(out, Gravity::note,
         "No metric with full weight distinguishes the recording from its surrogates, so skill is computed from all defined metrics.");
  else if (!missing.empty())
    warn(out, Gravity::note, "Skill leaves out {}: an eighth of the recording is too short for this lag.", fmt::join(missing, ", "));
}

}  // namespace

std::vector<Warning> warnings_of_learning(const Comparison& r) {
  std::vector<Warning> out;
  for (const ModelFit& m : r.models) {
    if (!m.learns) continue;
    const Nearness& n = m.standing.held_out.nearness;
    if (!r.recording.hold_out.used())
      warn(out, Gravity::claim,
           "{} learns from the recording that it is judged on, so its score and rank are not evidence; --holdout yes scores it on data "
           "that it did not learn from.",
           m.model);
    else if (std::isfinite(n.simulated) && n.recorded > 0)
      warn(out, Gravity::meaning,
           "{} learns from the half that is fitted. On the other half, its paths of {} frames lie {:.2f} times as far from the nearest "
           "path that it has seen as the recorded paths do{}.",
           m.model, n.frames, n.simulated / n.recorded, n.simulated < kRepeats * n.recorded ? ": it repeats what it has seen" : "");
  }
  return out;
}

std::vector<Warning> warnings_of_skill(const Comparison& r) {
  std::vector<Warning> out;
  warn_of_walk(r, out);
  if (no_interaction(r.recording.skill))
    warn(out, Gravity::claim,
         "No detectable interaction: neighbour distances and velocity differences are similar to those of the same tracks shifted in time "
         "(p = "
         "{:.2f} and {:.2f}, {} surrogates), so this ranking compares individual motion, not interaction.",
         r.recording.skill.interaction_p[0], r.recording.skill.interaction_p[1], r.recording.skill.surrogates);
  warn_of_identified(r, out);
  if (!r.models.empty() && std::isnan(r.models.front().likeness.skill.value))
    warn(out, Gravity::note,
         "Skill is undefined: the recording is too short to be halved, or its halves are no closer to each other than to its own positions "
         "in "
         "random order.");
  if (!r.models.empty() && std::isfinite(r.models.front().likeness.skill.value)) {
    warn_of_basis(r, out);
    warn_of_rejected(r, out);
  }
  warn_of_order(r, out);
  std::vector<std::string> deciders;
  for (const LeftOut& w : r.ranking.without)
    if (w.winner_changed) deciders.push_back(fmt::format("without {}, {} ranks first", w.model, w.ranking.front().first));
  if (!deciders.empty())
    warn(out, Gravity::result, "Which model ranks first depends on which models are compared: {}.", fmt::join(deciders, ", "));
  return out;
}

}  // namespace swarmfit
