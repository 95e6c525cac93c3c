// SPDX-License-Identifier: MIT
// What a recording is, and how models were held against it: everything that is known of a comparison before any model is.
#pragma once

#include <string>
#include <vector>

#include "fit/results/estimate.h"
#include "fit/results/force_curves.h"
#include "libeval/group/pictures.h"
#include "libeval/panel.h"
#include "libeval/timeline.h"
#include "libtrack/nan.h"
#include "libtrack/tracks.h"

namespace swarmfit {

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
  std::string arena;                                 // as --arena takes it, or which file tells
  int unseen = 0;                                    // individuals simulated beside the tracked ones (--population)
  std::string error_source;                          // "estimate", "given", "none"
  Eigen::Array3d sigma = Eigen::Array3d::Zero();     // localisation error per axis [unit]
  bool white = true;                                 // the estimate is consistent with white error
  Eigen::Array3d rounding = Eigen::Array3d::Zero();  // to which positions are rounded on both sides, per axis [unit]; 0: not
  double smoothing = 0;                              // standard deviation of the Gaussian smoothing of both sides [frames]; 0: none
  std::string velocity;                              // "difference" or "recorded"
  PerColumn<double> independent{};                   // effective sample size of each column (libeval/independent.h); NaN undefined
  PerColumn<double> error_share{};                   // share of each column's variance that is localisation error; NaN unknown
  PerColumn<bool> error_dominated{};                 // more of it is error than CompareOptions::error_limit
  PerColumn<bool> used{};                            // is the column in the default score?
  PerColumn<std::string> why_not{};                  // the reason where it is not
  int longest_lag = 1;                               // that the recording carries (libeval/lags.h) [frames]
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
  SkillNull null_of = SkillNull::none;         // which null the scale has
  double mean_floor = kNaN, mean_null = kNaN;  // over the used columns; the null is the one of the scale
  double mean_floor_sd = kNaN;                 // of mean_floor, over the choices of halves
  Estimate walker;                             // skill of the random walk; 0 where it is the null, NaN where no column of motion is used
  double memory_p = kNaN;                      // over the used columns of motion: is the recording like a random walk of its own steps?
  double interaction_p[2] = {kNaN, kNaN};      // of d and eta: is the recording like its own tracks shifted in time?
  int surrogates = 0;                          // behind memory_p and interaction_p, each
};

// What was measured beside the metrics (libeval/panel.h), and what the recording says.
struct PanelFacts {
  std::vector<PanelItem> items;
  std::vector<Estimate> recording;       // per item; standard error over blocks of time
  std::vector<double> lags;              // of the velocity autocorrelation [s]
  std::vector<Estimate> recording_vacf;  // per lag
};

// What the recording looks like (libeval/group/pictures.h), and on which grid models do as well.
struct PictureFacts {
  PictureGrid grid;
  Pictures recording;
  Timeline timeline;
};

// One half fitted, the other scored: first and last frames of each, and what was chosen by the fitted one.
struct HeldOutWay {
  std::int64_t fitted_first = 0, fitted_last = 0, held_first = 0, held_last = 0;
  std::vector<Column> columns;
  PerColumn<double> weights{};  // of the columns
};

// How models were scored on what they were not fitted to. Without ways they were not.
struct HoldOutFacts {
  std::vector<HeldOutWay> ways;
  std::int64_t warm_up = 0;  // frames at the start of every run that no score counts
  int searches = 1;          // of each half
  bool used() const { return !ways.empty(); }
};

// A recording under the conditions of a comparison. All tables have one entry per column.
struct RecordingFacts {
  DataFacts data;
  ObservationFacts observation;
  Binning binning;
  std::vector<Column> columns = columns_at({1});
  PerColumn<Distribution> distributions{};
  PerColumn<double> axis_lower{}, axis_width{};  // of all histograms, physical units
  PerColumn<bool> defined{};
  PerColumn<double> resolution;  // least p2 (fit/compare/facts.h); 0: none, or it cannot be told
  SkillFacts skill;
  PanelFacts panel;
  PictureFacts pictures;
  ForceFacts forces;
  HoldOutFacts hold_out;
};

}  // namespace swarmfit
