// SPDX-License-Identifier: MIT
#include "fit/compare/calibration.h"

#include <algorithm>
#include <cmath>

namespace swarmfit {
namespace {

Eigen::MatrixXd energy_table(const std::vector<ModelSearch>& searches) {
  const auto columns = static_cast<Index>(searches.front().selected().outcome.raw.size());
  Eigen::MatrixXd table(static_cast<Index>(searches.size()), columns);
  for (std::size_t m = 0; m < searches.size(); ++m)
    table.row(static_cast<Index>(m)) = Eigen::Map<const Eigen::RowVectorXd>(searches[m].selected().outcome.raw.data(), columns);
  return table;
}

PerColumn<double> per_column(const std::vector<double>& values) {
  PerColumn<double> out(values.size());
  std::copy(values.begin(), values.end(), out.begin());
  return out;
}

// Step 3 and 4 of Par-Est: weights and p1, p2 from the energy table; how far did the weights move?
WeightStep weight_step(int pass, const Weighting& searched, const Weighting& now, const Weighting& before) {
  double change = 0;
  for (std::size_t j = 0; j < now.weights.size(); ++j) change = std::max(change, std::abs(now.weights[j] - before.weights[j]));
  return {pass, per_column(searched.weights), per_column(now.weights), per_column(now.p1), per_column(now.p2), change};
}

// What the next pass minimises: the last table's p1 and p2, and the mean of the weights of all passes and those before the first, which
// `searched` holds but for the last. Under the last weights alone all models fit what told them apart, become alike in it, neglect it in
// the next pass, and so on in turns.
Weighting mean_weighting(const Weighting& searched, Weighting last, int pass) {
  for (std::size_t j = 0; j < last.weights.size(); ++j)
    last.weights[j] = searched.weights[j] + (last.weights[j] - searched.weights[j]) / (pass + 1);
  return last;
}

}  // namespace

Calibration::Calibration(const CompareOptions& options, const Conditions& conditions, const Target& target, const PerColumn<bool>& used,
                         const OnCompareProgress& on_progress, const Runtime& runtime, const FinalView& view)
    : options_(options), target_(target), used_(used.begin(), used.end()), on_progress_(on_progress) {
  for (std::size_t m = 0; m < options.models.size(); ++m)
    searches_.emplace_back(m, options.models[m], conditions, target, options, history_, runtime, view);
}

CalibrationFacts Calibration::run(const PerColumn<double>& resolution) {
  CalibrationFacts out;
  out.mean_weights = options_.mean_weights;
  Weighting searched = initial_weighting(used_, target_.worst());
  weighting_ = searched;
  const int passes = searches_.size() < 2 ? 1 : options_.budget.passes;
  for (int pass = 1; pass <= passes && !out.weights_converged; ++pass) {
    if (pass > 1 && !options_.evolution_only) exchange();
    for (std::size_t m = 0; m < searches_.size(); ++m)
      searches_[m].pass(pass, searched, [&](std::int64_t simulations, double best) { tell(m, pass, passes, simulations, best); });
    if (searches_.size() < 2) break;
    const Weighting next = entropy_weights(energy_table(searches_), used_, {resolution.begin(), resolution.end()});
    out.weight_history.push_back(weight_step(pass, searched, next, weighting_));
    weighting_ = next;
    out.weights_converged = out.weight_history.back().largest_change < options_.weight_tolerance;
    searched = options_.mean_weights ? mean_weighting(searched, weighting_, pass) : weighting_;
  }
  out.weights = per_column(weighting_.weights);
  out.p1 = per_column(weighting_.p1);
  out.p2 = per_column(weighting_.p2);
  return out;
}

void Calibration::exchange() {
  for (auto& search : searches_)
    for (const auto& other : searches_)
      if (&search != &other && search.space().model().spec == other.space().model().spec) search.suggest(other);
}

void Calibration::tell(std::size_t m, int pass, int passes, std::int64_t simulations, double best) const {
  if (on_progress_)
    on_progress_({options_.models[m].name, m, searches_.size(), pass, passes, simulations, searches_[m].planned(pass), best});
}

}  // namespace swarmfit
