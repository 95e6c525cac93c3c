// SPDX-License-Identifier: MIT
// Entropy weights and the weighted score (Ren et al. 2016, Eq 6, Eq 8 and the entropy method of Zou et al. 2006).
#pragma once

#include <Eigen/Core>
#include <vector>

namespace swarmfit {

// Everything the energy table of m models (rows) and n metrics (columns) determines.
struct Weighting {
  std::vector<double> weights;  // w_j, sum 1
  std::vector<double> p1, p2;   // per column: smallest energy, and largest minus smallest, or the resolution if that is more
  std::vector<double> entropy;  // e_j in [0, 1]; NaN for m = 1
};

// x' = (x - p1)/p2 (0 when p2 = 0); r = 1 - x'; g = r / sum r; e_j = -1/ln m * sum g ln g; w_j = (1 - e_j)/sum(1 - e_j).
// A column without range has weight 0; if none has range, or m = 1, weights are equal. Columns with `use` false get weight 0, their p1, p2
// and entropy are still told. A column with a NaN gets weight 0, and NaN for the rest. No usable column: no weights at all.
// `resolution`: per column, the difference of energies that the recording can tell (empty: any). p2 is at least that, where the paper's is
// the range alone: without it a column in which all models are alike is stretched to [0, 1] and decides by its noise.
// Throws std::invalid_argument without rows or columns, or if `use` or `resolution` is neither empty nor one per column.
Weighting entropy_weights(const Eigen::MatrixXd& energies, const std::vector<bool>& use = {}, const std::vector<double>& resolution = {});

// The start of the calibration loop: equal weights over the used columns, p1 = 0, p2 = worst.
Weighting initial_weighting(const std::vector<bool>& use, double worst);

// E = 1 - sum_j w_j (x_j - p1_j)/p2_j; higher is better. A term with p2 = 0 counts 0. NaN if an energy with weight is NaN, or if
// there is no weight at all.
double score(const Eigen::VectorXd& energies, const Weighting& weighting);

}  // namespace swarmfit
