// SPDX-License-Identifier: MIT
// Which models cannot be told from the best? The model confidence set (Hansen, Lunde and Nason 2011, Econometrica 79:453,
// doi:10.3982/ECTA5771), with the range statistic T_R: it controls the error over all models at once, where pairwise tests would not.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace swarmfit {

// scores: one per model, higher is better. draws: draw × model, scores that the same models get on other recordings; only their scatter is
// used, so about what value they scatter does not matter. Rows with anything that is not finite are passed over.
struct ScoreDraws {
  Eigen::VectorXd scores;
  Eigen::MatrixXd draws;
};

// p of each model in [0, 1]: models with p > alpha are the confidence set at 1 - alpha. The model that is last to leave has 1. NaN for a
// model without a score, and for all where fewer than two draws are finite.
std::vector<double> confidence_set_p(const ScoreDraws&);

// The confidence set is group 1; that of the others is group 2; and so on. 0 where p is NaN.
std::vector<int> confidence_groups(const ScoreDraws&, double alpha);

}  // namespace swarmfit
