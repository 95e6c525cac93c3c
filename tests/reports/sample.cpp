// SPDX-License-Identifier: MIT
#include "tests/reports/sample.h"

#include <cmath>

namespace swarmfit {

namespace {

constexpr int kBins = 150;
constexpr double kSamples = 60000;
const PerColumn<double> kMean = {213, 1840, 9.2, 0.3, 2.1e5, 41, 2.9};
const PerColumn<double> kSd = {98, 1130, 7.9, 640, 1.4e5, 19, 3.3};

// A gamma density for magnitudes, a Laplace density for the signed angular acceleration.
double shape(std::size_t metric, double x, double mean, double sd) {
  if (metric == kAngularAcceleration) return std::exp(-std::sqrt(2.0) * std::abs(x - mean) / sd) / (std::sqrt(2.0) * sd);
  if (x <= 0) return 0;
  const double k = mean * mean / (sd * sd), theta = mean / k;
  return std::exp((k - 1) * std::log(x / theta) - x / theta - std::lgamma(k)) / theta;
}

Distribution distribution(std::size_t metric, double stretch) {
  Distribution d;
  const double width = kSd[metric] / 10, lower = kMean[metric] - 5 * kSd[metric];
  for (int bin = 0; bin < kBins; ++bin) {
    const double x = lower + (bin + 0.5) * width;
    const double n = kSamples * width * shape(metric, x, stretch * kMean[metric], (0.3 + 0.7 * stretch) * kSd[metric]);
    d.histogram.counts.push_back(static_cast<std::uint64_t>(std::lround(n)));
    d.histogram.samples += d.histogram.counts.back();
  }
  d.moments = {d.histogram.samples, stretch * kMean[metric], static_cast<double>(d.histogram.samples) * std::pow(stretch * kSd[metric], 2)};
  return d;
}

double energy(const Histogram& a, const Histogram& b) {
  const auto qa = density(a, -5, 10), qb = density(b, -5, 10);
  double sum = 0;
  for (std::size_t i = 0; i < qa.size(); ++i) sum += std::abs(qa[i] - qb[i]);
  return sum;
}

// Four individuals on circles, for twenty frames; the last one misses two.
Tracks film(double stretch) {
  TrackColumns columns;
  columns.names = {"a", "b", "c", "d"};
  columns.pos.resize(78, 3);
  for (std::int64_t frame = 1; frame <= 20; ++frame)
    for (std::uint32_t track = 0; track < 4; ++track) {
      if (track == 3 && (frame == 8 || frame == 9)) continue;
      const double angle = 0.2 * static_cast<double>(frame) + track;
      columns.pos.row(static_cast<Index>(columns.track.size())) << stretch * 50 * std::cos(angle), stretch * 50 * std::sin(angle),
          10.0 * track;
      columns.track.push_back(track);
      columns.frame.push_back(frame);
    }
  TrackMeta meta;
  meta.dt = 0.01;
  meta.unit = "mm";
  return {std::move(columns), meta};
}

ModelFit fit_result(const Comparison& c, const Sketch& sketch, int rank) {
  ModelFit r;
  r.model = sketch.name;
  r.summary = "Force model with drag, repulsion, alignment, attraction and noise";
  r.citation = "Ren et al. 2016, doi:10.1371/journal.pone.0155698";
  r.options = {{"avoidance", "orca"}, {"noise", "curl"}};
  r.standing.rank = rank;
  r.standing.score = sketch.score;
  r.standing.in_sample.rank = rank;
  r.standing.in_sample.score = sketch.score;
  r.standing.in_sample.score_se = sketch.score_se;
  for (std::size_t m = 0; m < kMetrics; ++m) {
    const double stretch = std::pow(sketch.stretch, 1 + 0.2 * static_cast<double>(m));
    r.runs.distributions[m] = distribution(m, stretch);
    r.runs.raw_energies[m] = energy(r.runs.distributions[m].histogram, c.recording.distributions[m].histogram);
    r.runs.raw_se[m] = 0.02 + 0.02 * r.runs.raw_energies[m];
    r.standing.energies[m] = r.runs.raw_energies[m] / 20;
    r.runs.half_step_energies[m] = r.runs.raw_energies[m] * 1.01;
    r.runs.mean_ratio[m] = stretch;
    r.runs.sd_ratio[m] = 0.3 + 0.7 * stretch;
    r.runs.outside_fraction[m] = 0.001 * static_cast<double>(m);
  }
  for (int k = 0; k < 3; ++k) r.runs.replicate_energies.push_back(r.runs.raw_energies);
  r.parameters = {
      {"gamma", "γ", "1/mm", "quadratic drag", 0.0123 * rank, 0.0005, 0.1, true, true, false},
      {"chi_att", "χ_att", "mm/s²", "attraction", 2310, 0, 2310, true, false, true},
      {"r_rep", "r_rep", "mm", "repulsion radius", 12.5, 0, 123, true, false, false},
      {"radius", "", "mm", "avoidance radius", 4.1, 4.1, 4.1, false, false, false},
  };
  r.likeness.extent = 131 * sketch.stretch;
  r.likeness.spacing = 41 * sketch.stretch;
  r.likeness.speed = 213 * sketch.stretch;
  r.search.evaluations = 2410 + 13 * rank;
  r.search.simulations = 3 * r.search.evaluations + 20;
  r.search.failed_simulations = rank == 3 ? 17 : 0;
  r.runs.failed_final = 0;
  r.search.stop_reason = "stalled";
  r.runs.steps = 2;
  r.runs.infeasible_avoidance = 0.0021;
  r.standing.certainty = {0.5 / rank, 0.5 / rank, 0, 1.0 / rank, sketch.score - 0.03, sketch.score + 0.02, 0.05 * rank, 0.15 * rank, {}};
  for (std::size_t m = 0; m < kMetrics; ++m) r.standing.certainty.own[m] = 0.1 + 0.05 * static_cast<double>(m);
  r.likeness.skill = {sketch.score - 0.1, 0.02};
  for (std::size_t m = 0; m < kMetrics; ++m) {
    r.likeness.total_variation[m] = r.runs.raw_energies[m] / 20;
    r.likeness.wasserstein[m] = r.runs.raw_energies[m] / 5;
  }
  for (const Estimate& e : c.recording.panel.recording) r.likeness.panel.push_back({sketch.stretch * e.value, 0.5 * e.se});
  for (const Estimate& e : c.recording.panel.recording_vacf) r.likeness.vacf.push_back({std::pow(e.value, 2), 0.5 * e.se});
  r.film = film(sketch.stretch);
  for (int pass = 1; pass <= 3; ++pass)
    for (int k = 1; k <= 20; ++k)
      r.search.convergence.push_back({pass, 800 * (pass - 1) + 40 * k, sketch.score - 0.4 * std::exp(-0.25 * k - 1.5 * (pass - 1))});
  return r;
}

void add_facts(Comparison& c) {
  c.run.command = "compare";
  c.run.version = "0.1.0";
  c.run.seed = 18446744073709551615ULL;
  c.run.budget = {"default", {40, 60, 3}, {16, 20, 12}, 24, 10, 6};
  c.run.protocol = "reference";
  c.recording.data = {"swarm.txt", std::string(64, 'a'),
                      "delimited", "id,x,y,z,t",
                      "mm",        false,
                      3,           0.01,
                      24310,       152,
                      500,         1,
                      500,         48.62,
                      131,         41,
                      213,         {"3 duplicated rows were dropped"}};
  ObservationFacts& o = c.recording.observation;
  o = {"recorded",
       "open",
       0,
       "estimate",
       {0.31, 0.29, 0.52},
       true,
       {0.01, 0.01, 0.01},
       0,
       "difference",
       {0.02, 0.67, 0.21, 0.74, 0.78, 0.01, 0.11},
       {},
       {}};
  for (std::size_t m = 0; m < kMetrics; ++m) o.used[m] = m != kAngularAcceleration && m != kJerk;
  for (const std::size_t m : {kAngularAcceleration, kJerk}) o.why_not[m] = "it is constant or undefined in the recording";
  o.error_dominated[kAcceleration] = true;
  c.warnings = {"Acceleration, angular acceleration and jerk are mostly measurement error."};
  c.run.config = {{"data", "\"swarm.txt\""}, {"seed", "18446744073709551615"}, {"models", "\"bswarm,boids\""}};
}

void add_weights(Comparison& c) {
  c.ranking.weights = {0.21, 0.18, 0.2, 0, 0, 0.26, 0.15};
  c.ranking.p1 = {0.4, 0.6, 0.5, 0.4, 0.7, 0.3, 0.5};
  c.ranking.p2 = {3.1, 4.0, 2.2, 1.9, 5.2, 2.4, 1.3};
  c.ranking.weight_history = {{1, {0.2, 0.2, 0.2, 0, 0, 0.2, 0.2}, {0.2, 0.2, 0.2, 0, 0, 0.2, 0.2}, {}, {20, 20, 20, 20, 20, 20, 20}, 1},
                              {2, {0.2, 0.2, 0.2, 0, 0, 0.2, 0.2}, {0.22, 0.17, 0.21, 0, 0, 0.25, 0.15}, c.ranking.p1, c.ranking.p2, 0.05},
                              {3, {0.207, 0.19, 0.203, 0, 0, 0.217, 0.183}, c.ranking.weights, c.ranking.p1, c.ranking.p2, 0.0041}};
  c.ranking.weights_converged = true;
}

void add_skill(Comparison& c) {
  SkillFacts& s = c.recording.skill;
  s.floor = {0.021, 0.03, 0.025, 0.02, 0.033, 0.04, 0.038};
  s.floor_sd = {0.004, 0.005, 0.004, 0.003, 0.006, 0.009, 0.007};
  s.null = {0.02, 0.51, 0.73, 0.44, 0.62, 0.09, 0.04};
  s.places = {0.9, 0.91, 0.92, 0.93, 0.94, 0.1, 0.95};
  s.null_of = SkillNull::steps;
  s.mean_floor_sd = 0.003;
  s.walker = {0, 0.004};
  s.memory_p = 0.01;
  s.informative = {false, true, true, true, true, true, false};
  s.used = c.recording.observation.used;
  s.mean_floor = 0.03;
  s.mean_null = 0.28;
  s.interaction_p[0] = 0.01;
  s.interaction_p[1] = 0.48;
  s.surrogates = 99;
  const PanelPlan plan{3, 0.01, {0, 1, 2, 4}, {12, 25, 50, 100}};
  c.recording.panel.items = plan.items();
  for (std::size_t k = 0; k < c.recording.panel.items.size(); ++k)
    c.recording.panel.recording.push_back({1.5 + 0.5 * static_cast<double>(k), 0.1});
  for (const Index lag : plan.vacf_lags) {
    c.recording.panel.lags.push_back(static_cast<double>(lag) * plan.dt);
    c.recording.panel.recording_vacf.push_back({1 - 0.1 * static_cast<double>(lag), 0.02});
  }
}

// Groups by the error of the scores: who is within two of a group's best belongs to it.
void add_groups(Comparison& c) {
  c.ranking.bootstrap_recordings = 99;
  int group = 0;
  const ModelFit* best = nullptr;
  for (ModelFit& r : c.models) {
    const double se = best ? std::hypot(best->standing.in_sample.score_se, r.standing.in_sample.score_se) : 0;
    if (!best || best->standing.score - r.standing.score > 2 * se) best = &r, ++group;
    r.standing.certainty.group =
        std::isfinite(r.standing.score) && std::isfinite(se) && std::isfinite(r.standing.in_sample.score_se) ? group : 0;
  }
}

// Without each model the others keep their order, but without the second the last two change places.
void add_without(Comparison& c) {
  for (std::size_t left = 0; left < c.models.size() && c.models.size() > 2; ++left) {
    LeftOut w{c.models[left].model, c.ranking.weights, {}, left == 1, false};
    for (std::size_t k = 0; k < c.models.size(); ++k)
      if (k != left) w.ranking.emplace_back(c.models[k].model, c.models[k].standing.score);
    if (w.reordered) std::swap(w.ranking[w.ranking.size() - 1], w.ranking[w.ranking.size() - 2]);
    c.ranking.without.push_back(w);
  }
}

// Columns of further lags: those of the first again, with something else in every one.
template <class T, class Change>
void extend(PerColumn<T>& values, std::size_t lags, Change change) {
  values.resize(kMetrics + kMotionMetrics * lags);
  for (std::size_t j = kMetrics; j < values.size(); ++j) values[j] = change(values[(j - kMetrics) % kMotionMetrics], j);
}

void extend(ModelFit& r, std::size_t lags) {
  const auto larger = [](double x, std::size_t j) { return x * (1 + 0.01 * static_cast<double>(j)); };
  for (auto* values : {&r.runs.raw_energies, &r.runs.raw_se, &r.standing.certainty.own, &r.standing.energies, &r.runs.half_step_energies,
                       &r.runs.mean_ratio, &r.runs.sd_ratio, &r.runs.outside_fraction, &r.likeness.total_variation, &r.likeness.wasserstein,
                       &r.standing.sensitivity.without, &r.standing.sensitivity.doubled})
    extend(*values, lags, larger);
  extend(r.standing.sensitivity.rank_without, lags, [](int rank, std::size_t) { return rank; });
  extend(r.runs.distributions, lags, [](const Distribution& d, std::size_t) { return d; });
  for (Energies& e : r.runs.replicate_energies) extend(e, lags, larger);
}

}  // namespace

Comparison sample_comparison(const std::vector<Sketch>& models) {
  Comparison c;
  add_facts(c);
  add_weights(c);
  add_skill(c);
  c.recording.defined.fill(true);
  c.film = film(1);
  for (std::size_t m = 0; m < kMetrics; ++m) {
    c.recording.distributions[m] = distribution(m, 1);
    c.recording.axis_width[m] = kSd[m] / 10;
    c.recording.axis_lower[m] = kMean[m] - 5 * kSd[m];
  }
  int rank = 0;
  for (const Sketch& sketch : models) {
    c.models.push_back(fit_result(c, sketch, ++rank));
    c.run.named.push_back(sketch.name);
    c.run.searched.push_back({"gamma", "chi_att", "r_rep"});
    c.run.history.push_back({static_cast<std::size_t>(rank - 1), 1, "search", {0.01, 2100, 12.5}, c.models.back().runs.raw_energies, 3, 1});
  }
  add_groups(c);
  add_without(c);
  c.ranking.lags = {{1, 3, 0.59, 0.78}, {0, 2, 0.41, 0.11}};
  return c;
}

Comparison sample_comparison() {
  return sample_comparison({{"bswarm", 0.912, 0.011, 1.04},
                            {"bswarm[noise=perlin]", 0.781, 0.02, 1.12},
                            {"bswarm[noise=gaussian]", 0.533, 0.018, 0.85},
                            {"boids", 0.402, 0.009, 1.4},
                            {"bswarm[noise=white]", 0.311, 0.03, 0.7}});
}

Comparison sample_at_lags() {
  Comparison c = sample_comparison();
  c.recording.columns = columns_at({1, 4, 16});
  const auto same = [](auto x, std::size_t) { return x; };
  const auto true_flag = [](bool, std::size_t) { return true; };
  for (auto* values : {&c.recording.observation.independent, &c.recording.axis_lower, &c.recording.axis_width, &c.ranking.p1, &c.ranking.p2,
                       &c.recording.skill.floor, &c.recording.skill.floor_sd, &c.recording.skill.null, &c.recording.skill.places})
    extend(*values, 2, same);
  extend(c.recording.observation.error_share, 2, [](double, std::size_t j) { return j < 12 ? 0.1 : 0.02; });
  for (auto* flags : {&c.recording.defined, &c.recording.observation.used, &c.recording.skill.used, &c.recording.skill.informative})
    extend(*flags, 2, true_flag);
  extend(c.recording.observation.why_not, 2, [](const std::string&, std::size_t) { return std::string(); });
  extend(c.recording.distributions, 2, same);
  for (double& w : c.ranking.weights) w *= 0.2;
  extend(c.ranking.weights, 2, [](double, std::size_t j) { return j < 12 ? 0.02 : 0.14; });
  for (WeightStep& s : c.ranking.weight_history)
    for (auto* values : {&s.searched, &s.weights, &s.p1, &s.p2}) extend(*values, 2, same);
  for (LeftOut& w : c.ranking.without) extend(w.weights, 2, same);
  for (ModelFit& r : c.models) extend(r, 2);
  for (HistoryRow& row : c.run.history) extend(row.raw, 2, same);
  c.ranking.lags = {{1, 3, 0.118, 0.78}, {4, 5, 0.1, 0.1}, {16, 5, 0.7, 0.02}, {0, 2, 0.082, 0.11}};
  return c;
}

}  // namespace swarmfit
