// SPDX-License-Identifier: MIT
// How much of a ranking is due to who else was ranked.
#pragma once

#include "libeval/score.h"

namespace swarmfit {

// The comparison without one model: entropy weights and scores of the others from the same energies.
struct WithoutOne {
  Eigen::Index dropped;             // row of the energy table
  Weighting weighting;              // of the remaining rows
  std::vector<double> scores;       // one per row of the full table; NaN for the dropped one, or where undefined
  std::vector<Eigen::Index> order;  // the remaining rows, best first; equal scores keep their order, undefined ones come last
};

// Drops each row of the energy table in turn. `use` and `resolution` as in entropy_weights. Empty for fewer than three models: with one
// left there is nothing to rank.
std::vector<WithoutOne> leave_one_out(const Eigen::MatrixXd& energies, const std::vector<bool>& use = {},
                                      const std::vector<double>& resolution = {});

}  // namespace swarmfit
