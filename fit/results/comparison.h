// SPDX-License-Identifier: MIT
// A comparison in its parts: plain values with every number a report needs. Written to disk by reports/.
#pragma once

#include "fit/results/model_fit.h"
#include "fit/results/ranking.h"
#include "fit/results/recording_facts.h"
#include "fit/results/run_record.h"
#include "fit/results/scenery.h"
#include "fit/results/warning.h"

namespace swarmfit {

struct Comparison {
  RunRecord run;
  RecordingFacts recording;
  Ranking ranking;
  std::vector<ModelFit> models;   // by rank
  Tracks film;                    // the first frames of the recording, as compared (fit/experiment/film.h)
  Scenery around = {};            // what surrounds everybody in the films
  std::vector<Warning> warnings;  // gravest first
};

}  // namespace swarmfit
