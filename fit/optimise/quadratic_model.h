// SPDX-License-Identifier: MIT
// Response surface: a full quadratic fitted by least squares to evaluated points (Box and Wilson 1951), minimised where it was fitted.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fit/optimise/differential_evolution.h"

namespace swarmfit {

// Every cost passed in here is finite.

// 1 + d + d(d+1)/2
constexpr int quadratic_coefficients(int dimensions) { return (dimensions + 1) * (dimensions + 2) / 2; }

// An ellipsoid that tells how far a point is from the centre: distance² = (x - centre)ᵀ (axes axesᵀ)⁻¹ (x - centre).
struct Neighbourhood {
  Point centre;
  Eigen::MatrixXd axes;  // lower triangular
};

// Mean and covariance of the `leaders` cheapest points: follows the shape of a valley and does not depend on how parameters are scaled.
Neighbourhood around_leaders(const std::vector<Evaluated>& points, int leaders);

struct QuadraticModel {
  Point minimum;       // within the cube and within the distance of the farthest fitted point
  double residual_sd;  // with the degrees of freedom taken into account
  double explained;    // share of the variance, 1 - residual variance / variance; at most 1, negative when a constant does better
  int points;          // fitted
};

// Fitted to the `nearest` points of the neighbourhood. Nothing if there are fewer, or too few for a residual, or all cost the same.
std::optional<QuadraticModel> fit_quadratic(const std::vector<Evaluated>& points, const Neighbourhood& around, int nearest);

// Fitted to as many points as a quadratic describes: their number grows from three per coefficient by halves, to all, until the residuals
// become significantly larger (by more than three standard errors) than they were with the best fewer. The more roughness, the wider.
std::optional<QuadraticModel> fit_widest_quadratic(const std::vector<Evaluated>& points, const Neighbourhood& around);

// The same about the cheapest tenth of all points: where the optimum most likely is when costs are rough and the cheapest point a
// lucky one. One more candidate for a comparison on fresh random numbers.
std::optional<QuadraticModel> response_surface(const std::vector<Evaluated>& points);

// One step of Gauss and Newton without derivatives: every part is fitted by a linear function of the `nearest` points of the neighbourhood
// that have parts, and the sum of their squares minimised within the distance of the farthest of these points. It sees which part calls
// for which parameter, and needs d + 2 points where a quadratic needs a number that grows with d² (Cartis, Fiala, Marteau and Roberts
// 2019, doi:10.1145/3338517). Nothing if there are fewer, or all are one point.
std::optional<Point> least_squares_minimum(const std::vector<Evaluated>& points, const Neighbourhood& around, int nearest);

}  // namespace swarmfit
