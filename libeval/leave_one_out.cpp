// SPDX-License-Identifier: MIT
#include "libeval/leave_one_out.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libtrack/nan.h"

namespace swarmfit {

std::vector<WithoutOne> leave_one_out(const Eigen::MatrixXd& energies, const std::vector<bool>& use,
                                      const std::vector<double>& resolution) {
  const Eigen::Index models = energies.rows();
  std::vector<WithoutOne> out;
  if (models < 3) return out;
  for (Eigen::Index dropped = 0; dropped < models; ++dropped) {
    WithoutOne w{dropped, {}, std::vector<double>(static_cast<std::size_t>(models), kNaN), {}};
    Eigen::MatrixXd rest(models - 1, energies.cols());
    rest << energies.topRows(dropped), energies.bottomRows(models - 1 - dropped);
    w.weighting = entropy_weights(rest, use, resolution);
    for (Eigen::Index row = 0; row < models; ++row) {
      if (row == dropped) continue;
      w.scores[static_cast<std::size_t>(row)] = score(energies.row(row).transpose(), w.weighting);
      w.order.push_back(row);
    }
    const auto value = [&](Eigen::Index row) {
      const double s = w.scores[static_cast<std::size_t>(row)];
      return std::isfinite(s) ? s : -std::numeric_limits<double>::infinity();
    };
    std::stable_sort(w.order.begin(), w.order.end(), [&](Eigen::Index a, Eigen::Index b) { return value(a) > value(b); });
    out.push_back(std::move(w));
  }
  return out;
}

}  // namespace swarmfit
