// SPDX-License-Identifier: MIT
// What a recording says about parameters: a sample of their posterior distribution, and intervals.
//
// Approximate Bayesian computation (ABC): parameters are drawn, a recording is simulated from each, and those whose simulations look like
// the observed recording are kept. Three things make some two thousand simulations enough:
//   - statistics are learned: for every coordinate the ridge regression on all features, predicted by a fit that has not seen the
//   simulation
//     (semi-automatic ABC, Fearnhead and Prangle 2012, doi:10.1111/j.1467-9868.2011.01010.x). Not seen, since with a hundred features
//     regressions look far better on what they were fitted to than on the recording;
//   - what is kept is moved to where it would lie had it looked exactly like the recording, by a local linear regression with residuals
//     rescaled (Beaumont et al. 2002; Blum and François 2010, doi:10.1007/s11222-009-9116-0), on a logistic scale: nothing leaves the box;
//   - rounds draw from an ever smaller box. Within it the prior stays uniform, so nothing must be reweighted, and earlier simulations that
//     lie in it count again (truncated proposals: Deistler et al. 2022, arXiv:2210.04815).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "fit/optimise/differential_evolution.h"
#include "fit/results/interval.h"
#include "libtrack/rng.h"

namespace swarmfit {

// A part of the unit cube.
struct Box {
  Point lower, upper;
  double volume() const;
};

// A simulation to be made.
struct Draw {
  Point x;
  Rng rng;
};

// Features of each simulated recording, as many as the observed ones, or nothing if the simulation blew up; one with a feature that is not
// finite counts as blown up, too. A function of its argument alone.
using Simulator = std::function<std::vector<std::optional<Eigen::VectorXd>>(const std::vector<Draw>&)>;

struct PosteriorOptions {
  int rounds = 5;
  int simulations = 360;  // per round
  double kept = 0.2;      // share of the simulations in the box
};

struct PosteriorRound {
  int simulations = 0;
  int blew_up = 0;    // of these
  int in_box = 0;     // of all so far, finished
  int kept = 0;       // of those
  double volume = 1;  // of the box that was drawn from
};

// One coordinate.
struct Marginal {
  double median = 0.5, lower = 0.025, upper = 0.975;  // ends of the central 95 % interval
  double contraction = 0;                             // 1 - variance / variance of the prior
  Identifiability verdict = Identifiability::flat;
  int partner = -1;  // the coordinate with the strongest correlation, and that; -1: there is no other
  double correlation = 0;
};

struct Posterior {
  std::vector<Point> sample;   // in the cube; empty if next to nothing ended well, and marginals are then the prior's
  std::vector<double> weight;  // sums to 1
  double effective = 0;        // effective sample size, 1 / sum of squared weights (Kong 1992)
  std::vector<Marginal> marginals;
  std::vector<PosteriorRound> rounds;
};

// The posterior under a uniform prior on the unit cube – on `start`, if there is one –, from rounds × simulations runs. A function of its
// arguments, whatever the number of threads. Features are standardised here, and constant ones dropped; they should be finite, near normal
// and have a spread that does not depend on parameters much: logarithms of scales, square roots of shares. Throws std::invalid_argument if
// observed features are not finite.
Posterior posterior(const Eigen::VectorXd& observed, int dimensions, const Simulator& simulator, const Rng& rng,
                    const PosteriorOptions& options = {}, const Box* start = nullptr);

// Value below which a share p of the weight lies, by linear interpolation; p in [0, 1]. With equal weights the k-th of n values is the
// quantile k / (n + 1): a new draw from the same distribution is as likely to fall into any gap.
double weighted_quantile(const std::vector<double>& values, const std::vector<double>& weights, double p);

}  // namespace swarmfit
