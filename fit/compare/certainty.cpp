// SPDX-License-Identifier: MIT
#include "fit/compare/certainty.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "fit/model_fit/race.h"
#include "libeval/energy_score.h"
#include "libeval/false_discovery.h"
#include "libtrack/nan.h"
#include "libtrack/quantile.h"

namespace swarmfit {
namespace {

constexpr std::size_t kLeastBand = 39;

// A model's own recordings, which others are measured against. Each is compared with the `pooled` runs after its own number, so that it is
// never compared with itself.
class Against {
 public:
  Against(const Bootstrap& bootstrap, const Target& target, int pooled)
      : bootstrap_(bootstrap), target_(target), pooled_(static_cast<std::size_t>(pooled)) {
    if (target.binning().pooled) return;
    std::vector<Densities> runs;
    for (const SingleRun& run : bootstrap)
      if (!run.failed) runs.push_back(target.densities(run.distributions));
    half_spread_ = spread(runs, target.worst()).mean;
    for (double& s : half_spread_) s /= 2;
  }

  // As in Objective, runs that blew up count as the worst.
  Energies operator()(const SingleRun& recording, std::size_t number) const {
    const std::size_t columns = target_.columns().size();
    std::vector<const SingleRun*> runs;
    for (std::size_t i = 1; i <= pooled_; ++i)
      if (const SingleRun& run = bootstrap_[(number + i) % bootstrap_.size()]; !run.failed) runs.push_back(&run);
    const double failed = 1 - static_cast<double>(runs.size()) / static_cast<double>(pooled_);
    Energies out = runs.empty() ? Energies(columns, kNaN) : target_.binning().pooled ? from_pool(recording, runs) : scored(recording, runs);
    for (std::size_t j = 0; j < columns; ++j) {
      const double energy = std::isfinite(out[j]) ? out[j] : target_.worst();
      out[j] = target_.defined(j) ? (1 - failed) * energy + failed * target_.worst() : kNaN;
    }
    return out;
  }

 private:
  Energies from_pool(const SingleRun& recording, const std::vector<const SingleRun*>& runs) const {
    PerColumn<Distribution> pool(target_.columns().size());
    for (const SingleRun* run : runs)
      for (std::size_t j = 0; j < pool.size(); ++j) pool[j].histogram.add(run->distributions[j].histogram);
    return target_.energies_between(recording.distributions, pool);
  }

  Energies scored(const SingleRun& recording, const std::vector<const SingleRun*>& runs) const {
    Energies out(target_.columns().size(), 0.0);
    for (const SingleRun* run : runs) {
      const Energies away = target_.energies_between(recording.distributions, run->distributions);
      for (std::size_t j = 0; j < out.size(); ++j)
        out[j] += (std::isfinite(away[j]) ? away[j] : target_.worst()) / static_cast<double>(runs.size());
    }
    for (std::size_t j = 0; j < out.size(); ++j) out[j] -= half_spread_[j];
    return out;
  }

  const Bootstrap& bootstrap_;
  const Target& target_;
  std::size_t pooled_;
  Energies half_spread_;
};

bool long_enough(const std::vector<Bootstrap>& bootstraps, int pooled) {
  return !bootstraps.empty() && std::all_of(bootstraps.begin(), bootstraps.end(), [&](const Bootstrap& bootstrap) {
    return bootstrap.size() == bootstraps.front().size() && static_cast<int>(bootstrap.size()) >= pooled + 2;
  });
}

// Raw energies of a model's own recordings; nothing for those that blew up.
using Own = std::vector<std::optional<Energies>>;

Own own_energies(const Bootstrap& bootstrap, const Target& target, int pooled) {
  const Against model(bootstrap, target, pooled);
  Own out(bootstrap.size());
  for (std::size_t k = 0; k < bootstrap.size(); ++k)
    if (!bootstrap[k].failed) out[k] = model(bootstrap[k], k);
  return out;
}

Energies mean(const Own& all, std::size_t columns) {
  Energies out(columns, kNaN);
  for (std::size_t j = 0; !all.empty() && j < columns; ++j) {
    Moments moments;
    for (const auto& e : all)
      if (e) moments.add((*e)[j]);
    if (moments.count > 0) out[j] = moments.mean;
  }
  return out;
}

// Energies of a model without what does not count against it: where its own recordings scatter by less than what no ranking sees, it may
// lie farther away than they do by the rest of that.
Energies seen(Energies raw, const Own& own, double worst) {
  for (std::size_t j = 0; j < raw.size(); ++j) {
    Moments moments;
    for (const auto& e : own)
      if (e) moments.add((*e)[j]);
    const double unseen = std::max(0.0, kUnseen * worst - moments.sd());
    if (raw[j] > moments.mean) raw[j] = std::max(moments.mean, raw[j] - unseen);
  }
  return raw;
}

// How far the recordings lie from a model, and its own from it, in the mean over the trials.
struct Distances {
  double observed = 0;
  std::vector<double> own;  // NaN: blew up
};

// A search misses the best parameters of each of a model's own recordings, too.
Distances distances(std::span<const Trial> trials, std::size_t model, int pooled) {
  Distances out;
  out.own.resize(trials.front().bootstraps.of[model].size());
  for (const Trial& trial : trials) {
    const auto share = 1 / static_cast<double>(trials.size());
    const auto own = own_energies(trial.bootstraps.of[model], *trial.target, pooled);
    out.observed += share * cost_of(seen(trial.models[model].raw, own, trial.target->worst()), trial.weighting);
    for (std::size_t k = 0; k < own.size(); ++k) {
      const double missed = std::abs(trial.bootstraps.scatter[model] *
                                     trial.bootstraps.root.normal2(Stream::bootstrap, k, static_cast<std::uint32_t>(model))[0]);
      out.own[k] += share * (own[k] ? cost_of(*own[k], trial.weighting) + missed : kNaN);
    }
  }
  return out;
}

double goodness(const Distances& of) {
  const auto made = std::count_if(of.own.begin(), of.own.end(), [](double d) { return !std::isnan(d); });
  if (made == 0 || !std::isfinite(of.observed)) return kNaN;
  const auto beyond = std::count_if(of.own.begin(), of.own.end(), [&](double d) { return d >= of.observed; });
  return static_cast<double>(1 + beyond) / static_cast<double>(1 + made);
}

// Of the mean over the trials.
ScoreDraws mean_draws(std::span<const Trial> trials, int pooled) {
  ScoreDraws out = score_draws(trials.front(), pooled);
  for (const Trial& trial : trials.subspan(1)) {
    const ScoreDraws other = score_draws(trial, pooled);
    out.scores += other.scores;
    out.draws += other.draws;
  }
  out.scores /= static_cast<double>(trials.size());
  out.draws /= static_cast<double>(trials.size());
  return out;
}

// How far a fitted model's recordings scatter is that of the truth's only to a fifth: on the logarithm, over planted pairs
// (reports/published/leads). As if it were estimated with ten degrees of freedom: Student's t in place of the normal distribution, at 97.5
// %.
constexpr double kStudent = 2.2281 / 1.9600;

// Basic bootstrap: the scatter of the draws, turned round the value.
std::pair<double, double> interval(double value, const Eigen::VectorXd& draws) {
  std::vector<double> finite;
  for (const double d : draws)
    if (std::isfinite(d)) finite.push_back(d);
  if (finite.size() < 2) return {kNaN, kNaN};
  Moments moments;
  for (const double d : finite) moments.add(d);
  const double above = quantile(finite, 1 - kAlpha / 2) - moments.mean, below = quantile(finite, kAlpha / 2) - moments.mean;
  return {value - kStudent * above, value - kStudent * below};
}

}  // namespace

Bootstrap bootstrap_of(const Objective& objective, const std::vector<double>& parameters, const Rng& root, int recordings) {
  const auto jobs = jobs_on(parameters, replicate_seeds(root, Stream::bootstrap, recordings));
  return objective.ensemble().measured<SingleRun>(jobs, "bootstrap", [&](const Run& run, std::size_t) { return objective.single(run); });
}

std::vector<double> search_scatter(const std::vector<std::vector<Energies>>& selections, const Weighting& weighting) {
  std::vector<double> variance;
  for (const auto& passes : selections) {
    double sum = 0;
    for (std::size_t k = 1; k < passes.size(); ++k) {
      const double change = cost_of(passes[k], weighting) - cost_of(passes[k - 1], weighting);
      sum += change * change;
    }
    // The variance of a difference is twice that of each.
    const double own = passes.size() > 1 ? sum / (2 * static_cast<double>(passes.size() - 1)) : 0;
    variance.push_back(std::isfinite(own) ? own : 0);
  }
  const double median = quantile(variance, 0.5);
  for (double& v : variance) v = std::sqrt(std::max(v, median));
  return variance;
}

ScoreDraws score_draws(const Trial& trial, int pooled) {
  const Bootstrap& recordings = trial.bootstraps.recordings;
  const auto rows = static_cast<Eigen::Index>(recordings.size()), columns = static_cast<Eigen::Index>(trial.models.size());
  ScoreDraws out{Eigen::VectorXd(columns), Eigen::MatrixXd::Constant(rows, columns, kNaN)};
  for (Eigen::Index m = 0; m < columns; ++m) {
    const auto model = static_cast<std::size_t>(m);
    const Against own(trial.bootstraps.of[model], *trial.target, pooled);
    out.scores(m) = trial.models[model].score;
    for (Eigen::Index b = 0; b < rows; ++b) {
      const auto k = static_cast<std::size_t>(b);
      if (recordings[k].failed) continue;
      const double missed =
          trial.bootstraps.scatter[model] * trial.bootstraps.root.normal2(Stream::bootstrap, k, static_cast<std::uint32_t>(m))[0];
      out.draws(b, m) = missed - cost_of(own(recordings[k], k), trial.weighting);
    }
  }
  return out;
}

Band band_of(const Bootstrap& bootstrap, const Target& target) {
  const std::size_t columns = target.columns().size();
  Band out{PerColumn<std::vector<double>>(columns), PerColumn<std::vector<double>>(columns)};
  for (std::size_t j = 0; j < columns; ++j) {
    std::vector<const Histogram*> seen;
    for (const SingleRun& run : bootstrap)
      if (!run.failed && run.distributions[j].histogram.samples > 0) seen.push_back(&run.distributions[j].histogram);
    if (seen.size() < kLeastBand) continue;
    for (std::size_t bin = 0; bin < seen.front()->counts.size(); ++bin) {
      std::vector<double> shares;
      for (const Histogram* h : seen) shares.push_back(static_cast<double>(h->counts[bin]) / static_cast<double>(h->samples));
      out.lower[j].push_back(quantile(shares, kAlpha / 2));
      out.upper[j].push_back(quantile(std::move(shares), 1 - kAlpha / 2));
    }
  }
  return out;
}

std::vector<Certainty> certainties(std::span<const Trial> trials, int pooled) {
  std::vector<Certainty> out(trials.front().models.size());
  for (Certainty& c : out) c.own = Energies(trials.front().target->columns().size(), kNaN);
  for (const Trial& trial : trials)
    if (!long_enough(trial.bootstraps.of, pooled)) return out;
  const ScoreDraws all = mean_draws(trials, pooled);
  const auto p = confidence_set_p(all);
  const auto groups = confidence_groups(all, kAlpha);
  std::vector<double> fits;
  for (std::size_t m = 0; m < out.size(); ++m) {
    Certainty& c = out[m];
    if (trials.size() == 1)
      c.own = mean(own_energies(trials[0].bootstraps.of[m], *trials[0].target, pooled), trials[0].target->columns().size());
    c.gof_p = goodness(distances(trials, m, pooled));
    fits.push_back(c.gof_p);
    c.set_p = p[m];
    c.group = groups[m];
    const auto column = static_cast<Eigen::Index>(m);
    std::tie(c.lower, c.upper) = interval(all.scores(column), all.draws.col(column));
    std::tie(c.lead_lower, c.lead_upper) = interval(all.scores(0) - all.scores(column), all.draws.col(0) - all.draws.col(column));
  }
  const auto adjusted = adjusted_p(fits);
  for (std::size_t m = 0; m < out.size(); ++m) out[m].gof_q = adjusted[m];
  return out;
}

}  // namespace swarmfit
