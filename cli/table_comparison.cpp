// SPDX-License-Identifier: MIT
// Settings: how models are fitted and compared.
#include "cli/parse.h"
#include "cli/tables.h"
#include "libeval/lags.h"
#include "libtrack/file.h"

namespace swarmfit::cli {
namespace {

constexpr double kMostCandidates = 1e9, kMostReplicates = 1'000, kMostSearches = 100, kMostBins = 100'000, kMostIndividuals = 10'000;
constexpr double kStrongestSmoothing = 10'000;  // frames
constexpr int kRen2016Passes = 10;              // of the calibration loop; the paper iterates until the weights settle and names no limit
constexpr std::string_view kSearch = "Search", kConditions = "Conditions", kScoring = "Scoring";

std::vector<std::string_view> budget_names() {
  std::vector<std::string_view> names;
  for (const Budget& budget : budgets()) names.emplace_back(budget.name);
  return names;
}

std::vector<Setting> search() {  // NOLINT(readability-function-size): a table
  return {
      {.name = "protocol",
       .in = kComparisons,
       .help = "default, or ren2016, the paper's literal choices (docs/ren2016.md): its five models, noises and parameters, the genetic "
               "algorithm alone, z-scores of each set by itself, no measurement error or rounding, the fewest steps, lag 1; other flags "
               "override it",
       .allowed = one_of({"default", "ren2016"}),
       .initial = "default",
       .use =
           [](Arguments& a, const Value& v) {
             a.compare.protocol = v.text();
             a.compare.conditions.rounding = v.text() != "ren2016";
           }},
      {.name = "budget",
       .in = kComparisons,
       .help = "how long to search: quick, default or thorough",
       .allowed = one_of(budget_names()),
       .initial = "default",
       .group = kSearch,
       .elsewhere = {kPower | kRecover, "quick"},
       .use =
           [](Arguments& a, const Value& v) {
             a.compare.budget = budget_named(v.text());
             if (a.compare.protocol == "ren2016") a.compare.budget.passes = kRen2016Passes;
           }},
      {.name = "search",
       .in = kComparisons,
       .help = "full (default): least-squares steps in the genetic algorithm, a refinement after it, and variants of one model share what "
               "they find; genetic: the genetic algorithm alone, as published",
       .allowed = one_of({"full", "genetic"}),
       .initial = "full",
       .ren2016 = "genetic",
       .group = kSearch,
       .use = [](Arguments& a, const Value& v) { a.compare.evolution_only = v.text() == "genetic"; }},
      {.name = "searched",
       .in = kComparisons,
       .help = "which parameters: all that matter (default), or published: only those of Ren et al. 2016; --set, --fix and --bounds "
               "override it",
       .allowed = one_of({"all", "published"}),
       .initial = "all",
       .ren2016 = "published",
       .group = kSearch,
       .use = [](Arguments& a, const Value& v) { a.compare.requests.published = v.text() == "published"; }},
      {.name = "parameters",
       .in = kRecover,
       .help = "of one model: how often do the 95 % intervals of its parameters contain the true values? These are drawn from the whole "
               "range of the search",
       .allowed = on_or_off(),
       .use = [](Arguments& a, const Value& v) { a.parameters = v.on(); }},
      {.name = "max-evaluations",
       .in = kComparisons,
       .help = "hard limit of candidates per model",
       .allowed = whole(0, kMostCandidates),
       .group = kSearch,
       .use = [](Arguments& a, const Value& v) { a.compare.max_evaluations = v.whole<std::int64_t>(); }},
      {.name = "replicates",
       .in = kFits,
       .help = "simulations per candidate, instead of the budget's",
       .allowed = whole(0, kMostReplicates),
       .group = kSearch,
       .use =
           [](Arguments& a, const Value& v) {
             if (v.whole<int>() > 0) a.compare.budget.search.replicates = v.whole<int>();
           }},
      {.name = "set",
       .in = kFits,
       .help = "keep a parameter at a value: parameter=value, or model.parameter=value for one model",
       .allowed = texts(),
       .group = kSearch,
       .use = [](Arguments& a, const Value& v) { a.compare.requests.set = parse_assignments(v.words); }},
      {.name = "fix",
       .in = kFits,
       .help = "parameters to keep at their default",
       .allowed = split_texts(),
       .group = kSearch,
       .use =
           [](Arguments& a, const Value& v) {
             for (const auto& name : v.words) a.compare.requests.fix[name] = true;
           }},
      {.name = "bounds",
       .in = kFits,
       .help = "search a parameter between bounds: parameter=lower:upper",
       .allowed = texts(),
       .group = kSearch,
       .use = [](Arguments& a, const Value& v) { a.compare.requests.bounds = parse_bounds(v.words); }},
  };
}

std::vector<Setting> conditions() {  // NOLINT(readability-function-size): a table
  return {
      {.name = "presence",
       .in = kFits,
       .help = "which individuals are present when: recorded, or constant (all of the first frame, throughout)",
       .allowed = one_of({"recorded", "constant"}),
       .initial = "recorded",
       .group = kConditions,
       .use =
           [](Arguments& a, const Value& v) {
             using Presence = ConditionOptions::Presence;
             a.compare.conditions.presence = v.text() == "constant" ? Presence::constant : Presence::recorded;
           }},
      {.name = "arena",
       .in = kFits,
       .help = "open, box, sphere, or x0:x1,y0:y1[,z0:z1]",
       .initial = "open",
       .group = kConditions,
       .use = [](Arguments& a, const Value& v) { a.compare.conditions.arena = v.text(); }},
      {.name = "world",
       .in = kFits | kSimulate,
       .help = "file with [bounds] and [[obstacle]], as in a scenario: walls that no animal passes",
       .group = kConditions,
       .use =
           [](Arguments& a, const Value& v) {
             a.compare.conditions.world = a.scene.world = {v.text(), read_file(v.text())};
           }},
      {.name = "population",
       .in = kFits,
       .help = "number of individuals, where only part of the group was tracked: the others are simulated, but not observed",
       .allowed = whole(1, kMostIndividuals),
       .group = kConditions,
       .use = [](Arguments& a, const Value& v) { a.compare.conditions.population = v.whole<int>(); }},
      {.name = "entry",
       .in = kComparisons,
       .help = "velocity with which individuals enter simulations: estimated from their first frames (default), or difference of their "
               "first two positions",
       .allowed = one_of({"estimated", "difference"}),
       .initial = "estimated",
       .ren2016 = "difference",
       .group = kConditions,
       .use =
           [](Arguments& a, const Value& v) {
             a.compare.conditions.entry = v.text() == "difference" ? EntryVelocity::difference : EntryVelocity::estimated;
           }},
      {.name = "common",
       .in = kCompare,
       .help = "fit what all the models have in common once, with the first of them, and keep it (the paper's noise comparison)",
       .allowed = on_or_off(),
       .group = kSearch,
       .use = [](Arguments& a, const Value& v) { a.compare.common_dynamics = v.on(); }},
      {.name = "holdout",
       .in = kFits,
       .help = "rank by what was not fitted: fit every model to each half of the recording as well, and score it on the other. auto: when "
               "several models are compared and each half is longer than three times the time after which motion is new",
       .allowed = one_of({"auto", "yes", "no"}),
       .initial = "auto",
       .ren2016 = "no",
       .use =
           [](Arguments& a, const Value& v) {
             using When = CompareOptions::HoldOutWhen;
             a.compare.hold_out = v.text() == "yes" ? When::always : v.text() == "no" ? When::never : When::worth_it;
           }},
      {.name = "searches",
       .in = kFits,
       .help = "searches of each half, each with a seed of its own: the best fit is scored on the other half, and the scatter between "
               "searches widens the interval",
       .allowed = whole(1, kMostSearches),
       .initial = "1",
       .group = kSearch,
       .use = [](Arguments& a, const Value& v) { a.compare.searches = v.whole<int>(); }},
      {.name = "posterior",
       .in = kFits,
       .help = "also the posterior of the parameters: 95 % intervals, which parameters the recording determines, and a sample",
       .allowed = on_or_off(),
       .use = [](Arguments& a, const Value& v) { a.compare.posterior = v.on(); }},
      {.name = "likelihood",
       .in = kFits,
       .help = "also the parameters of maximum likelihood with 95 % intervals, for models whose motion is linear (langevin)",
       .allowed = on_or_off(),
       .use = [](Arguments& a, const Value& v) { a.compare.likelihood = v.on(); }},
      {.name = "regression",
       .in = kFits,
       .help = "also the parameters by regression of accelerations with 95 % intervals, for models that move by forces and simple noise "
               "(brownian, langevin, bswarm[noise=white]): a second opinion, without simulations",
       .allowed = on_or_off(),
       .use = [](Arguments& a, const Value& v) { a.compare.regression = v.on(); }},
      {.name = "obs-noise",
       .in = kComparisons,
       .help = "measurement error put on simulated positions: estimate (default), or a value in length units",
       .initial = "estimate",
       .ren2016 = "0",
       .group = kConditions,
       .use = [](Arguments& a, const Value& v) { set_localisation_error(a.compare.conditions, v.text()); }},
  };
}

std::vector<Setting> scoring() {  // NOLINT(readability-function-size): a table
  return {
      {.name = "error-limit",
       .in = kFits,
       .help = "share of measurement error beyond which a metric counts only where models differ by more than that error could cause "
               "(default 0.5)",
       .allowed = number(0, 1),
       .initial = "0.5",
       .ren2016 = "1",
       .group = kScoring,
       .use = [](Arguments& a, const Value& v) { a.compare.error_limit = v.number(); }},
      {.name = "resolution",
       .in = kComparisons,
       .help = "recording (default): model differences within sampling noise are down-weighted; none: they count in full, as published",
       .allowed = one_of({"recording", "none"}),
       .initial = "recording",
       .ren2016 = "none",
       .group = kScoring,
       .use = [](Arguments& a, const Value& v) { a.compare.resolution = v.text() == "recording"; }},
      {.name = "scoring",
       .in = kComparisons,
       .help = "how several simulations of a model are compared with the recording: by the energy score (proper, default), or as one "
               "pooled distribution, as published (pooled)",
       .allowed = one_of({"proper", "pooled"}),
       .group = kScoring,
       .follows = [](const Values& all) -> std::string { return all.text("normalisation") == "separate" ? "pooled" : "proper"; }},
      {.name = "calibration",
       .in = kComparisons,
       .help = "later passes search under the mean of all passes' weights (default), or under the last weights, as published",
       .allowed = one_of({"mean", "last"}),
       .initial = "mean",
       .ren2016 = "last",
       .group = kScoring,
       .use = [](Arguments& a, const Value& v) { a.compare.mean_weights = v.text() == "mean"; }},
      {.name = "lags",
       .in = kComparisons | kEvaluate,
       .help = "numbers of frames over which motion is measured, such as 1,4,16; each lag has metrics of its own. auto (default of "
               "comparisons): 1, and the shortest lag at which no metric of motion exceeds the error limit",
       .initial = "auto",
       .ren2016 = "1",
       .group = kScoring,
       .elsewhere = {kEvaluate, "1"},
       .use = [](Arguments& a, const Value& v) { a.compare.lags = parse_lags(v.text()); }},
      {.name = "steps",
       .in = kComparisons,
       .help = "simulation steps per frame: auto (default): for each model as many as are needed until halving the step changes no energy; "
               "fewest: as few as are stable; or a number. Models that decide once per frame always take one",
       .initial = "auto",
       .ren2016 = "fewest",
       .group = kConditions,
       .use = [](Arguments& a, const Value& v) { a.compare.conditions.steps = parse_steps(v.text()); }},
      {.name = "smooth",
       .in = kFits,
       .help = "smooth recording and simulations in the same way, Gaussian, standard deviation in frames",
       .allowed = number(0, kStrongestSmoothing),
       .group = kConditions,
       .use = [](Arguments& a, const Value& v) { a.compare.conditions.smoothing = v.number(); }},
      {.name = "smooth",
       .in = kConvert,
       .help = "Gaussian smoothing, standard deviation in frames",
       .allowed = number(0, kStrongestSmoothing),
       .use = [](Arguments& a, const Value& v) { a.smoothing = v.number(); }},
      {.name = "velocity",
       .in = kFits | kEvaluate,
       .help = "difference of positions, or the recorded velocity column",
       .allowed = one_of({"difference", "recorded"}),
       .initial = "difference",
       .group = kScoring,
       .use =
           [](Arguments& a, const Value& v) {
             a.compare.conditions.velocity = v.text() == "recorded" ? VelocitySource::recorded : VelocitySource::difference;
           }},
      {.name = "normalisation",
       .in = kFits | kEvaluate,
       .help = "mean and deviation that standardise the metrics: reference (default), separate or none",
       .allowed = one_of({"reference", "separate", "none"}),
       .initial = "reference",
       .ren2016 = "separate",
       .group = kScoring,
       .use = [](Arguments& a, const Value& v) { a.compare.binning = binning(v.text(), v.all); }},  // of bins and scoring, too
      {.name = "bins",
       .in = kFits | kEvaluate,
       .help = "histogram bins, instead of the normalisation's default",
       .allowed = whole(0, kMostBins),
       .group = kScoring},
  };
}

}  // namespace

std::vector<Setting> comparison_settings() {
  std::vector<Setting> all = search();
  for (const auto& part : {conditions(), scoring()}) all.insert(all.end(), part.begin(), part.end());
  all.push_back({.name = "set",
                 .in = kRecover,
                 .help = "model.parameter=value, of the true models, in physical units",
                 .allowed = texts(),
                 .use = [](Arguments& a, const Value& v) { a.recovery.set = parse_planted(v.words); }});
  all.push_back({.name = "seeds",
                 .in = kPower,
                 .help = "recordings simulated from each model, 2 or more",
                 .allowed = whole(2, kMostRecordings),
                 .initial = "3",
                 .use = [](Arguments& a, const Value& v) { a.seeds = v.whole<int>(); }});
  return all;
}

}  // namespace swarmfit::cli
