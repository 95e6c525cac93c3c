// SPDX-License-Identifier: MIT
// How well do tracks go on, and gaps fill? The second half of the longest unbroken run of every individual is hidden, up to HORIZON frames
// of it compared with how `extend` goes on from the first half, and with three simple answers: constant velocity, langevin fitted to the
// first halves, the displacements of a random piece of them. Beside errors stand the total variations between the distributions of the
// seven metrics of the hidden places and of what is said in their stead (30 bins between the 0.5 and the 99.5 % quantile). Then GAP frames
// in the middle of every run are hidden and bridged, beside a straight line and a cubic that meets both ends with their velocities. All
// with bootstrapped 95 % intervals over tracks. By hand:
//   hidden_half FILE [HORIZON] [GAP] [FIRST:LAST] [COLUMNS] [UNIT] [FIT]         FIT: the budget of the fits; none: defaults
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "fit/compare/compare.h"
#include "fit/synthesis/extend.h"
#include "libeval/metrics.h"
#include "libtrack/error.h"
#include "libtrack/quantile.h"
#include "libtrack/read/read.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using Places = std::vector<Array3d>;

constexpr Index kShortest = 16;  // frames of a run
constexpr Rng kRng{2020};

// What is known of an individual, and what is asked.
struct Case {
  std::uint32_t track;
  std::int64_t first;  // frame of the first known place
  Places known, hidden, after;
};

std::vector<std::span<const Index>> longest_runs(const Tracks& recording) {
  std::vector<std::span<const Index>> best(recording.track_count());
  for_each_segment(recording, kShortest, [&](std::span<const Index> rows) {
    auto& longest = best[recording.track()[static_cast<std::size_t>(rows.front())]];
    if (rows.size() > longest.size()) longest = rows;
  });
  std::erase_if(best, [](const auto& rows) { return rows.empty(); });
  return best;
}

std::vector<Case> cases_of(const Tracks& recording, std::size_t horizon, std::size_t gap) {
  std::vector<Case> all;
  for (const auto rows : longest_runs(recording)) {
    const auto first = static_cast<std::size_t>(rows.front());
    Case c{recording.track()[first], recording.frame()[first], {}, {}, {}};
    const std::size_t half = rows.size() / 2, hidden = gap > 0 ? std::min(gap, rows.size() / 4) : std::min(horizon, rows.size() - half);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      Places& to = k < half ? c.known : k < half + hidden ? c.hidden : c.after;
      to.emplace_back(recording.pos().row(rows[k]).transpose());
    }
    if (gap == 0) c.after.clear();
    all.push_back(std::move(c));
  }
  return all;
}

// The known places as a recording.
Tracks visible(const Tracks& recording, const std::vector<Case>& cases) {
  TrackColumns columns;
  Places places;
  columns.names = recording.names();
  for (const Case& c : cases) {
    const auto add = [&](const Places& of, std::int64_t from) {
      for (std::size_t k = 0; k < of.size(); ++k) {
        columns.track.push_back(c.track);
        columns.frame.push_back(from + static_cast<std::int64_t>(k));
        places.push_back(of[k]);
      }
    };
    add(c.known, c.first);
    add(c.after, c.first + static_cast<std::int64_t>(c.known.size() + c.hidden.size()));
  }
  columns.pos.resize(static_cast<Index>(places.size()), 3);
  for (std::size_t k = 0; k < places.size(); ++k) columns.pos.row(static_cast<Index>(k)) = places[k].transpose();
  columns.episodes.assign(recording.episodes().begin(), recording.episodes().end());
  TrackMeta meta = recording.meta();
  meta.kinds.clear();
  return {std::move(columns), meta};
}

std::map<std::string, double> fitted(const Tracks& known, const ModelChoice& model, const std::string& budget) {
  if (budget == "none") return {};
  CompareOptions options;
  options.models = {model};
  options.budget = budget_named(budget);
  options.bootstrap_recordings = 0;
  const Comparison c = compare(known, options);
  const auto values = parameter_values(model, c.models.front());
  std::map<std::string, double> out;
  for (std::size_t p = 0; p < values.size(); ++p)
    if (model.spec->uses(p, model.options)) out[model.spec->parameters[p].name] = values[p];
  out.erase("w_user");  // for extend to set where it leads somewhere
  return out;
}

// Where a case's hidden places are said to be.
using Answers = std::vector<Places>;

Answers by_model(const Tracks& known, const std::vector<Case>& cases, const std::string& name, const std::map<std::string, double>& set) {
  ExtendOptions options;
  options.pilot = {parse_model(name), set, "open", 1};
  options.onward = {0, {}};
  for (const Case& c : cases)
    if (c.after.empty()) options.onward.own[known.names()[c.track]] = static_cast<std::int64_t>(c.hidden.size());
  const Tracks out = extend(known, options);
  Answers answers;
  for (const Case& c : cases) {
    answers.emplace_back();
    const auto rows = out.rows_of(c.track);
    const auto from = c.first + static_cast<std::int64_t>(c.known.size()), to = from + static_cast<std::int64_t>(c.hidden.size());
    for (const Index row : rows)
      if (const auto frame = out.frame()[static_cast<std::size_t>(row)]; frame >= from && frame < to)
        answers.back().emplace_back(out.pos().row(row).transpose());
  }
  return answers;
}

Array3d last_step(const Places& p) { return p.back() - p[p.size() - 2]; }

Answers constant_velocity(const std::vector<Case>& cases) {
  Answers answers;
  for (const Case& c : cases) {
    answers.emplace_back();
    for (std::size_t k = 1; k <= c.hidden.size(); ++k)
      answers.back().push_back(c.known.back() + static_cast<double>(k) * last_step(c.known));
  }
  return answers;
}

// Displacements of a random unbroken piece of somebody's known places; if there is none so long, of as many pieces as it takes.
Answers copied(const std::vector<Case>& cases) {
  Answers answers;
  std::uint32_t draw = 0;
  for (const Case& c : cases) {
    Places out;
    while (out.size() < c.hidden.size()) {
      const auto u = kRng.uniform2(Stream::start, 0, draw++);
      const Places& from = cases[static_cast<std::size_t>(u[0] * static_cast<double>(cases.size()))].known;
      const std::size_t length = std::min(c.hidden.size() - out.size(), from.size() - 1);
      const auto first = static_cast<std::size_t>(u[1] * static_cast<double>(from.size() - length));
      const Array3d base = out.empty() ? c.known.back() : out.back();
      for (std::size_t k = 1; k <= length; ++k) out.push_back(base + from[first + k] - from[first]);
    }
    answers.push_back(std::move(out));
  }
  return answers;
}

Answers straight(const std::vector<Case>& cases, bool cubic) {
  Answers answers;
  for (const Case& c : cases) {
    answers.emplace_back();
    const double n = static_cast<double>(c.hidden.size()) + 1;
    const Array3d a = c.known.back(), b = c.after.front(), va = n * last_step(c.known), vb = n * (c.after[1] - c.after[0]);
    for (std::size_t k = 1; k <= c.hidden.size(); ++k) {
      const double t = static_cast<double>(k) / n, t2 = t * t, t3 = t2 * t;
      answers.back().push_back(cubic ? Array3d((2 * t3 - 3 * t2 + 1) * a + (t3 - 2 * t2 + t) * va + (3 * t2 - 2 * t3) * b + (t3 - t2) * vb)
                                     : Array3d(a + t * (b - a)));
    }
  }
  return answers;
}

double length2(const Array3d& a) { return a.square().sum(); }

// Mean over tracks, and the central 95 % of its bootstrapped values.
std::string estimate(const std::vector<double>& values) {
  const auto mean = [&](auto pick) {
    double sum = 0;
    for (std::size_t k = 0; k < values.size(); ++k) sum += values[pick(k)];
    return sum / static_cast<double>(values.size());
  };
  std::vector<double> means;
  for (std::uint32_t b = 0; b < 2000; ++b)
    means.push_back(mean([&](std::size_t k) {
      return static_cast<std::size_t>(kRng.uniform(Stream::start, 1 + b, static_cast<std::uint32_t>(k)) *
                                      static_cast<double>(values.size()));
    }));
  std::sort(means.begin(), means.end());
  return fmt::format("{:10.4g} [{:.4g}, {:.4g}]", mean([](std::size_t k) { return k; }), means[50], means[1949]);
}

void print(const char* name, const std::vector<Case>& cases, const Answers& answers, bool gap) {
  std::vector<double> error, rms, spread;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Places &truth = cases[k].hidden, &said = answers[k];
    if (said.size() != truth.size()) throw InputError(fmt::format("{} answers {} of {} places", name, said.size(), truth.size()));
    double sum = 0;
    for (std::size_t f = 0; f < truth.size(); ++f) sum += length2(said[f] - truth[f]) / static_cast<double>(truth.size());
    rms.push_back(std::sqrt(sum));
    error.push_back(std::sqrt(length2(said.back() - truth.back())));
    spread.push_back(length2(said.back() - cases[k].known.back()));
  }
  if (gap)
    fmt::print("  {:<22} rms error {}\n", name, estimate(rms));
  else
    fmt::print("  {:<22} end-point error {:<34} mean squared displacement {}\n", name, estimate(error), estimate(spread));
}

// ---- distributions ---------------------------------------------------------------------------------------------------------------

// Values of every metric by individual.
using ByTrack = PerColumn<std::vector<std::vector<double>>>;

ByTrack metrics_of(const Tracks& recording, const std::vector<Case>& cases, const Answers& answers) {
  TrackColumns columns;
  Places places;
  columns.names = recording.names();
  for (std::size_t k = 0; k < cases.size(); ++k)
    for (std::size_t f = 0; f < answers[k].size(); ++f) {
      columns.track.push_back(cases[k].track);
      columns.frame.push_back(cases[k].first + static_cast<std::int64_t>(cases[k].known.size() + f));
      places.push_back(answers[k][f]);
    }
  columns.pos.resize(static_cast<Index>(places.size()), 3);
  for (std::size_t k = 0; k < places.size(); ++k) columns.pos.row(static_cast<Index>(k)) = places[k].transpose();
  TrackMeta meta = recording.meta();
  meta.kinds.clear();
  const Tracks said(std::move(columns), meta);
  const MetricSamples samples = metric_samples(said, {.keep_rows = true});
  ByTrack out(samples.columns.size(), std::vector<std::vector<double>>(recording.track_count()));
  for (std::size_t c = 0; c < out.size(); ++c)
    for (std::size_t k = 0; k < samples.values[c].size(); ++k)
      out[c][said.track()[static_cast<std::size_t>(samples.rows[c][k])]].push_back(samples.values[c][k]);
  return out;
}

// Shares of the bins, of all values of these individuals.
std::vector<double> shares(const std::vector<std::vector<double>>& values, const std::vector<std::size_t>& who, double low, double width) {
  constexpr std::size_t bins = 30;
  std::vector<double> out(bins);
  double count = 0;
  for (const std::size_t track : who)
    for (const double x : values[track]) ++out[static_cast<std::size_t>(std::clamp((x - low) / width * bins, 0.0, bins - 1.0))], ++count;
  for (double& share : out) share /= count;
  return out;
}

std::string variation(const std::vector<std::vector<double>>& truth, const std::vector<std::vector<double>>& said) {
  std::vector<double> all;
  for (const auto& of : truth) all.insert(all.end(), of.begin(), of.end());
  const double low = quantile(all, 0.005), width = quantile(all, 0.995) - low;
  const auto between = [&](const std::vector<std::size_t>& who) {
    const auto a = shares(truth, who, low, width), b = shares(said, who, low, width);
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += std::abs(a[k] - b[k]) / 2;
    return sum;
  };
  std::vector<std::size_t> who(truth.size());
  for (std::size_t k = 0; k < who.size(); ++k) who[k] = k;
  const double seen = between(who);
  std::vector<double> drawn;
  for (std::uint32_t b = 0; b < 500; ++b) {
    std::vector<std::size_t> some(who.size());
    for (std::size_t k = 0; k < some.size(); ++k)
      some[k] =
          static_cast<std::size_t>(kRng.uniform(Stream::start, 3000 + b, static_cast<std::uint32_t>(k)) * static_cast<double>(some.size()));
    if (const double v = between(some); std::isfinite(v)) drawn.push_back(v);
  }
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", seen, quantile(drawn, 0.025), quantile(drawn, 0.975));
}

void print_variations(const char* name, const ByTrack& truth, const ByTrack& said) {
  fmt::print("  {:<22}", name);
  for (std::size_t c = 0; c < truth.size(); ++c) fmt::print(" {}", variation(truth[c], said[c]));
  fmt::print("\n");
}

// -----------------------------------------------------------------------------------------------------------------------------------

void go_on(const Tracks& recording, std::size_t horizon, const std::string& budget) {
  const auto cases = cases_of(recording, horizon, 0);
  const Tracks known = visible(recording, cases);
  fmt::print("{} tracks, second halves hidden, up to {} frames of {:g} s; {}\n", cases.size(), horizon, recording.dt(),
             recording.meta().unit);
  Answers truth;
  for (const Case& c : cases) truth.push_back(c.hidden);
  std::vector<std::pair<const char*, Answers>> all{
      {"recorded", truth},
      {"constant velocity", constant_velocity(cases)},
      {"copied piece", copied(cases)},
      {"langevin", by_model(known, cases, "langevin", fitted(known, parse_model("langevin"), budget))},
      {"fastswarm, defaults", by_model(known, cases, "fastswarm", {})}};
  if (budget != "none")
    all.emplace_back("fastswarm, fitted", by_model(known, cases, "fastswarm", fitted(known, parse_model("fastswarm"), budget)));
  for (const auto& [name, answers] : all) print(name, cases, answers, false);
  fmt::print("total variation of v, a, omega, alpha, mu, d, eta\n");
  const ByTrack recorded = metrics_of(recording, cases, truth);
  for (const auto& [name, answers] : all) print_variations(name, recorded, metrics_of(recording, cases, answers));
}

void bridge(const Tracks& recording, std::size_t gap) {
  const auto cases = cases_of(recording, 0, gap);
  const Tracks known = visible(recording, cases);
  fmt::print("{} tracks, {} frames in the middle hidden\n", cases.size(), gap);
  print("straight line", cases, straight(cases, false), true);
  print("cubic", cases, straight(cases, true), true);
  print("langevin, defaults", cases, by_model(known, cases, "langevin", {}), true);
  print("fastswarm, defaults", cases, by_model(known, cases, "fastswarm", {}), true);
}

}  // namespace
}  // namespace swarmfit

int main(int argc, char** argv) {
  using namespace swarmfit;
  const auto word = [&](int k, const char* otherwise) { return std::string(argc > k ? argv[k] : otherwise); };
  if (argc < 2) return fmt::print(stderr, "hidden_half FILE [HORIZON] [GAP] [FIRST:LAST] [COLUMNS] [UNIT] [FIT]\n"), 2;
  try {
    ReadOptions options;
    const std::string frames = word(4, ":");
    if (const auto colon = frames.find(':'); frames.size() > 1)
      options.frames = Interval{std::atof(frames.c_str()), std::atof(frames.c_str() + colon + 1)};
    options.columns = word(5, "");
    options.unit = word(6, "");
    const Tracks recording = read_tracks(argv[1], options);
    go_on(recording, static_cast<std::size_t>(std::atoi(word(2, "50").c_str())), word(7, "quick"));
    bridge(recording, static_cast<std::size_t>(std::atoi(word(3, "10").c_str())));
  } catch (const std::exception& e) {
    return fmt::print(stderr, "hidden_half: {}\n", e.what()), 1;
  }
  return 0;
}
