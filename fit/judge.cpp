// SPDX-License-Identifier: MIT
#include "fit/judge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "libeval/distance.h"
#include "libeval/leave_one_out.h"
#include "libeval/surrogate.h"

namespace swarmfit {
namespace {

constexpr std::size_t kTimeshifts = 99;  // so that p can reach 0.01
constexpr std::size_t kWalkers = 10;
constexpr double kSignificant = 0.05;
constexpr double kStandardErrors = 2;

Estimate estimate(const std::vector<double>& values) {
  Moments m;
  for (const double v : values) m.add(v);
  const auto n = static_cast<double>(m.count);
  return {m.count > 0 ? m.mean : NAN, m.count > 1 ? std::sqrt(m.m2 / (n - 1) / n) : NAN};
}

std::vector<Estimate> estimates(const std::vector<double>& value, const std::vector<double>& se) {
  std::vector<Estimate> out;
  for (std::size_t k = 0; k < value.size(); ++k) out.push_back({value[k], se[k]});
  return out;
}

// Mean and standard error of each number over replicates.
std::vector<Estimate> over_replicates(const std::vector<Panel>& panels, std::vector<double> Panel::*part) {
  std::vector<Estimate> out;
  for (std::size_t k = 0; !panels.empty() && k < (panels.front().*part).size(); ++k) {
    std::vector<double> column;
    for (const Panel& p : panels) column.push_back((p.*part)[k]);
    out.push_back(estimate(column));
  }
  return out;
}

// One replicate as the judge sees it.
struct Run {
  PerColumn<double> distance, wasserstein;
  Panel panel;  // empty if it blew up
};

}  // namespace

Judge::Judge(const Conditions& conditions, const PerColumn<bool>& used, std::uint64_t seed)
    : conditions_(conditions), used_(used), distance_(conditions.recording, conditions.metrics), plan_(panel_plan(conditions.recording)) {
  measure_nulls({seed});
  facts_.floor = distance_.floor();
  facts_.floor_sd = distance_.floor_sd();
  const std::size_t columns = facts_.floor.size();
  facts_.informative = PerColumn<bool>(columns);
  for (std::size_t j = 0; j < columns; ++j) facts_.informative[j] = facts_.null[j] > facts_.floor[j] + kStandardErrors * facts_.floor_sd[j];
  const auto any_informative = [&](const PerColumn<bool>& metrics) {
    for (std::size_t j = 0; j < columns; ++j)
      if (metrics[j] && facts_.informative[j]) return true;
    return false;
  };
  const auto measured = [&](std::size_t j) { return std::isfinite(facts_.floor[j]) && std::isfinite(facts_.null[j]); };
  facts_.used = used_;
  // An eighth of the recording can be too short for a lag that the whole carries.
  for (std::size_t j = 0; j < columns; ++j) facts_.used[j] = used_[j] && (distance_.columns()[j].lag == 1 || measured(j));
  if (!any_informative(used_))
    for (std::size_t j = 0; j < columns; ++j) facts_.used[j] = measured(j);
  if (any_informative(facts_.used)) scale_ = skill_scale(facts_.floor, facts_.null, facts_.used);
  facts_.mean_floor = scale_.floor;
  facts_.mean_null = scale_.null;
}

void Judge::measure_nulls(const Rng& rng) {
  const Tracks& recording = conditions_.recording;
  const auto& columns = distance_.columns();
  std::vector<PerColumn<double>> distances(kTimeshifts + kWalkers);
  std::vector<PerColumn<Histogram>> shifted(kTimeshifts);
#pragma omp parallel for schedule(dynamic, 1)
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(distances.size()); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Rng own = rng.derive(Stream::surrogate, k);
    const bool shift = k < kTimeshifts;
    const auto blocks = distance_.blocks(shift ? timeshift(recording, own) : shuffled_walker(recording, own));
    PerColumn<bool> wanted(columns.size());
    for (std::size_t j = 0; j < columns.size(); ++j) wanted[j] = columns[j].motion() != shift;
    distances[k] = distance_.to(blocks, wanted);
    if (shift) shifted[k] = HalfDistance::pooled(blocks);
  }
  const auto observed = HalfDistance::pooled(distance_.recording());
  facts_.surrogates = static_cast<int>(kTimeshifts);
  facts_.null = PerColumn<double>(columns.size());
  for (std::size_t j = 0; j < columns.size(); ++j) {
    std::vector<double> column;
    for (const auto& d : distances) column.push_back(d[j]);
    facts_.null[j] = estimate(column).value;
    if (columns[j].motion()) continue;
    std::vector<Histogram> surrogates;
    for (const auto& h : shifted) surrogates.push_back(h[j]);
    facts_.interaction_p[j - kDistance] = surrogate_p(observed[j], surrogates);
  }
}

void Judge::judge(FitResult& fit, const Objective& objective, const std::vector<double>& parameters, std::span<const Rng> seeds) const {
  std::vector<Run> runs(seeds.size());
  const auto real = HalfDistance::pooled(distance_.recording());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(runs.size()); ++i) {
    Run& run = runs[static_cast<std::size_t>(i)];
    const auto tracks = objective.finished(parameters, seeds[static_cast<std::size_t>(i)]);
    const auto blocks = tracks ? distance_.blocks(*tracks) : distance_.no_blocks();
    const auto pooled = HalfDistance::pooled(blocks);
    run.distance = distance_.to(blocks);
    run.wasserstein = PerColumn<double>(real.size());
    for (std::size_t j = 0; j < real.size(); ++j) {
      if (std::isnan(run.distance[j]) && !std::isnan(distance_.floor()[j])) run.distance[j] = 1;
      run.wasserstein[j] = wasserstein(real[j], pooled[j], distance_.bin_width());
    }
    if (tracks) run.panel = panel(*tracks, plan_);
  }
  std::vector<double> means;
  std::vector<Panel> panels;
  for (const Run& run : runs) {
    means.push_back(mean_used(run.distance, facts_.used));
    if (!run.panel.values.empty()) panels.push_back(run.panel);
  }
  const Estimate d = estimate(means);
  fit.skill = {scale_.skill(d.value), scale_.slope() * d.se};
  fit.total_variation = fit.wasserstein = PerColumn<double>(real.size());
  for (std::size_t j = 0; j < real.size(); ++j) {
    std::vector<double> distances, shifts;
    for (const Run& run : runs) distances.push_back(run.distance[j]), shifts.push_back(run.wasserstein[j]);
    fit.total_variation[j] = estimate(distances).value;
    fit.wasserstein[j] = estimate(shifts).value;
  }
  fit.panel = over_replicates(panels, &Panel::values);
  fit.vacf = over_replicates(panels, &Panel::vacf);
  fit.panel.resize(plan_.items().size());
  fit.vacf.resize(plan_.vacf_lags.size());
}

void Judge::tell(Comparison& result) const {
  result.skill = facts_;
  const auto [value, se] = panel_with_error(conditions_.recording, plan_);
  result.panel = {plan_.items(), estimates(value.values, se.values), {}, estimates(value.vacf, se.vacf)};
  for (const Index lag : plan_.vacf_lags) result.panel.lags.push_back(static_cast<double>(lag) * plan_.dt);

  const auto& models = result.models;
  const auto& scored = result.observation.used;
  Eigen::MatrixXd table(static_cast<Index>(models.size()), static_cast<Index>(scored.size()));
  for (std::size_t m = 0; m < models.size(); ++m)
    for (std::size_t j = 0; j < scored.size(); ++j) table(static_cast<Index>(m), static_cast<Index>(j)) = models[m].raw_energies[j];
  for (const WithoutOne& w : leave_one_out(table, {scored.begin(), scored.end()}, {result.resolution.begin(), result.resolution.end()})) {
    LeftOut out;
    out.model = models[static_cast<std::size_t>(w.dropped)].model;
    out.weights.assign(w.weighting.weights.begin(), w.weighting.weights.end());
    for (const Index row : w.order)
      out.ranking.emplace_back(models[static_cast<std::size_t>(row)].model, w.scores[static_cast<std::size_t>(row)]);
    // Rows stand in order of rank.
    out.reordered = !std::is_sorted(w.order.begin(), w.order.end());
    out.winner_changed = w.dropped != 0 && w.order.front() != 0;
    result.without.push_back(std::move(out));
  }
}

namespace {

// Models by skill, those without one last.
std::vector<const FitResult*> by_skill(const Comparison& r) {
  std::vector<const FitResult*> order;
  for (const auto& m : r.models) order.push_back(&m);
  const auto value = [](const FitResult* m) { return std::isfinite(m->skill.value) ? m->skill.value : -INFINITY; };
  std::stable_sort(order.begin(), order.end(), [&](const FitResult* a, const FitResult* b) { return value(a) > value(b); });
  return order;
}

// Pairs whose order by skill is the reverse of their order by score, beyond the scatter of the simulations.
std::vector<std::string> reversed_pairs(const Comparison& r) {
  std::vector<std::string> out;
  for (std::size_t a = 0; a < r.models.size(); ++a)
    for (std::size_t b = a + 1; b < r.models.size(); ++b) {
      const Estimate &above = r.models[a].skill, &below = r.models[b].skill;
      if (below.value - above.value > kStandardErrors * std::hypot(above.se, below.se))
        out.push_back(fmt::format("{} before {}", r.models[b].model, r.models[a].model));
    }
  return out;
}

void warn_of_order(const Comparison& r, std::vector<std::string>& out) {
  const auto pairs = reversed_pairs(r);
  if (pairs.empty()) return;
  std::vector<std::string> order;
  for (const FitResult* m : by_skill(r)) order.push_back(fmt::format("{} ({:.2f})", m->model, m->skill.value));
  out.push_back(fmt::format(
      "Score and skill disagree: by skill the order is {}, which puts {}. A score depends on which models are compared, a skill does not.",
      fmt::join(order, ", "), fmt::join(pairs, " and ")));
}

// Does the skill rest on other columns than the score?
void warn_of_basis(const Comparison& r, std::vector<std::string>& out) {
  bool more = false;
  std::vector<std::string> missing;
  for (std::size_t j = 0; j < r.skill.used.size(); ++j) {
    const bool expected = r.observation.used[j] && !r.observation.drowned[j];
    more = more || (r.skill.used[j] && !expected);
    if (!r.skill.used[j] && expected) missing.push_back(r.columns[j].key());
  }
  if (more)
    out.emplace_back("No metric that counts in full tells the recording from its surrogates, so the skill rests on all that are defined.");
  else if (!missing.empty())
    out.push_back(
        fmt::format("The skill leaves out {}: an eighth of the recording is too short for so long a lag.", fmt::join(missing, ", ")));
}

}  // namespace

std::vector<std::string> warnings_of_skill(const Comparison& r) {
  std::vector<std::string> out;
  const auto [d, eta] = r.skill.interaction_p;
  if (d > kSignificant && eta > kSignificant)
    out.push_back(
        fmt::format("No detectable interaction: distances and speed differences of neighbours are like those of the same tracks shifted in "
                    "time against each other (p = {:.2f} and {:.2f} among {} surrogates), so the ranking says how single animals move.",
                    d, eta, r.skill.surrogates));
  if (!r.models.empty() && std::isnan(r.models.front().skill.value))
    out.emplace_back(
        "Skill is undefined: the recording is too short to be halved, or no nearer to itself than to its surrogates in any metric.");
  if (!r.models.empty() && std::isfinite(r.models.front().skill.value)) warn_of_basis(r, out);
  warn_of_order(r, out);
  std::vector<std::string> deciders;
  for (const LeftOut& w : r.without)
    if (w.winner_changed) deciders.push_back(fmt::format("without {} it is {}", w.model, w.ranking.front().first));
  if (!deciders.empty()) out.push_back(fmt::format("Who wins by score depends on who is compared: {}.", fmt::join(deciders, ", ")));
  return out;
}

}  // namespace swarmfit
