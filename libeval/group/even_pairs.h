// SPDX-License-Identifier: MIT
// What g(r) is measured against: pairs of points spread evenly.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace swarmfit {

// Share of the pairs of an even ellipsoid (ellipse) with this covariance [unit²] in each of `bins` bins of `width` [unit] from distance 0
// on. Points are drawn once and for all, the same for everybody.
std::vector<double> even_pairs(const Eigen::Matrix3d& covariance, int dims, double width, std::size_t bins);

}  // namespace swarmfit
