// SPDX-License-Identifier: MIT
#include "fit/compare/across.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "libtrack/distributions.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

const ModelFit& of(const Comparison& c, const std::string& model) {
  return *std::find_if(c.models.begin(), c.models.end(), [&](const ModelFit& r) { return r.model == model; });
}

template <class Values>
double mean_of_defined(const Values& values, bool (*defined)(typename Values::value_type)) {
  double sum = 0, n = 0;
  for (const auto value : values)
    if (defined(value)) sum += static_cast<double>(value), ++n;
  return n > 0 ? sum / n : kNaN;
}

ModelAcross model_across(std::span<const Comparison> comparisons, const std::string& name) {
  ModelAcross m;
  m.model = name;
  for (const Comparison& c : comparisons) {
    const ModelFit& fit = of(c, name);
    m.score.push_back(fit.standing.score);
    m.rank.push_back(fit.standing.rank);
    m.wins += fit.standing.rank == 1;
  }
  m.mean_score = mean_of_defined(
      m.score, +[](double x) { return std::isfinite(x); });
  m.mean_rank = mean_of_defined(
      m.rank, +[](int rank) { return rank > 0; });
  return m;
}

// Lags may be chosen by the recording, so not all have the same columns.
std::vector<Column> all_columns(std::span<const Comparison> comparisons) {
  std::set<int> lags;
  for (const Comparison& c : comparisons)
    for (const int lag : lags_of(c.recording.columns)) lags.insert(lag);
  return columns_at({lags.begin(), lags.end()});
}

PerColumn<double> weights_of(const Comparison& c, const std::vector<Column>& columns) {
  PerColumn<double> out(columns.size(), kNaN);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const auto at = std::find(c.recording.columns.begin(), c.recording.columns.end(), columns[j]);
    if (at != c.recording.columns.end()) out[j] = c.ranking.weights[static_cast<std::size_t>(at - c.recording.columns.begin())];
  }
  return out;
}

void summarise_weights(Across& a) {
  a.mean_weight = a.smallest_weight = a.largest_weight = PerColumn<double>(a.columns.size(), kNaN);
  for (std::size_t j = 0; j < a.columns.size(); ++j) {
    std::vector<double> w;
    for (const auto& weights : a.weights)
      if (std::isfinite(weights[j])) w.push_back(weights[j]);
    if (w.empty()) continue;
    a.mean_weight[j] = mean_of_defined(
        w, +[](double x) { return std::isfinite(x); });
    a.smallest_weight[j] = *std::min_element(w.begin(), w.end());
    a.largest_weight[j] = *std::max_element(w.begin(), w.end());
  }
}

// The first has no lead over itself.
void fill_leads(std::vector<ModelAcross>& models) {
  for (std::size_t m = 1; m < models.size(); ++m) {
    std::vector<double> leads;
    for (std::size_t k = 0; k < models[m].score.size(); ++k) leads.push_back(models.front().score[k] - models[m].score[k]);
    models[m].lead = mean_over_recordings(leads, kAlpha / static_cast<double>(models.size() - 1));
  }
}

}  // namespace

MeanOverRecordings mean_over_recordings(std::span<const double> values, double alpha) {
  Moments moments;
  for (const double value : values)
    if (std::isfinite(value)) moments.add(value);
  if (moments.count == 0) return {};
  MeanOverRecordings out{moments.mean};
  if (moments.count < 2) return out;
  const double half = student_t_above(alpha / 2, static_cast<double>(moments.count - 1)) * moments.standard_error();
  out.lower = out.mean - half;
  out.upper = out.mean + half;
  return out;
}

Across across(std::span<const Comparison> comparisons) {
  Across out;
  if (comparisons.empty()) return out;
  out.columns = all_columns(comparisons);
  for (const Comparison& c : comparisons) {
    out.recordings.push_back(c.recording.data.path);
    out.weights.push_back(weights_of(c, out.columns));
  }
  summarise_weights(out);
  for (const std::string& name : comparisons.front().run.named) out.models.push_back(model_across(comparisons, name));
  std::stable_sort(out.models.begin(), out.models.end(), [](const ModelAcross& a, const ModelAcross& b) {
    const auto last = [](double x) { return std::isfinite(x) ? x : INFINITY; };
    if (last(a.mean_rank) != last(b.mean_rank)) return last(a.mean_rank) < last(b.mean_rank);
    return a.mean_score > b.mean_score;
  });
  fill_leads(out.models);
  return out;
}

}  // namespace swarmfit
