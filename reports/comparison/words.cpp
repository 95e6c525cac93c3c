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

// Of the metrics that count, the one in which the winner is farthest from the recording: beyond what its own recordings have, if that is
// known.
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
    return fmt::format("Its largest misfit is in the {} (energy {}, its own recordings {}).", c.recording.columns[worst].name(), energy,
                       fixed(own[worst], 2));
  return fmt::format("Its largest misfit is in the {} (energy {} of at most {}).", c.recording.columns[worst].name(), energy,
                     brief(worst_energy(c.recording.binning)));
}

// "p = 0.31", "p ≤ 0.01" where no recording of the law lies beyond.
std::string p_text(double p, int laws) {
  return p * (1 + laws) < 1.5 ? fmt::format("p ≤ {}", brief(p, 2)) : fmt::format("p = {}", brief(p, 2));
}

// What nobody needs a metric for, and refutes the model all the same.
std::string refuted(const ModelFit& r) {
  std::vector<std::string> facts;
  for (const Refutation& f : r.likeness.refuted_by) facts.push_back(f.item.key == "vacf_zero" ? "memory of direction" : f.item.name);
  return facts.empty() ? std::string() : fmt::format("What anybody sees refutes it: {}.", enumerate(facts));
}

bool explains(const ModelFit& r) { return r.standing.certainty.goodness_q > kAlpha; }

// Is the recording one that the model could have made?
std::string goodness(const Comparison& c, const ModelFit& r) {
  const double p = r.standing.certainty.goodness_p;
  if (!std::isfinite(p)) return {};
  const bool could = explains(r);
  return fmt::format("The recording lies {} {} than recordings made by it ({}).", could ? "no farther from" : "farther from", r.model,
                     p_text(p, c.ranking.laws));
}

// May be true of the best model, too.
bool none_explains(const std::vector<const ModelFit*>& scored) {
  return std::all_of(scored.begin(), scored.end(),
                     [](const ModelFit* r) { return std::isfinite(r->standing.certainty.goodness_q) && !explains(*r); });
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
                      none_explains({&only}) ? " It does not explain the recording." : ""),
          join({"A score compares models with each other; alone, judge the fit by its raw energies and distributions.", goodness(c, only),
                refuted(only), main_misfit(c, only)})};
}

Headline tied(const Comparison& c, const std::vector<std::string>& together, const std::vector<const ModelFit*>& scored) {
  const ModelFit &first = *scored[0], &second = *scored[1];
  return {
      Verdict::tie,
      none_explains(scored)
          ? fmt::format("None of these models explains the recording. {} come closest and cannot be told apart.", enumerate(together))
          : fmt::format("{} cannot be told apart with this recording and budget.", enumerate(together)),
      join({fmt::format("{} has the highest score, but leads {} by only {}, no more than chance does ({}).", first.model, second.model,
                        fixed(first.standing.score - second.standing.score, 3), p_text(second.standing.certainty.set_p, c.ranking.laws)),
            goodness(c, first), refuted(first), first_in_sample(c, scored), main_misfit(c, first)})};
}

Headline ranked(const Comparison& c, const std::vector<const ModelFit*>& scored) {
  const ModelFit &first = *scored[0], &second = *scored[1];
  const bool known = first.standing.certainty.group > 0;
  return {known ? Verdict::clear : Verdict::open,
          none_explains(scored) ? fmt::format("None of these models explains the recording. {} comes closest.", first.model)
                                : fmt::format("{} moves most like the recording.", first.model),
          join({fmt::format("It leads {} by {} in score ({}).", second.model, fixed(first.standing.score - second.standing.score, 3),
                            known ? p_text(second.standing.certainty.set_p, c.ranking.laws) : "it cannot be told how sure that is"),
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
  const std::string answer = forgets ? "The recording moves like a random walk made of its own steps."
                                     : "No model is closer to the recording than a random walk made of its own steps.";
  const std::string memory =
      forgets ? fmt::format("It shows no memory of direction ({}), so no model can be told to explain more of how it moves.",
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
  return c.recording.observation.drowned[column] ? symbol + '~' : symbol;
}

std::string what_drowned_means(const Comparison& c) {
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m)
    if (counts(c, m) && c.recording.observation.drowned[m])
      return "~ mostly localisation error: models are told apart only as far as they differ by more than as much error again would make.";
  return {};
}

std::string what_ranks_mean(const Comparison& c) {
  if (c.ranking.laws == 0) return {};
  return fmt::format(
      "{}95 %: of the score, over recordings as long as this one. fit p: the share of recordings made by the model, of {}, that lie as far "
      "from it as this one; {}fitted: how many parameters were.",
      c.models.size() > 1 ? "Models with the same letter cannot be told apart (model confidence set, 95 %). " : "", c.ranking.laws,
      c.models.size() > 1 ? "a model explains the recording where that, adjusted for the number of models, is above 0.05. " : "");
}

std::string what_skill_means(const Comparison& c) {
  if (std::none_of(c.models.begin(), c.models.end(), [](const ModelFit& r) { return std::isfinite(r.likeness.skill.value); })) return {};
  const bool motion = std::isfinite(c.recording.skill.walker.value);  // or d and eta alone
  const char* null = c.recording.skill.null_of == SkillNull::places ? "its own places in random order"
                     : motion ? "a random walk of its own steps (in d and η: than its tracks shifted in time)"
                              : "its tracks shifted in time";
  return fmt::format("1 as close to the recording as two halves of it are to each other, 0 no closer than {}.", null);
}

std::string kept_fixed(const Comparison& c) {
  std::vector<std::pair<std::string, std::vector<std::string>>> by_values;  // and who has them
  for (const ModelFit& r : c.models) {
    std::string values;
    for (const ParameterResult& p : r.parameters)
      if (!p.fitted)
        values += fmt::format("{}{} {}{}{}", values.empty() ? "" : ", ", p.name, brief(p.value, 3), p.unit.empty() ? "" : " ", p.unit);
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
    out.push_back(fmt::format("{} {} once per frame", enumerate(by_steps[0]), by_steps[0].size() > 1 ? "decide" : "decides"));
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
    out += fmt::format(" Localisation error makes up at most {}.", enumerate(shares));
  return out;
}

std::string lag_name(const Comparison& c, int lag) { return fmt::format("lag {} ({} s)", lag, brief(lag * c.recording.data.dt)); }

std::string origin(const Comparison& c) {
  return fmt::format("Recording {}{}, protocol {}, budget {}, seed {}, swarmfit {}.", c.recording.data.path,
                     c.recording.data.synthetic ? " (synthetic)" : "", c.run.protocol, c.run.budget.name, c.run.seed, c.run.version);
}

std::string lag_weights(const Comparison& c) {
  std::vector<LagFacts> lags = c.ranking.lags;
  std::stable_sort(lags.begin(), lags.end(), [](const LagFacts& a, const LagFacts& b) { return a.weight > b.weight; });
  std::vector<std::string> parts;
  for (const LagFacts& l : lags)
    parts.push_back(fmt::format("{}{} {}{}", l.lag > 0 ? lag_name(c, l.lag) : "what has no lag (d, η)", parts.empty() ? " carried" : "",
                                percent(l.weight), parts.empty() ? " of the weight" : ""));
  // One lag and those without: nothing to share out.
  if (lags.size() < 3 || !(lags.front().weight > 0)) return {};
  parts.front().front() = static_cast<char>(std::toupper(static_cast<unsigned char>(parts.front().front())));
  return enumerate(parts) + ". ";
}

double worst_energy(const Binning& b) { return 2 * b.bins / (b.upper - b.lower); }

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

std::string what_posteriors_mean() {
  return "95 %: of the posterior under a prior that is even between the bounds of the search. identified: the recording determines the "
         "parameter; one-sided: the interval reaches a bound; flat: hardly narrower than the bounds. goes with: what else changes along "
         "with it "
         "(correlation).";
}

std::string group_letter(const ModelFit& r) { return letter_of(r.standing.certainty.group); }

std::string what_held_out_means(const Comparison& c) {
  const HoldOutFacts& h = c.recording.hold_out;
  if (!h.used()) return c.models.size() > 1 ? "score: in sample, of the frames that the models were fitted to." : "";
  const HeldOutWay& w = h.ways.front();
  return fmt::format(
      "score: every model is fitted to frames {} to {} and scored on frames {} to {}, and the other way round; the score is the mean{}. in "
      "sample: score of the fit to the whole recording.",
      w.fitted_first, w.fitted_last, w.held_first, w.held_last, h.searches > 1 ? fmt::format(" of {} searches each", h.searches) : "");
}

std::string halves_text(const ParameterResult& p) {
  return std::isfinite(p.halves_lower) ? fmt::format("{} .. {}", rounded(p.halves_lower), rounded(p.halves_upper)) : kUndefined;
}

std::string likelihood_text(const ParameterResult& p) {
  const ParameterLikelihood& l = p.likelihood;
  if (!std::isfinite(l.value)) return kUndefined;
  return std::isfinite(l.lower) ? fmt::format("{} ({} .. {})", rounded(l.value), rounded(l.lower), rounded(l.upper))
                                : fmt::format("{} (no interval)", rounded(l.value));
}

std::string most_likely_values(const ModelFit& r) {
  std::string out;
  if (!std::isfinite(r.likelihood.log_likelihood)) return out;
  for (const ParameterResult& p : r.parameters)
    if (std::isfinite(p.likelihood.value))
      out += fmt::format("{}{} {}{}{}", out.empty() ? "" : ", ", p.name, likelihood_text(p), p.unit.empty() ? "" : " ", p.unit);
  return out + fmt::format("; log-likelihood {:.1f}, localisation error {}", r.likelihood.log_likelihood, rounded(r.likelihood.error, 2));
}

std::string fitted_values(const ModelFit& r) {
  std::string out;
  for (const ParameterResult& p : r.parameters) {
    if (!p.fitted) continue;
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", p.name, rounded(p.value));
    if (std::isfinite(p.halves_lower)) out += fmt::format(" ({})", halves_text(p));
    if (!p.unit.empty()) out += ' ' + p.unit;
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
  if (c.recording.binning.pooled) return fmt::format("the L1 distance of the distributions, 0 alike .. {} disjoint", worst);
  return fmt::format(
      "the energy score, distance of simulations from the recording less half that between simulations; lower is better, {} the worst",
      worst);
}

}  // namespace swarmfit
