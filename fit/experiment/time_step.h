// SPDX-License-Identifier: MIT
// How finely a model has to be stepped between two frames.
//
// Animals do not move once per frame. A model that stands for continuous motion must be stepped so finely that halving the step changes no
// energy by more than chance; else parameters and rank belong to the step. Noise asks for more than forces do: positions of a particle that
// is kicked n times per frame have second differences of 2/3 + 1/(3 n²) of the variance that one kick would give, and neighbouring ones are
// correlated with (1/6 - 1/(6 n²)) of it. brownian, langevin and bswarm draw the path within a step, too, and so have the exact values with
// any n.
#pragma once

#include "fit/experiment/objective.h"

namespace swarmfit {

// Do all energies agree within so many standard errors of the scatter of single runs, within kUnseen of the worst, or within a tenth of
// themselves? Where both are above a third of the worst, no step brings that metric to the recording, and none is asked for.
inline constexpr double kDifferent = 3;
bool same_energies(const Outcome& one, const Outcome& other, const Target& target, double standard_errors = kDifferent);

// Is the mean of its energies above a third of the worst? Then no step brings the model to the recording.
bool far_off(const Outcome& outcome, const Target& target);

// Seeds on which steps are compared: a few, and more of them where the few show a difference. Of many metrics one often differs by three
// standard errors of a few runs, so on more of them it must be four.
struct StepSeeds {
  std::span<const Rng> few, more;
};

// The fewest steps, from `first` on by doubling, at which one more doubling changes no energy of any of these candidates; `most` times as
// many as are stable at most, kFarSteps times where all candidates are far off. The objective is left with them.
inline constexpr int kMostSteps = 16;
inline constexpr int kFarSteps = 4;
void settle_steps(Objective& objective, const Target& target, const std::vector<std::vector<double>>& candidates, const StepSeeds& seeds,
                  int first, int most = kMostSteps);

}  // namespace swarmfit
