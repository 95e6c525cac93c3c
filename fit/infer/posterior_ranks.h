// SPDX-License-Identifier: MIT
// Are posteriors calibrated? Where the truth was drawn from the prior, its rank in the posterior is uniform: in every coordinate
// (simulation-based calibration: Talts et al. 2018, arXiv:1804.06788), and by distance from a point that has nothing to do with either, in
// all together (tests of accuracy with random points: Lemos et al. 2023, arXiv:2302.03026).
#pragma once

#include <span>

#include "fit/infer/posterior.h"

namespace swarmfit {

// A weighted sample; weights need not sum to 1.
struct WeightedSample {
  std::vector<Point> points;
  std::vector<double> weights;
};

// Share of the weight below the truth in one coordinate, 0 .. 1; NaN without any weight.
double rank_of(const WeightedSample& sample, Eigen::Index coordinate, double truth);

// Share of the weight that lies nearer to the reference than the truth does, 0 .. 1; NaN without any weight.
double nearer_than(const WeightedSample& sample, const Point& reference, const Point& truth);

// Largest distance between the distribution of these numbers and the uniform one on [0, 1]; NaN are left out, none give NaN.
double distance_from_uniform(std::span<const double> values);

// What that distance exceeds in any of so many samples of n uniform numbers in 5 % of cases, at most (Dvoretzky, Kiefer and Wolfowitz;
// Massart 1990; Bonferroni).
double uniform_band(std::size_t n, std::size_t samples);

}  // namespace swarmfit
