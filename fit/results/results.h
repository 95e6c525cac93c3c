// SPDX-License-Identifier: MIT
// What a fit and a comparison found: plain values with every number a report needs. Written to disk by reports/.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "libeval/energy.h"
#include "libeval/panel.h"
#include "libeval/score.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// Candidates of one search, and on how many seeds each is simulated.
struct SearchSize {
  int population, generations;  // their product is the number of candidates
  int replicates;
};

// Simulations that a search starts from (fit/model_fit/scout.h): of this many rounds, each of so many.
struct ScoutSize {
  int rounds, simulations;
};

// How much searching is done per model and calibration pass (docs/search.md).
struct Budget {
  std::string name;
  SearchSize search;            // everywhere
  SearchSize selection;         // again, about the leaders, on fresh and more seeds
  int confirmation_replicates;  // the best of those, on seeds that favour none of them
  int final_replicates;         // the winner, on seeds that had no part in choosing it
  int passes;                   // of the calibration loop, at most
  ScoutSize scout = {0, 0};     // none
};

// A recording in a few numbers, as stored with results.
struct DataFacts {
  std::string path, sha256, format, columns, unit;
  bool synthetic = false;
  int dims = 3;
  double dt = 0;  // [s]
  Index rows = 0;
  std::size_t tracks = 0, frames = 0;
  std::int64_t first_frame = 0, last_frame = 0;
  double individuals_per_frame = 0;
  double extent = 0, spacing = 0, speed = 0;  // L, NND [unit], V [unit/s]: the scales of the fit bounds
  std::vector<std::string> notes;
};

// How simulations were made comparable with the recording.
struct ObservationFacts {
  std::string presence;                              // "recorded" or "constant"
  std::string arena;                                 // as --arena takes it
  int unseen = 0;                                    // individuals simulated beside the tracked ones (--population)
  std::string error_source;                          // "estimate", "given", "none"
  Eigen::Array3d sigma = Eigen::Array3d::Zero();     // localisation error per axis [unit]
  bool white = true;                                 // the estimate is consistent with white error
  Eigen::Array3d rounding = Eigen::Array3d::Zero();  // to which positions are rounded on both sides, per axis [unit]; 0: not
  double smoothing = 0;                              // standard deviation of the Gaussian smoothing of both sides [frames]; 0: none
  std::string velocity;                              // "difference" or "recorded"
  PerColumn<double> independent{};                   // effective sample size of each column (libeval/independent.h); NaN undefined
  PerColumn<double> error_share{};                   // share of each column's variance that is localisation error; NaN unknown
  PerColumn<bool> drowned{};                         // more of it is error than CompareOptions::error_limit
  PerColumn<bool> used{};                            // is the column in the default score?
  PerColumn<std::string> why_not{};                  // the reason where it is not
  int longest_lag = 1;                               // that the recording carries (libeval/lags.h) [frames]
};

// What the columns of one lag contribute.
struct LagFacts {
  int lag = 1;               // [frames]; 0: the columns without one, d and eta
  int scored = 0;            // columns in the score
  double weight = 0;         // their weights, summed
  double error_share = NAN;  // the largest of its columns; NaN unknown
};

// What the recording says about a parameter beside its best value (fit/model_fit/parameter_posterior.h), in physical units.
struct ParameterUncertainty {
  double median = NAN, lower = NAN, upper = NAN;  // posterior, ends of the central 95 %; NaN: not asked for, or not searched
  double contraction = NAN;                       // 1 - variance / variance of the prior, on the axis of the search
  std::string verdict;                            // "identified", "one-sided", "flat"; empty: as above
  std::string partner;                            // the parameter with the strongest correlation, and that; empty: there is no other
  double correlation = NAN;
};

struct ParameterResult {
  std::string name, symbol, unit, meaning;
  double value = 0, lower = 0, upper = 0;  // physical units; lower = upper = value where it was not searched
  bool fitted = false, log = false;
  bool at_bound = false;   // within 1 % of the searched interval from a bound
  std::string at_lower{};  // of the lower one, what that means, if anything
  ParameterUncertainty posterior{};
  bool interaction = false;  // of neighbours: used only with the model's interaction, or a length in neighbour distances
};

// Behind the uncertainty of a model's parameters.
struct PosteriorFacts {
  std::vector<std::vector<double>> sample{};  // searched parameters in table order, physical units
  std::vector<double> weight{};               // sums to 1
  double effective = NAN;                     // effective sample size
  int simulations = 0, blew_up = 0;           // 0: no posterior
};

// One point of a convergence curve.
struct ConvergencePoint {
  int pass;                  // of the calibration loop, from 1
  std::int64_t evaluations;  // of this model so far, all passes
  double best;               // best score so far, with the weights of that pass
};

// A model's score when the weight of one column is dropped or doubled, and its rank when it is dropped.
struct Sensitivity {
  PerColumn<double> without{}, doubled{};
  PerColumn<int> rank_without{};
};

// A number and its standard error; NaN: undefined.
struct Estimate {
  double value = NAN, se = NAN;
};

// What a skill of 0 is no better than (libeval/surrogate.h).
enum class SkillNull {
  none,    // neither of these can be told from halves of the recording: skill is undefined
  steps,   // a random walk of the recording's own steps, and for d and eta its tracks shifted in time
  places,  // its own places in random order: where the walk is as close to the recording as its halves are to each other
};

// The scale of skill, which the recording sets alone (libeval/skill.h).
struct SkillFacts {
  PerColumn<double> floor{}, floor_sd{};  // total variation distance between halves of the recording; NaN undefined
  PerColumn<double> null{};               // of the surrogates without interaction (d, eta) or without memory of direction (the others)
  PerColumn<double> places{};             // of the surrogates that have the recording's places in random order
  PerColumn<bool> informative{};          // the null is farther than the floor by more than two of its standard deviations
  // Behind the skill: the columns of the score, or all that are defined if none of those is informative.
  PerColumn<bool> used{};
  SkillNull null_of = SkillNull::none;       // which null the scale has
  double mean_floor = NAN, mean_null = NAN;  // over the used columns; the null is the one of the scale
  double mean_floor_sd = NAN;                // of mean_floor, over the choices of halves
  Estimate walker;                           // skill of the random walk; 0 where it is the null, NaN where no column of motion is used
  bool walk_suffices = false;                // no model has more, by two standard errors of both
  double memory_p = NAN;                     // over the used columns of motion: is the recording like a random walk of its own steps?
  double interaction_p[2] = {NAN, NAN};      // of d and eta: is the recording like its own tracks shifted in time?
  int surrogates = 0;                        // behind memory_p and interaction_p, each
};

// A fact that anybody sees and that a fitted model gets wrong (fit/compare/refute.h).
struct Refutation {
  PanelItem item;
  Estimate recording;            // NaN: it has no such number
  double model = NAN, sd = NAN;  // over its single final replicates; NaN: none has
};

// What was measured beside the metrics (libeval/panel.h), and what the recording says.
struct PanelFacts {
  std::vector<PanelItem> items;
  std::vector<Estimate> recording;       // per item; standard error over blocks of time
  std::vector<double> lags;              // of the velocity autocorrelation [s]
  std::vector<Estimate> recording_vacf;  // per lag
};

// The ranking of the others, from the same energies, when one model is not compared.
struct LeftOut {
  std::string model;
  PerColumn<double> weights{};
  std::vector<std::pair<std::string, double>> ranking;  // names and scores, best first
  bool reordered = false;                               // two of the others change places
  bool winner_changed = false;                          // another than the first leads, the first not being the one left out
};

// Level of tests, intervals and groups.
inline constexpr double kAlpha = 0.05;

// How sure the place of a model is, from recordings made by the fitted models (fit/compare/certainty.h).
struct Certainty {
  double goodness_p = NAN;                    // share of recordings made by this fit that are as far from it as the recording is
  int group = 0;                              // models of one group cannot be told apart, the best are group 1; 0: cannot be told
  double set_p = NAN;                         // p at which the model leaves the model confidence set of all
  double lower = NAN, upper = NAN;            // of the score, 95 %, over recordings as long as this one
  double lead_lower = NAN, lead_upper = NAN;  // of the first model's lead, 95 %
  Energies own{};                             // mean raw energies of its own recordings: what a perfect model would have
};

// Does a model's motion repeat that of the half it was fitted to? Median distances of paths to the nearest path of that half
// (libeval/nearness.h).
struct Nearness {
  double simulated = NAN, recorded = NAN;  // of the model's paths, and of the held-out ones [unit]
  std::int64_t frames = 0;                 // length of the paths
};

// A model on the half of the recording that it was not fitted to (fit/compare/hold_out.h), under the weights of the other half.
struct HeldOut {
  double score = NAN;
  Energies raw{};
  Certainty certainty{};
  Nearness nearness{};
};

// Which frames were fitted, and which held out.
struct HoldOutFacts {
  bool used = false;
  std::int64_t fitted_first = 0, fitted_last = 0, held_first = 0, held_last = 0;
};

// Everything about one model in a comparison (or the only one of a fit).
struct FitResult {
  std::string model;  // canonical name with settings: "bswarm[noise=white]"
  std::string summary, citation;
  std::map<std::string, std::string> options;  // complete
  std::vector<ParameterResult> parameters;     // the whole table, unused rows left out
  int rank = 0;                                // 1 is best; 0 if the score is undefined
  double score = 0;                            // E, higher is better, with the comparison's weights
  double score_se = 0;                         // standard error of the mean score of single final replicates; NaN if undefined
  Energies raw_energies{};                     // over the pooled final replicates
  Energies raw_se{};                           // standard errors of the mean of single replicates
  Energies energies{};                         // (raw - p1)/p2, 0 where p2 = 0
  Energies half_step_energies{};               // raw energies of the same parameters at half the time step, same number of replicates
  Sensitivity sensitivity;
  Certainty certainty;
  HeldOut held_out{};
  bool learns = false;                                             // takes its motion from the recording, as fastswarm does
  std::vector<Energies> replicate_energies;                        // raw, one per final replicate
  PerColumn<Distribution> distributions{};                         // pooled final replicates, on the recording's axes
  PerColumn<double> mean_ratio{}, sd_ratio{}, outside_fraction{};  // simulation / recording
  double extent = 0, spacing = 0, speed = 0;                       // of the simulated group, as in DataFacts
  std::int64_t evaluations = 0;                                    // candidates simulated
  std::int64_t simulations = 0;                                    // runs: candidates × replicates, the final ones included
  std::int64_t failed_simulations = 0;                             // blew up
  double failed_final = 0;                                         // share of the final replicates that blew up
  std::string stop_reason;
  int steps = 1;     // per frame
  bool map = false;  // decides once per step: the same model at another step is another one
  bool steps_settled =
      true;  // half the step changes no energy by more than chance, or the fit is far off anyway (fit/experiment/time_step.h)
  double infeasible_avoidance = 0;  // share of final agent-steps without a collision-free velocity
  std::vector<ConvergencePoint> convergence;
  Estimate skill;                       // 1: as close as halves of the recording, 0: no closer than the null; over final replicates
  PerColumn<double> total_variation{};  // mean over single final replicates, of halves against halves: the D of the skill
  PerColumn<double> wasserstein{};      // mean over single final replicates [sd of the recording]
  std::vector<Refutation> refuted_by;   // facts that anybody sees, in the order of PanelFacts
  std::vector<Estimate> panel;          // per item of PanelFacts
  std::vector<Estimate> vacf;           // per lag of PanelFacts
  PosteriorFacts posterior{};
  Tracks film{};  // of the first final replicate, as observed: the frames of Comparison::film
};

// One row of history.csv: a candidate that was simulated.
struct HistoryRow {
  std::size_t model;  // index into the order in which models were named
  int pass;
  std::string phase;      // "search"; "select" and "refine", on seeds of their own; "steps": again, in finer steps; "confirm", "final"
  std::vector<double> x;  // searched parameters, physical units, in table order
  Energies raw{};
  int replicates = 0;  // in these energies: all of the phase, or only the first if it was given up
  int failed = 0;      // replicates that blew up
};

// One pass of the calibration loop.
struct WeightStep {
  int pass;
  PerColumn<double> searched;         // weights that its searches minimised
  PerColumn<double> weights, p1, p2;  // of the energies they found
  double largest_change;              // max |w - w before|
};

// Between which bounds 95 % of the recordings made by one model lie, each bin by itself: shares of the samples. Empty: not known.
struct Band {
  PerColumn<std::vector<double>> lower{}, upper{};
};

struct Comparison {
  std::string command;  // "compare" or "fit"
  std::string version;
  std::uint64_t seed = 0;
  std::string protocol;
  std::vector<std::string> common;  // parameters that were fitted once, with the model named first, and are the same for all
  Budget budget{};
  DataFacts data;
  ObservationFacts observation;
  Binning binning;
  std::vector<Column> columns = columns_at({1});  // of every table below, and of the models
  std::vector<LagFacts> lags;                     // ascending, those without a lag last
  PerColumn<Distribution> recording{};            // the recording's histograms
  PerColumn<double> axis_lower{}, axis_width{};   // of all histograms, physical units
  PerColumn<bool> defined{};
  PerColumn<double> weights{}, p1{}, p2{};
  PerColumn<double> resolution;  // least p2 (fit/compare/facts.h); 0: none, or it cannot be told
  std::vector<WeightStep> weight_history;
  bool mean_weights = true;  // each pass searches under the mean of the weights before it, else under the last
  bool weights_converged = false;
  std::vector<FitResult> models;                   // by rank
  std::vector<std::string> named;                  // canonical names in the order given
  std::vector<std::vector<std::string>> searched;  // names of the searched parameters, per named model
  std::vector<HistoryRow> history;
  SkillFacts skill;
  HoldOutFacts hold_out;
  int laws = 0;                  // recordings made by each fitted model, behind FitResult::certainty; 0: none
  Band band;                     // of the first model
  std::vector<LeftOut> without;  // per model by rank; empty for fewer than three
  PanelFacts panel;
  Tracks film;                                              // the first frames of the recording, as compared (fit/experiment/film.h)
  std::vector<std::string> warnings;                        // sentences a reader must see before believing the table
  std::vector<std::pair<std::string, std::string>> config;  // every resolved flag of the command, name and TOML value, for config.toml
};

}  // namespace swarmfit
