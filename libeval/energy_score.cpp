// SPDX-License-Identifier: MIT
#include "libeval/energy_score.h"

#include <cmath>

namespace swarmfit {
namespace {

double distance(const std::vector<double>& p, const std::vector<double>& q, double worst) {
  if (p.empty() || q.empty()) return p.empty() && q.empty() ? 0 : worst;
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += std::abs(p[i] - q[i]);
  return sum;
}

}  // namespace

Spread spread(const std::vector<Densities>& runs, double worst) {
  const std::size_t columns = runs.empty() ? 0 : runs.front().size();
  Spread out{std::vector<Energies>(runs.size(), Energies(columns, 0.0)), Energies(columns, 0.0)};
  if (runs.size() < 2) return out;
  const auto others = static_cast<double>(runs.size() - 1);
  for (std::size_t j = 0; j < columns; ++j) {
    for (std::size_t a = 0; a < runs.size(); ++a) {
      for (std::size_t b = a + 1; b < runs.size(); ++b) {
        const double d = distance(runs[a][j], runs[b][j], worst) / others;
        out.of[a][j] += d;
        out.of[b][j] += d;
      }
    }
    for (const Energies& one : out.of) out.mean[j] += one[j] / static_cast<double>(runs.size());
  }
  return out;
}

// The mean over pairs is a U-statistic: a run's share in its scatter is twice its own mean distance (Hoeffding 1948).
EnergyScore energy_score(std::vector<Energies> away, const Spread& own) {
  const std::size_t columns = away.front().size();
  EnergyScore out{Energies(columns, 0.0), std::move(away)};
  for (std::size_t j = 0; j < columns; ++j) {
    for (std::size_t r = 0; r < out.runs.size(); ++r) {
      out.value[j] += (out.runs[r][j] - 0.5 * own.mean[j]) / static_cast<double>(out.runs.size());
      out.runs[r][j] += 0.5 * own.mean[j] - own.of[r][j];
    }
  }
  return out;
}

}  // namespace swarmfit
