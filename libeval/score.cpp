// SPDX-License-Identifier: MIT
#include "libeval/score.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "libtrack/nan.h"

namespace swarmfit {
namespace {

bool used(const std::vector<bool>& use, Eigen::Index column) { return use.empty() || use[static_cast<std::size_t>(column)]; }

// e = -1/ln m * sum g ln g of one column with range; 0 ln 0 = 0.
double entropy(const Eigen::VectorXd& x, double p1, double p2) {
  double total = 0;
  for (const double value : x) total += 1 - (value - p1) / p2;
  double sum = 0;
  for (const double value : x) {
    const double g = (1 - (value - p1) / p2) / total;
    if (g > 0) sum += g * std::log(g);
  }
  return -sum / std::log(static_cast<double>(x.size()));
}

// Makes the weights sum to 1; equal over the eligible columns if none has any weight.
void normalise(std::vector<double>& weights, const std::vector<bool>& eligible) {
  double total = 0, count = 0;
  for (std::size_t j = 0; j < weights.size(); ++j) {
    total += weights[j];
    count += eligible[j];
  }
  for (std::size_t j = 0; j < weights.size(); ++j) {
    if (total > 0) weights[j] /= total;
    if (total == 0 && eligible[j]) weights[j] = 1 / count;
  }
}

}  // namespace

Weighting entropy_weights(const Eigen::MatrixXd& energies, const std::vector<bool>& use, const std::vector<double>& resolution) {
  const Eigen::Index models = energies.rows(), metrics = energies.cols();
  if (models == 0 || metrics == 0) throw std::invalid_argument("entropy_weights: the energy table is empty");
  const auto n = static_cast<std::size_t>(metrics);
  if (!use.empty() && use.size() != n) throw std::invalid_argument("entropy_weights: one flag per column is needed");
  if (!resolution.empty() && resolution.size() != n) throw std::invalid_argument("entropy_weights: one resolution per column is needed");

  Weighting out{std::vector<double>(n, 0.0), std::vector<double>(n, kNaN), std::vector<double>(n, kNaN), std::vector<double>(n, kNaN)};
  std::vector<bool> eligible(n, false);
  for (std::size_t j = 0; j < n; ++j) {
    const Eigen::VectorXd x = energies.col(static_cast<Eigen::Index>(j));
    if (!x.allFinite()) continue;
    out.p1[j] = x.minCoeff();
    out.p2[j] = x.maxCoeff() - out.p1[j];
    if (!resolution.empty() && out.p2[j] > 0) out.p2[j] = std::max(out.p2[j], resolution[j]);
    if (models > 1) out.entropy[j] = out.p2[j] > 0 ? entropy(x, out.p1[j], out.p2[j]) : 1;
    eligible[j] = used(use, static_cast<Eigen::Index>(j));
    if (eligible[j] && models > 1) out.weights[j] = 1 - out.entropy[j];
  }
  normalise(out.weights, eligible);
  return out;
}

Weighting initial_weighting(const std::vector<bool>& use, double worst) {
  const std::size_t n = use.size();
  Weighting out{std::vector<double>(n, 0.0), std::vector<double>(n, 0.0), std::vector<double>(n, worst), std::vector<double>(n, kNaN)};
  normalise(out.weights, use);
  return out;
}

double score(const Eigen::VectorXd& energies, const Weighting& weighting) {
  const std::size_t n = weighting.weights.size();
  if (static_cast<std::size_t>(energies.size()) != n) throw std::invalid_argument("score: one energy per weight is needed");
  double loss = 0;
  bool weighted = false;
  for (std::size_t j = 0; j < n; ++j) {
    if (weighting.weights[j] == 0) continue;
    weighted = true;
    const double x = energies[static_cast<Eigen::Index>(j)];
    if (!std::isfinite(x)) return kNaN;
    if (weighting.p2[j] > 0) loss += weighting.weights[j] * (x - weighting.p1[j]) / weighting.p2[j];
  }
  return weighted ? 1 - loss : kNaN;
}

}  // namespace swarmfit
