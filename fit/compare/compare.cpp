// SPDX-License-Identifier: MIT
#include "fit/compare/compare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "fit/compare/certainty.h"
#include "fit/compare/facts.h"
#include "fit/compare/hold_out.h"
#include "fit/compare/judge.h"
#include "fit/compare/refute.h"
#include "fit/compare/sensitivity.h"
#include "fit/compare/skill_warnings.h"
#include "fit/experiment/film.h"
#include "fit/model_fit/calibration.h"
#include "fit/model_fit/fit_result.h"
#include "libtrack/cut.h"
#include "libtrack/error.h"

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

// The comparison in progress: one search per model, and the weights they are judged by.
class Calibration {
 public:
  Calibration(const CompareOptions& options, const Conditions& conditions, const Target& target, const std::vector<bool>& used,
              std::vector<HistoryRow>& history, const OnCompareProgress& on_progress, const Runtime& runtime, const FinalView& view)
      : options_(options), target_(target), used_(used), on_progress_(on_progress) {
    for (std::size_t m = 0; m < options.models.size(); ++m)
      searches_.emplace_back(m, options.models[m], conditions, target, options, history, runtime, view);
  }

  // Par-Est, steps 1 to 5.
  void run(Comparison& result) {
    Weighting searched = initial_weighting(used_, target_.worst());
    weighting_ = searched;
    const int passes = searches_.size() < 2 ? 1 : options_.budget.passes;
    for (int pass = 1; pass <= passes; ++pass) {
      if (pass > 1) exchange();
      for (std::size_t m = 0; m < searches_.size(); ++m)
        searches_[m].pass(pass, searched, [&](std::int64_t simulations, double best) { tell(m, pass, passes, simulations, best); });
      if (searches_.size() < 2) break;
      const Weighting next = entropy_weights(energy_table(searches_), used_, {result.resolution.begin(), result.resolution.end()});
      result.weight_history.push_back(weight_step(pass, searched, next, weighting_));
      weighting_ = next;
      if (result.weight_history.back().largest_change < options_.weight_tolerance) {
        result.weights_converged = true;
        break;
      }
      searched = options_.mean_weights ? mean_weighting(searched, weighting_, pass) : weighting_;
    }
  }

  const std::vector<ModelSearch>& searches() const { return searches_; }
  const Weighting& weighting() const { return weighting_; }

 private:
  // Settings of one model learn from each other.
  void exchange() {
    for (auto& search : searches_)
      for (const auto& other : searches_)
        if (&search != &other && search.space().model().spec == other.space().model().spec) search.suggest(other);
  }

  void tell(std::size_t m, int pass, int passes, std::int64_t simulations, double best) const {
    if (on_progress_)
      on_progress_({options_.models[m].name, m, searches_.size(), pass, passes, simulations, searches_[m].planned(pass), best});
  }

  const CompareOptions& options_;
  const Target& target_;
  const std::vector<bool>& used_;
  const OnCompareProgress& on_progress_;
  std::vector<ModelSearch> searches_;
  Weighting weighting_;
};

template <class T>
std::vector<T> in_order(std::vector<T> values, const std::vector<std::size_t>& order) {
  std::vector<T> out;
  for (const std::size_t k : order) out.push_back(std::move(values[k]));
  return out;
}

// Models and their laws, best first.
void rank(std::vector<FitResult>& models, Laws& laws) {
  std::vector<std::size_t> order(models.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto score = [&](std::size_t k) { return std::isnan(models[k].score) ? -INFINITY : models[k].score; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return score(a) > score(b); });
  models = in_order(std::move(models), order);
  laws.of = in_order(std::move(laws.of), order);
  laws.scatter = in_order(std::move(laws.scatter), order);
  laws.recordings = laws.of.front();
  for (std::size_t k = 0; k < models.size(); ++k) models[k].rank = std::isfinite(models[k].score) ? static_cast<int>(k) + 1 : 0;
}

// What is seen of a final replicate beside its score; of the first one also its scales and the film.
struct View {
  Judged judged;
  Scales scales;
  FilmStrip film;
};
auto fields(View& v) { return std::tie(v.judged, v.scales, v.film); }

void fill_views(FitResult& fit, const std::vector<std::string>& views, const Judge& judge, const Tracks& recording) {
  std::vector<Judged> judged;
  for (const std::string& bytes : views) {
    View view = from_bytes<View>(bytes);
    if (judged.empty()) {
      fit.film = film_of(std::move(view.film), recording);
      fit.extent = view.scales.extent;
      fit.spacing = view.scales.spacing;
      fit.speed = view.scales.speed;
    }
    judged.push_back(std::move(view.judged));
  }
  judge.judge(fit, judged);
}

}  // namespace

Comparison compare(const Tracks& recording, const CompareOptions& options, const OnCompareProgress& on_progress, const Runtime& runtime) {
  check_requests(options.requests, options.models);
  const Halves parts = options.hold_out ? halves(recording) : Halves{};
  Conditions conditions = make_conditions(options.hold_out ? parts.fitted : recording, options.conditions);
  conditions.metrics.lags = lags_for(conditions, options);
  const Target target(recorded_samples(conditions.recording, conditions.metrics), options.binning);

  Comparison result;
  result.observation = observation_facts(conditions, target, options);
  result.resolution = resolution(conditions, target, options, result.observation.drowned);
  const std::vector<bool> used(result.observation.used.begin(), result.observation.used.end());
  result.mean_weights = options.mean_weights;
  PerColumn<bool> clear = result.observation.used;
  for (std::size_t j = 0; j < clear.size(); ++j) clear[j] = clear[j] && !result.observation.drowned[j];
  const FilmSpan span = film_span(conditions.recording, options.models.size() + 1);
  result.film = cut(conditions.recording, span.first, span.last);
  std::optional<Judge> judge;
  const auto view = [&](const Run& run, std::size_t k) {
    return to_bytes(View{judge->look(run), k == 0 ? natural_scales(run.seen) : Scales{}, k == 0 ? strip_of(run.seen, span) : FilmStrip{}});
  };
  Calibration calibration(options, conditions, target, used, result.history, on_progress, runtime, view);
  judge.emplace(conditions, clear, options.seed, runtime);  // computes, so after whatever the searches refuse
  calibration.run(result);

  Laws laws{{}, {}, {}, {options.seed}};
  std::vector<std::vector<Energies>> selections;
  for (std::size_t m = 0; m < options.models.size(); ++m) {
    const auto& search = calibration.searches()[m];
    const auto values = search.space().parameters(search.selected().x);
    result.models.push_back(fit_result(search, calibration.weighting()));
    result.models.back().learns = options.models[m].spec->needs_reference;
    fill_views(result.models.back(), search.selected().views, *judge, conditions.recording);
    if (options.posterior) fill_posterior(result.models.back(), search, Rng{options.seed}.derive(Stream::posterior, m));
    selections.push_back(search.selections());
    laws.of.push_back(law_of(search.objective(), values, {options.seed}, options.laws));
    result.named.push_back(options.models[m].name);
    result.searched.emplace_back();
    for (const auto p : search.space().searched()) result.searched.back().emplace_back(options.models[m].spec->parameters[p].name);
  }
  laws.scatter = search_scatter(selections, calibration.weighting());
  rank(result.models, laws);
  result.laws = options.laws;
  result.band = band_of(laws.of.front(), target);
  fill_certainty(result.models, laws, target, calibration.weighting(), options.budget.final_replicates);
  if (options.hold_out) fill_held_out(result, parts, options, conditions, calibration.weighting(), runtime);
  judge->tell(result);
  result.weights = per_column(calibration.weighting().weights);
  result.p1 = per_column(calibration.weighting().p1);
  result.p2 = per_column(calibration.weighting().p2);
  fill_sensitivity(result);
  fill_facts(result, recording, conditions, target, options);
  for (const auto& warnings : {warnings_of_facts(result), warnings_for(result), warnings_of_skill(result), warnings_of_learning(result)})
    result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
  return result;
}

}  // namespace swarmfit
