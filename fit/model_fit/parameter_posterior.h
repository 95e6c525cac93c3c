// SPDX-License-Identifier: MIT
// Which parameters of a model a recording determines, and how well.
#pragma once

#include <string>
#include <vector>

#include "fit/experiment/objective.h"
#include "fit/infer/posterior.h"
#include "fit/model_fit/search_space.h"

namespace swarmfit {

// Root and logarithmic axes spread out what is next to nothing. An interval that keeps away from its bounds there, but not in physical
// units, is one-sided, too.
Identifiability verdict_in_units(const ParameterInterval& interval, double least, double most);

struct ParameterPosterior {
  Posterior posterior;  // on the search's axes
  std::vector<ParameterInterval> parameters;
};

// Frames at the start that no statistic is taken from: a simulation starts with the recorded positions and velocities, but not with what no
// recording shows, such as where its noise field is, and what follows while it settles is none of the recording's doing. The time L / V,
// but at most a third of the recording.
std::int64_t settling_frames(const Conditions& conditions);

// The posterior of the model's searched parameters under a prior that is uniform on the search's axes, between its bounds. Every
// simulation is of one recording with the same individuals and frames, so that it scatters as recordings do. Runs in parallel; a function
// of its arguments, whatever the number of threads.
ParameterPosterior posterior_of(const SearchSpace& space, const Objective& objective, const Rng& rng, const PosteriorOptions& options = {});

}  // namespace swarmfit
