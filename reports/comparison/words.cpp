// SPDX-License-Identifier: MIT
#include "reports/comparison/words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "reports/write/number.h"
#include "reports/write/plain_text.h"

namespace swarmfit {

namespace {

// Of the metrics that count, the one with the largest energy in excess of what a true model would have, if that is known.
std::string main_misfit(const Comparison& c, const ModelFit& winner) {
  const Energies& own = winner.standing.certainty.own;
  const auto excess = [&](std::size_t m) { return winner.runs.raw_energies[m] - (m < own.size() && std::isfinite(own[m]) ? own[m] : 0); };
  const std::size_t none = c.recording.columns.size();
  std::size_t worst = none;
  for (std::size_t m = 0; m < none; ++m)
    if (counts(c, m) && std::isfinite(winner.runs.raw_energies[m]) && (worst == none || excess(m) > excess(worst))) worst = m;
  if (worst == none) return {};
  const std::string energy = fixed(winner.runs.raw_energies[worst], 2);
  if (worst < own.size() && std::isfinite(own[worst]))
    return fmt::format("{} fits {} worst: energy {}, against {} expected if {} were true.", winner.model, c.recording.columns[worst].name(),
                       energy, fixed(own[worst], 2), winner.model);
  return fmt::format("{} fits {} worst: energy {} of at most {}.", winner.model, c.recording.columns[worst].name(), energy,
                     brief(worst_energy(c.recording.binning)));
}

// "p = 0.31", "p ≤ 0.01" where no recording of the model lies beyond.
std::string p_text(double p, int recordings) {
  return p * (1 + recordings) < 1.5 ? fmt::format("p ≤ {}", brief(p, 2)) : fmt::format("p = {}", brief(p, 2));
}

// Observables outside the score that contradict the model.
std::string refuted(const ModelFit& r) {
  const std::vector<std::string> facts = contradictions(r);
  return facts.empty() ? std::string() : fmt::format("Simple observables contradict it: {}.", enumerate(facts));
}

bool explains(const ModelFit& r) { return r.standing.certainty.gof_q > kAlpha; }

// Would the model make recordings like this one?
std::string goodness(const Comparison& c, const ModelFit& r) {
  const double p = r.standing.certainty.gof_p;
  if (!std::isfinite(p)) return {};
  const std::string how = p_text(p, c.ranking.bootstrap_recordings);
  if (explains(r)) return fmt::format("The recording is as close to {0} as recordings simulated from {0} are ({1}).", r.model, how);
  return fmt::format("The recording is farther from {0} than recordings simulated from {0} are ({1}).", r.model, how);
}

// May be true of the best model, too.
bool all_rejected(const std::vector<const ModelFit*>& scored) {
  return std::all_of(scored.begin(), scored.end(),
                     [](const ModelFit* r) { return std::isfinite(r->standing.certainty.gof_q) && !explains(*r); });
}

// Which model has the highest score in sample, if that is another than the first.
std::string first_in_sample(const Comparison& c, const std::vector<const ModelFit*>& scored) {
  if (!c.recording.hold_out.used()) return {};
  const auto best = std::max_element(scored.begin(), scored.end(), [](const ModelFit* a, const ModelFit* b) {
    return a->standing.in_sample.score < b->standing.in_sample.score;
  });
  if (*best == scored.front()) return {};
  return fmt::format("In sample {} has the highest score.", (*best)->model);
}

std::string join(const std::vector<std::string>& sentences) {
  std::string out;
  for (const auto& s : sentences)
    if (!s.empty()) out += (out.empty() ? "" : " ") + s;
  return out;
}

Headline single(const Comparison& c, const ModelFit& only) {
  return {Verdict::single,
          fmt::format("{} is the only model here, so there is nothing to rank.{}", only.model,
                      all_rejected({&only}) ? " It is rejected (p ≤ 0.05)." : ""),
          join({"A score compares models; judge a single fit by its energies and distributions.", goodness(c, only), refuted(only),
                main_misfit(c, only)})};
}

Headline tied(const Comparison& c, const std::vector<std::string>& together, const std::vector<const ModelFit*>& scored) {
  const ModelFit& first = *scored[0];
  // The model with the second score may be told from the first where one with the third cannot, which scatters more.
  const ModelFit& second = **std::find_if(scored.begin() + 1, scored.end(),
                                          [&](const ModelFit* r) { return r->standing.certainty.group == first.standing.certainty.group; });
  return {Verdict::tie,
          all_rejected(scored)
              ? fmt::format("Every fitted model is rejected (p ≤ 0.05); {} are least wrong and not distinguishable.", enumerate(together))
              : fmt::format("{} are not distinguishable with this recording and budget.", enumerate(together)),
          join({fmt::format("{} has the highest score, but its lead over {}, {}, is within chance ({}).", first.model, second.model,
                            fixed(first.standing.score - second.standing.score, 3),
                            p_text(second.standing.certainty.set_p, c.ranking.bootstrap_recordings)),
                goodness(c, first), refuted(first), first_in_sample(c, scored), main_misfit(c, first)})};
}

Headline ranked(const Comparison& c, const std::vector<const ModelFit*>& scored) {
  const ModelFit &first = *scored[0], &second = *scored[1];
  const bool known = first.standing.certainty.group > 0;
  return {known ? Verdict::clear : Verdict::open,
          all_rejected(scored) ? fmt::format("Every fitted model is rejected (p ≤ 0.05); {} is least wrong.", first.model)
                               : fmt::format("{} matches the recording best.", first.model),
          join({fmt::format("It leads {} by {} in score ({}).", second.model, fixed(first.standing.score - second.standing.score, 3),
                            known ? p_text(second.standing.certainty.set_p, c.ranking.bootstrap_recordings) : "certainty not known"),
                goodness(c, first), refuted(first), first_in_sample(c, scored), main_misfit(c, first)})};
}

// Of the models alone.
Headline of_models(const Comparison& c) {
  std::vector<const ModelFit*> scored;
  for (const ModelFit& r : c.models)
    if (std::isfinite(r.standing.score)) scored.push_back(&r);
  if (scored.empty()) return {Verdict::none, "No model could be scored.", "See the warnings and the failed simulations below."};
  if (scored.size() == 1 && c.models.size() == 1) return single(c, *scored[0]);
  if (scored.size() == 1)
    return {Verdict::open, fmt::format("{} is the only model that could be scored.", scored[0]->model), main_misfit(c, *scored[0])};

  std::vector<std::string> together;
  for (const ModelFit* r : scored)
    if (r->standing.certainty.group == 1) together.push_back(r->model);
  return together.size() > 1 ? tied(c, together, scored) : ranked(c, scored);
}

std::string letter_of(int group) { return group > 0 ? std::string(1, static_cast<char>('a' + std::min(group, 26) - 1)) : std::string(); }

}  // namespace

Headline headline(const Comparison& c) {
  Headline models = of_models(c);
  const bool forgets = c.recording.skill.memory_p > kAlpha;
  if (models.verdict == Verdict::none || (!forgets && !c.ranking.walk_suffices)) return models;
  const std::string answer = forgets ? "The recording cannot be distinguished from a random walk of its own steps."
                                     : "No model is closer to the recording than a random walk of its own steps.";
  const std::string memory =
      forgets ? fmt::format("It shows no memory of direction ({}), so no model can be shown to explain more of its motion.",
                            p_text(c.recording.skill.memory_p, c.recording.skill.surrogates))
              : std::string();
  return {Verdict::walk, answer, join({memory, "Among the models:", models.sentence, models.detail})};
}

bool counts(const Comparison& c, std::size_t column) { return c.recording.defined[column] && c.recording.observation.used[column]; }

std::string why_left_out(const Comparison& c, std::size_t column) {
  if (counts(c, column)) return {};
  if (!c.recording.observation.why_not[column].empty()) return c.recording.observation.why_not[column];
  return c.recording.defined[column] ? "left out by request" : "undefined in the recording";
}

std::string marked(const Comparison& c, std::size_t column, const std::string& symbol) {
  if (!counts(c, column)) return '(' + symbol + ')';
  return c.recording.observation.error_dominated[column] ? symbol + '~' : symbol;
}

std::string what_drowned_means(const Comparison& c) {
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m)
    if (counts(c, m) && c.recording.observation.error_dominated[m])
      return "~ mostly measurement error: differences smaller than the measurement error could cause are discounted.";
  return {};
}

std::string what_ranks_mean(const Comparison& c) {
  if (c.ranking.bootstrap_recordings == 0) return {};
  return fmt::format(
      "{}fit p: fraction of recordings simulated from the model ({}) that fit it no better than yours; small means rejected{}. "
      "95 %: interval of the score across recordings of this length. fitted: number of fitted parameters.",
      c.models.size() > 1 ? "Models with the same letter are not distinguishable (model confidence set, 95 %); the test compares scores in "
                            "pairs, so intervals of different letters may overlap. "
                          : "",
      c.ranking.bootstrap_recordings, c.models.size() > 1 ? " (at 0.05, adjusted for the number of models)" : "");
}

std::string what_was_seen(const Comparison& c) { return c.recording.data.format == "simulated" ? "simulation" : "recording"; }

std::string walker_skill(const Estimate& skill) {
  constexpr double kVanishes = 0.005;  // in two decimals
  return skill.se < kVanishes ? fixed(skill.value, 2) : with_error(skill.value, skill.se, 2);
}

std::string_view gravity_title(Gravity gravity) {
  switch (gravity) {
    case Gravity::claim:
      return "Rules out a conclusion";
    case Gravity::result:
      return "May change the result";
    case Gravity::meaning:
      return "Limits what it means";
    case Gravity::note:
      return "Notes";
  }
  return {};
}

std::string fit_p(const Comparison& c, const ModelFit& r) {
  const double p = r.standing.certainty.gof_p;
  return (p * (1 + c.ranking.bootstrap_recordings) < 1.5 ? "≤ " : "") + fixed(p, 2);
}

std::string what_skill_means(const Comparison& c) {
  if (std::none_of(c.models.begin(), c.models.end(), [](const ModelFit& r) { return std::isfinite(r.likeness.skill.value); })) return {};
  const bool motion = std::isfinite(c.recording.skill.walker.value);  // or d and eta alone
  const char* null = c.recording.skill.null_of == SkillNull::places ? "its own positions in random order"
                     : motion ? "a random walk of its own steps (for d and η: its tracks shifted in time)"
                              : "its tracks shifted in time";
  return fmt::format("1 = as close as two halves of the recording; 0 = no better than {}.", null);
}

std::string kept_fixed(const Comparison& c) {
  std::vector<std::pair<std::string, std::vector<std::string>>> by_values;  // and who has them
  for (const ModelFit& r : c.models) {
    std::string values;
    for (const ParameterResult& p : r.parameters)
      if (!p.fitted)
        values += fmt::format("{}{} {}{}{}", values.empty() ? "" : ", ", p.name, brief(p.value, 3), p.unit.empty() ? "" : " ",
                              unit_in_print(p.unit));
    if (values.empty()) continue;
    const auto same = std::find_if(by_values.begin(), by_values.end(), [&](const auto& one) { return one.first == values; });
    if (same == by_values.end())
      by_values.push_back({values, {r.model}});
    else
      same->second.push_back(r.model);
  }
  std::string out;
  for (const auto& [values, models] : by_values) out += fmt::format("{}{}: {}", out.empty() ? "" : "; ", enumerate(models), values);
  return out;
}

std::string steps_taken(const Comparison& c) {
  std::map<int, std::vector<std::string>> by_steps;  // 0: maps
  for (const ModelFit& r : c.models) by_steps[r.runs.map ? 0 : r.runs.steps].push_back(r.model);
  std::vector<std::string> out;
  for (const auto& [steps, models] : by_steps)
    if (steps > 0) out.push_back(fmt::format("{} {}", enumerate(models), steps));
  if (by_steps.contains(0))
    out.push_back(fmt::format("{} {} one step per frame by definition", enumerate(by_steps[0]), by_steps[0].size() > 1 ? "take" : "takes"));
  return fmt::format("{}", fmt::join(out, "; "));
}

std::string lags_measured(const Comparison& c) {
  std::vector<std::string> frames, shares;
  for (const LagFacts& l : c.ranking.lags) {
    if (l.lag == 0) continue;
    frames.push_back(lag_name(c, l.lag));
    if (std::isfinite(l.error_share))
      shares.push_back(fmt::format("{}{} at lag {}", percent(l.error_share), shares.empty() ? " of a metric's variance" : "", l.lag));
  }
  if (frames.empty()) return {};
  std::string out = fmt::format("Motion is measured at {}.", enumerate(frames));
  if ((c.recording.observation.sigma > 0).any() && !shares.empty())
    out += fmt::format(" Measurement error makes up at most {}.", enumerate(shares));
  return out;
}

std::string file_name(const std::string& path) {
  const auto slash = path.find_last_of('/');
  return slash == std::string::npos || slash + 1 == path.size() ? path : path.substr(slash + 1);
}

std::string lag_name(const Comparison& c, int lag) { return fmt::format("lag {} ({} s)", lag, brief(lag * c.recording.data.dt)); }

std::string origin(const Comparison& c) {
  return fmt::format("Recording {}{}, protocol {}, budget {}, seed {}, swarmfit {}.", file_name(c.recording.data.path),
                     c.recording.data.synthetic ? " (synthetic)" : "", c.run.protocol, budget_text(c), c.run.seed, c.run.version);
}

std::string lag_weights(const Comparison& c) {
  std::vector<LagFacts> lags = c.ranking.lags;
  std::stable_sort(lags.begin(), lags.end(), [](const LagFacts& a, const LagFacts& b) { return a.weight > b.weight; });
  std::vector<std::string> parts;
  for (const LagFacts& l : lags)
    parts.push_back(fmt::format("{}{} {}{}", l.lag > 0 ? lag_name(c, l.lag) : "metrics without lag (d, η)", parts.empty() ? " carried" : "",
                                percent(l.weight), parts.empty() ? " of the weight" : ""));
  // One lag and those without: nothing to share out.
  if (lags.size() < 3 || !(lags.front().weight > 0)) return {};
  parts.front().front() = static_cast<char>(std::toupper(static_cast<unsigned char>(parts.front().front())));
  return enumerate(parts) + ". ";
}

double worst_energy(const Binning& b) { return 2 * b.bins / (b.upper - b.lower); }

std::vector<std::string> contradictions(const ModelFit& r) {
  std::vector<std::string> out;
  for (const Refutation& f : r.likeness.refuted_by) out.push_back(f.item.key == "vacf_zero" ? "memory of direction" : f.item.name);
  return out;
}

std::vector<std::string> at_bounds(const ModelFit& r) {
  std::vector<std::string> names;
  for (const ParameterResult& p : r.parameters)
    if (p.at_bound) names.push_back(p.name);
  return names;
}

std::string score_interval(const ModelFit& r) {
  const Certainty& c = r.standing.certainty;
  return std::isfinite(c.lower) ? fmt::format("{} .. {}", fixed(c.lower, 2), fixed(c.upper, 2)) : kUndefined;
}

std::string interval_text(const ParameterUncertainty& u) {
  return u.verdict.empty() ? kUndefined : fmt::format("{} .. {}", rounded(u.lower), rounded(u.upper));
}

std::string partner_text(const ParameterUncertainty& u) {
  constexpr double kWorthSaying = 0.5;
  return std::abs(u.correlation) >= kWorthSaying ? fmt::format("{} ({})", u.partner, fixed(u.correlation, 2)) : std::string();
}

std::string verdict_text(const ParameterResult& p) {
  const bool outside = p.value < p.posterior.lower || p.value > p.posterior.upper;
  return outside ? "inconsistent" : p.posterior.verdict;
}

std::string budget_text(const Comparison& c) {
  std::string out = c.run.budget.name;
  for (const auto& [name, value] : c.run.config)
    if (name == "max-evaluations" && value != "0") out += fmt::format(", at most {} candidates per model", value);
  return out;
}

std::string what_posteriors_mean() {
  return "95 %: central interval of the posterior under a uniform prior on the search axis (log or square root). identified: the recording "
         "determines the parameter; one-sided: the interval reaches a bound; flat: hardly narrower than the bounds; inconsistent: the best "
         "value lies "
         "outside. correlated with: the "
         "parameter with the strongest posterior correlation.";
}

std::string group_letter(const ModelFit& r) { return letter_of(r.standing.certainty.group); }

std::string what_held_out_means(const Comparison& c) {
  const HoldOutFacts& h = c.recording.hold_out;
  if (!h.used()) return c.models.size() > 1 ? "score: in sample, that is, on the frames that the models were fitted to." : "";
  const HeldOutWay& w = h.ways.front();
  return fmt::format(
      "score: every model is fitted to frames {} to {} and scored on frames {} to {}, and the other way round{}; the score is the mean. in "
      "sample: score of the fit to the whole recording.",
      w.fitted_first, w.fitted_last, w.held_first, w.held_last,
      h.searches > 1 ? fmt::format(", the best of {} searches each", h.searches) : "");
}

std::string halves_text(const ParameterResult& p) {
  return std::isfinite(p.halves_lower) ? fmt::format("{} .. {}", rounded(p.halves_lower), rounded(p.halves_upper)) : kUndefined;
}

std::string fitted_values(const ModelFit& r) {
  std::string out;
  for (const ParameterResult& p : r.parameters) {
    if (!p.fitted) continue;
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", p.name, rounded(p.value));
    if (std::isfinite(p.halves_lower)) out += fmt::format(" ({})", halves_text(p));
    if (!p.unit.empty()) out += ' ' + unit_in_print(p.unit);
  }
  return out;
}

std::string sigma_text(const Comparison& c) {
  std::string out;
  for (int axis = 0; axis < c.recording.data.dims; ++axis)
    out += fmt::format("{}{} {}", axis > 0 ? ", " : "", "xyz"[axis], brief(c.recording.observation.sigma[axis], 3));
  return out + ' ' + c.recording.data.unit;
}

std::string what_energy_means(const Comparison& c) {
  const std::string worst = brief(worst_energy(c.recording.binning));
  if (c.recording.binning.pooled) return fmt::format("the L1 distance of the distributions, 0 = equal, {} = disjoint", worst);
  return fmt::format(
      "the discrepancy of a metric: mean simulation–recording distance minus half the mean simulation–simulation distance; lower is "
      "better, "
      "{} is the worst",
      worst);
}

}  // namespace swarmfit
