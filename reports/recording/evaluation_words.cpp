// SPDX-License-Identifier: MIT
#include "reports/recording/evaluation_words.h"

#include <fmt/format.h>

#include <cmath>

#include "libeval/lags.h"
#include "reports/comparison/words.h"
#include "reports/write/number.h"
#include "reports/write/unit_text.h"

namespace swarmfit {
namespace {

std::string mean_and_sd(const Moments& m) { return rounded(m.mean) + " ± " + rounded(m.sd()); }

// "speed (energy 0.081)"
std::string metric_text(const Evaluation& e, std::size_t m) {
  const std::string lag = e.columns.size() > kMetrics && e.columns[m].motion() ? fmt::format(" at lag {}", e.columns[m].lag) : "";
  return fmt::format("{}{} (energy {})", e.columns[m].name(), lag, fixed(e.raw_energies[m], 3));
}

}  // namespace

TextRows energy_rows(const Evaluation& e) {
  TextRows out{{"", "metric", "energy", "recording", "simulation", "mean ratio", "sd ratio", "unit"}};
  for (std::size_t m = 0; m < e.columns.size(); ++m) {
    const Column& column = e.columns[m];
    const Moments &real = e.real_distribution[m].moments, &simulated = e.simulated_distribution[m].moments;
    out.push_back({column.symbol(), column.name(), fixed(e.raw_energies[m], 3), mean_and_sd(real), mean_and_sd(simulated),
                   rounded(simulated.mean / real.mean), rounded(simulated.sd() / real.sd()), metric_unit(column.metric, e.real.unit)});
  }
  return out;
}

TextRows order_rows(const Evaluation& e) {
  return {{"mean over frames", "recording", "simulation"},
          {"polarisation", rounded(e.real_order.polarisation), rounded(e.simulated_order.polarisation)},
          {"milling", rounded(e.real_order.milling), rounded(e.simulated_order.milling)},
          {"rms radius [" + e.real.unit + ']', rounded(e.real_order.extent), rounded(e.simulated_order.extent)}};
}

std::string energy_words(const Evaluation& e) {
  return fmt::format("Energy: 0 for the same distribution, {} for disjoint ones.", brief(worst_energy(e.binning)));
}

std::string lag_words(const Evaluation& e) {
  const std::vector<int> lags = lags_of(e.columns);
  return fmt::format("Motion is measured at lag{} {} (frames of {} s).", lags.size() > 1 ? "s" : "", lags_text(lags), brief(e.real.dt));
}

std::string evaluation_sentence(const Evaluation& e) {
  std::size_t nearest = e.columns.size(), farthest = nearest;
  for (std::size_t m = 0; m < e.columns.size(); ++m) {
    if (!std::isfinite(e.raw_energies[m])) continue;
    if (nearest == e.columns.size() || e.raw_energies[m] < e.raw_energies[nearest]) nearest = m;
    if (farthest == e.columns.size() || e.raw_energies[m] > e.raw_energies[farthest]) farthest = m;
  }
  if (nearest == e.columns.size()) return "No metric is defined in both.";
  if (nearest == farthest) return fmt::format("Compared in one metric: {}.", metric_text(e, nearest));
  return fmt::format("Most similar in {}, least similar in {}.", metric_text(e, nearest), metric_text(e, farthest));
}

}  // namespace swarmfit
