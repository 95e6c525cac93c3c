// SPDX-License-Identifier: MIT
#include "fit/compare/compare.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fit/compare/certainty.h"
#include "fit/compare/facts.h"
#include "fit/compare/hold_out.h"
#include "fit/compare/judge.h"
#include "fit/compare/rank.h"
#include "fit/compare/refute.h"
#include "fit/compare/sensitivity.h"
#include "fit/compare/skill_warnings.h"
#include "fit/compare/without_one.h"
#include "fit/experiment/film.h"
#include "fit/experiment/scenery.h"
#include "fit/model_fit/calibration.h"
#include "fit/model_fit/model_fit_of.h"
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

  // Par-Est, steps 1 to 5. What the models are ranked by.
  Ranking run(const PerColumn<double>& resolution) {
    Ranking out;
    out.mean_weights = options_.mean_weights;
    Weighting searched = initial_weighting(used_, target_.worst());
    weighting_ = searched;
    const int passes = searches_.size() < 2 ? 1 : options_.budget.passes;
    for (int pass = 1; pass <= passes && !out.weights_converged; ++pass) {
      if (pass > 1 && !options_.genetic_only) exchange();
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

// What is seen of a final replicate beside its score; of the first one also its scales and the film.
struct View {
  Judged judged;
  Scales scales;
  FilmStrip film;
};
auto fields(View& v) { return std::tie(v.judged, v.scales, v.film); }

// What a model looks like, from what was seen of its final replicates.
void add_likeness(ModelFit& fit, const std::vector<std::string>& views, const Judge& judge, const Tracks& recording) {
  std::vector<Judged> judged;
  Scales scales;
  for (const std::string& bytes : views) {
    View view = from_bytes<View>(bytes);
    if (judged.empty()) {
      fit.film = film_of(std::move(view.film), recording);
      scales = view.scales;
    }
    judged.push_back(std::move(view.judged));
  }
  fit.likeness = judge.likeness(judged);
  fit.likeness.extent = scales.extent;
  fit.likeness.spacing = scales.spacing;
  fit.likeness.speed = scales.speed;
}

RunRecord run_record(const CompareOptions& options) {
  RunRecord out;
  out.command = options.models.size() > 1 ? "compare" : "fit";
  out.seed = options.seed;
  out.protocol = options.protocol;
  out.common = options.common;
  out.budget = options.budget;
  for (const ModelChoice& model : options.models) out.named.push_back(model.name);
  return out;
}

std::vector<std::string> searched_names(const SearchSpace& space) {
  std::vector<std::string> out;
  for (const std::size_t row : space.searched()) out.emplace_back(space.model().spec->parameters[row].name);
  return out;
}

// What a ranking says of its models, and of itself, once they are ranked.
void add_standings(Comparison& result, const Laws& laws, const Target& target, const Weighting& weighting, int pooled) {
  std::vector<ModelFit>& models = result.models;
  std::vector<Energies> energies;
  for (const ModelFit& fit : models) energies.push_back(fit.standing.energies);
  const auto sure = certainties(scored(models), laws, target, weighting, pooled);
  const auto sensitive = sensitivities(energies, result.ranking.weights);
  for (std::size_t k = 0; k < models.size(); ++k) {
    models[k].standing.certainty = sure[k];
    models[k].standing.sensitivity = sensitive[k];
  }
  Ranking& ranking = result.ranking;
  ranking.lags = lag_facts(result.recording, ranking.weights);
  ranking.laws = static_cast<int>(laws.recordings.size());
  ranking.band = band_of(laws.recordings, target);
  ranking.without = without_each(models, result.recording);
  ranking.walk_suffices = walk_suffices(result.recording.skill, models);
}

// Columns of the score that are not mostly localisation error: on those the skill rests.
PerColumn<bool> clear_columns(const ObservationFacts& o) {
  PerColumn<bool> out = o.used;
  for (std::size_t j = 0; j < out.size(); ++j) out[j] = out[j] && !o.drowned[j];
  return out;
}

}  // namespace

Comparison compare(const Tracks& recording, const CompareOptions& options, const OnCompareProgress& on_progress, const Runtime& runtime) {
  check_requests(options.requests, options.models);
  const Halves parts = options.hold_out ? halves(recording) : Halves{};
  Conditions conditions = make_conditions(options.hold_out ? parts.fitted : recording, options.conditions);
  conditions.metrics.lags = lags_for(conditions, options);
  const Target target(recorded_samples(conditions.recording, conditions.metrics), options.binning);

  Comparison result;
  result.run = run_record(options);
  result.recording = recording_facts(recording, conditions, target, options);
  if (options.hold_out) result.recording.hold_out = facts_of(parts);
  const ObservationFacts& observation = result.recording.observation;
  const FilmSpan span = film_span(conditions.recording, options.models.size() + 1);
  result.film = cut(conditions.recording, span.first, span.last);
  if (const auto* walls = conditions.world.part<Walls>(); walls || conditions.world.bounds.kind != Bounds::Kind::open)
    result.around = scenery_of(conditions.world.bounds, walls ? walls->obstacles() : std::vector<Obstacle>{}, result.film);

  std::optional<Judge> judge;
  const auto view = [&](const Run& run, std::size_t k) {
    return to_bytes(View{judge->look(run), k == 0 ? natural_scales(run.seen) : Scales{}, k == 0 ? strip_of(run.seen, span) : FilmStrip{}});
  };
  const std::vector<bool> used(observation.used.begin(), observation.used.end());
  Calibration calibration(options, conditions, target, used, result.run.history, on_progress, runtime, view);
  judge.emplace(conditions, clear_columns(observation), options.seed, runtime);  // computes, so after whatever the searches refuse
  result.recording.skill = judge->skill();
  result.recording.panel = judge->panel();
  result.ranking = calibration.run(result.recording.resolution);
  const Weighting& weighting = calibration.weighting();

  Laws laws{{}, {}, {}, {options.seed}};
  std::vector<std::vector<Energies>> selections;
  for (std::size_t m = 0; m < options.models.size(); ++m) {
    const ModelSearch& search = calibration.searches()[m];
    ModelFit fit = model_fit_of(search);
    fit.learns = options.models[m].spec->needs_reference;
    fit.standing = standing_of(fit.runs, weighting);
    add_likeness(fit, search.selected().views, *judge, conditions.recording);
    if (options.posterior) fill_posterior(fit, search, Rng{options.seed}.derive(Stream::posterior, m));
    laws.of.push_back(law_of(search.objective(), search.space().parameters(search.selected().x), {options.seed}, options.laws));
    selections.push_back(search.selections());
    result.run.searched.push_back(searched_names(search.space()));
    result.models.push_back(std::move(fit));
  }
  laws.scatter = search_scatter(selections, weighting);
  rank(result.models, laws);
  add_standings(result, laws, target, weighting, options.budget.final_replicates);
  if (options.hold_out) {
    const auto there = held_out(result.models, parts, options, conditions, weighting, runtime);
    for (std::size_t k = 0; k < there.size(); ++k) result.models[k].standing.held_out = there[k];
  }
  for (const auto& warnings : {warnings_of_facts(result), warnings_for(result), warnings_of_skill(result), warnings_of_learning(result)})
    result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
  return result;
}

}  // namespace swarmfit
