// SPDX-License-Identifier: MIT
// What a fit of one model found.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fit/results/estimate.h"
#include "fit/results/force_curves.h"
#include "libeval/energy.h"
#include "libeval/group/pictures.h"
#include "libeval/panel.h"
#include "libtrack/nan.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// What the recording says about a parameter beside its best value (fit/model_fit/parameter_posterior.h), in physical units.
struct ParameterUncertainty {
  double median = kNaN, lower = kNaN, upper = kNaN;  // posterior, ends of the central 95 %; NaN: not asked for, or not searched
  double contraction = kNaN;                         // 1 - variance / variance of the prior, on the axis of the search
  std::string verdict;                               // "identified", "one-sided", "flat"; empty: as above
  std::string partner;                               // the parameter with the strongest correlation, and that; empty: there is no other
  double correlation = kNaN;
};

// Its value by another way than the search, and 95 % interval, in physical units; NaN: not known.
struct SecondOpinion {
  double value = kNaN, lower = kNaN, upper = kNaN;
};

struct ParameterResult {
  std::string name, symbol, unit, meaning;
  double value = 0, lower = 0, upper = 0;  // physical units; lower = upper = value where it was not searched
  bool fitted = false, log = false;
  bool at_bound = false;   // within 1 % of the searched interval from a bound
  std::string at_lower{};  // of the lower one, what that means, if anything
  ParameterUncertainty posterior{};
  bool interaction = false;    // of neighbours: used only with the model's interaction, or a length in neighbour distances
  SecondOpinion likelihood{};  // of maximum likelihood (fit/model_fit/likelihood.h)
  SecondOpinion regression{};  // by regression of accelerations (fit/model_fit/regression.h)
  double halves_lower = kNaN, halves_upper = kNaN;  // smallest and largest value of the fits to halves (fit/compare/hold_out.h)
};

// Behind the uncertainty of a model's parameters.
struct PosteriorFacts {
  std::vector<std::vector<double>> sample{};  // searched parameters in table order, physical units
  std::vector<double> weight{};               // sums to 1
  double effective = kNaN;                    // effective sample size
  int simulations = 0, blew_up = 0;           // 0: no posterior
};

// Of a model that has a likelihood, at its maximum; NaN: not asked for, or it has none.
struct LikelihoodFacts {
  double log_likelihood = kNaN;
  double error = kNaN;  // localisation error that it asks for, in the mean over the axes [unit]
};

// Of a regression of accelerations.
struct RegressionFacts {
  Index rows = 0;     // accelerations that were used; 0: not asked for, or the model has no forces, or it did not converge
  double memory = 0;  // of the noise [s]; 0: none was found
};

// One point of a convergence curve.
struct ConvergencePoint {
  int pass;                  // of the calibration loop, from 1
  std::int64_t evaluations;  // of this model so far, all passes
  double best;               // best score so far, with the weights of that pass
};

// How the parameters were found.
struct SearchFacts {
  std::int64_t evaluations = 0;         // candidates simulated
  std::int64_t simulations = 0;         // runs: candidates × replicates, the final ones included
  std::int64_t failed_simulations = 0;  // blew up
  std::string stop_reason;
  std::vector<ConvergencePoint> convergence;
};

// What the final replicates came to: runs of the chosen parameters, on seeds that had no part in choosing them.
struct FinalRuns {
  Energies raw_energies{};                     // over the pooled replicates
  Energies raw_se{};                           // standard errors of the mean of single replicates
  std::vector<Energies> replicate_energies;    // raw, one per replicate
  Energies half_step_energies{};               // raw, at half the time step, same number of replicates
  PerColumn<Distribution> distributions{};     // pooled, on the recording's axes
  PerColumn<double> mean_ratio{}, sd_ratio{};  // simulation / recording
  PerColumn<double> outside_fraction{};        // share of the samples beyond the recording's axes
  double failed_final = 0;                     // share of the replicates that blew up
  double infeasible_avoidance = 0;             // share of agent-steps without a collision-free velocity
  int steps = 1;                               // per frame
  bool map = false;                            // decides once per step: the same model at another step is another one
  // Half the step changes no energy by more than chance, or the fit is far off anyway (fit/experiment/time_step.h).
  bool steps_settled = true;
};

// A model's score when the weight of one column is dropped or doubled, and its rank when it is dropped.
struct Sensitivity {
  PerColumn<double> without{}, doubled{};
  PerColumn<int> rank_without{};
};

// How sure the place of a model is, from recordings made by the fitted models (fit/compare/certainty.h).
struct Certainty {
  double gof_p = kNaN;                          // share of recordings made by this fit that are as far from it as the recording is
  double gof_q = kNaN;                          // the same, adjusted for the number of models (libeval/false_discovery.h)
  int group = 0;                                // models of one group cannot be told apart, the best are group 1; 0: cannot be told
  double set_p = kNaN;                          // p at which the model leaves the model confidence set of all
  double lower = kNaN, upper = kNaN;            // of the score, 95 %, over recordings as long as this one
  double lead_lower = kNaN, lead_upper = kNaN;  // of the first model's lead, 95 %
  Energies own{};                               // mean raw energies of its own recordings: what a perfect model would have
};

// Does a model's motion repeat that of the half it was fitted to? Median distances of paths to the nearest path of that half
// (libeval/nearness.h).
struct Nearness {
  double simulated = kNaN, recorded = kNaN;  // of the model's paths, and of the held-out ones [unit]
  std::int64_t frames = 0;                   // length of the paths
  double ratio() const { return simulated / recorded; }
};

// A model on the halves of the recording that it was not fitted to (fit/compare/hold_out.h).
struct HeldOut {
  std::vector<double> scores;    // per way of HoldOutFacts, means over its searches; their mean is Standing::score
  double search_sd = kNaN;       // how much the score scatters between searches of the same half; NaN: there was one
  double gof_p = kNaN;           // as Certainty::gof_p, of the recordings of both halves
  std::int64_t simulations = 0;  // runs, beside those of SearchFacts
  Nearness nearness{};           // mean of both ways
};

// The score of the fit to the whole recording, on that recording.
struct InSample {
  int rank = 0;            // by this score; 0 if it is undefined
  double score = kNaN;     // E, with the comparison's weights
  double score_se = kNaN;  // standard error of the mean score of single final replicates; NaN if undefined
  int group = 0;           // as in Certainty, of this score
  double lower = kNaN, upper = kNaN;
};

// Where a model stands among those it was compared with.
struct Standing {
  int rank = 0;           // 1 is best; 0 if the score is undefined
  double score = kNaN;    // what decides, higher is better: of the halves that were not fitted, or else in sample
  Certainty certainty{};  // of that score; goodness and own energies are of the fit to the whole recording
  InSample in_sample{};
  Energies energies{};  // (raw - p1)/p2 of the fit to the whole recording, 0 where p2 = 0
  Sensitivity sensitivity{};
  HeldOut held_out{};
};

// A fact that anybody sees and that a fitted model gets wrong (fit/compare/refute.h).
struct Refutation {
  PanelItem item;
  Estimate recording;              // NaN: it has no such number
  double model = kNaN, sd = kNaN;  // over its single final replicates; NaN: none has
};

// How a model looks beside the recording, whoever else is compared.
struct Likeness {
  Estimate skill;                             // 1: as close as halves of the recording, 0: no closer than the null; over final replicates
  PerColumn<double> total_variation{};        // mean over single final replicates, of halves against halves: the D of the skill
  PerColumn<double> wasserstein{};            // mean over single final replicates [sd of the recording]
  std::vector<Refutation> refuted_by;         // facts that anybody sees, in the order of PanelFacts
  std::vector<Estimate> panel;                // per item of PanelFacts
  std::vector<Estimate> vacf;                 // per lag of PanelFacts
  double extent = 0, spacing = 0, speed = 0;  // of the simulated group, as in DataFacts
  PictureSpread pictures{};                   // over single final replicates, on the grid of PictureFacts
  ForceSpread forces{};                       // on the grid of ForceFacts
};

// Everything about one model in a comparison (or the only one of a fit).
struct ModelFit {
  std::string model;  // canonical name with settings: "bswarm[noise=white]"
  std::string summary, citation;
  std::map<std::string, std::string> options;  // complete
  std::vector<ParameterResult> parameters;     // the whole table, unused rows left out
  bool learns = false;                         // takes its motion from the recording, as fastswarm does
  PosteriorFacts posterior{};
  LikelihoodFacts likelihood{};
  RegressionFacts regression{};
  SearchFacts search;
  FinalRuns runs;
  Standing standing;
  Likeness likeness;
  Tracks film{};  // of the first final replicate, as observed: the frames of Comparison::film
};

}  // namespace swarmfit
