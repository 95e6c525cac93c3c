// SPDX-License-Identifier: MIT
#include "fit/study/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "fit/experiment/checkpointed_batches.h"
#include "fit/experiment/stop_between_frames.h"
#include "fit/optimise/differential_evolution.h"
#include "libeval/energy.h"
#include "libeval/order.h"
#include "libtrack/error.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

constexpr std::int64_t kWindow = 200;  // frames
constexpr double kMostRuns = 10'000'000;

// Hands on to the moments; to the record only what comes after the warm-up.
class Measure {
 public:
  Measure(const SweepOptions& options, const Scenario& scene, std::int64_t first)
      : record_(options.measure.what),
        watch_(options.measure.words, options.measure.window > 0 ? options.measure.window : kWindow),
        after_(first + scene.warm_up),
        stream_(moments(options, scene), [this](const Moment& moment) { see(moment); }) {}

  FrameSink& sink() { return stream_; }

  SweepRun result(std::uint64_t seed, bool blew_up) {
    stream_.finish();
    SweepRun run{seed, blew_up, {}, {}};
    for (std::size_t k = 0; k < record_.what().size(); ++k) run.means.push_back(blew_up ? kNaN : mean_defined(record_.values(k)));
    const StateCourse course = watch_.finish();
    if (!blew_up && !course.windows.empty()) run.state = course.windows.back().state->key;
    return run;
  }

 private:
  static MomentOptions moments(const SweepOptions& options, const Scenario& scene) {
    MomentOptions o;
    o.dims = scene.dims;
    o.dt = scene.dt;
    o.link = options.measure.link;
    o.every = options.every;
    if (scene.bounds.kind == Bounds::Kind::periodic) o.period = scene.bounds.upper - scene.bounds.lower;
    return o;
  }

  void see(const Moment& moment) {
    watch_.add(moment);
    if (moment.places().frame >= after_) record_.add(moment);
  }

  OrderRecord record_;
  StateWatch watch_;
  std::int64_t after_;
  MomentStream stream_;
};

// The scenes of one chain of runs, each of which begins where the last one ended; a chain of one for a plain cell.
std::vector<SweepRun> simulated(const SweepOptions& options, const std::vector<Scenario>& scenes, std::uint64_t seed, const Executor& by) {
  Scenario first = scenes.front();
  first.seed = seed;
  Plan plan = plan_of(first);
  const auto rule = model_of(first);
  Lane lane{first.parameters, {seed}, start_of(first), world_of(first), nullptr, {}, false};
  std::vector<SweepRun> out;
  for (const Scenario& scene : scenes) {
    Measure measure(options, scene, plan.first_frame);
    lane.p = scene.parameters;
    StopBetweenFrames watched(by, measure.sink());
    lane.out = &watched;
    if (!lane.blew_up) cpu_backend().run(*rule, plan, {&lane, 1});
    out.push_back(measure.result(seed, lane.blew_up));
    plan.first_frame += plan.frames;
  }
  return out;
}

SweepCell cell_at(const std::vector<SweepAxis>& axes, std::size_t index) {
  SweepCell cell;
  for (const SweepAxis& axis : axes) {
    const std::size_t k = index % axis.value.size();
    index /= axis.value.size();
    cell.place.push_back(axis.value[k]);
    cell.words.push_back(axis.words[k]);
  }
  return cell;
}

std::vector<SweepCell> grid(const std::vector<SweepAxis>& axes) {
  double count = 1;
  for (const SweepAxis& axis : axes) count *= static_cast<double>(axis.value.size());
  if (count > kMostRuns) throw InputError(fmt::format("sweep: {:g} cells; expected {:g} at most", count, kMostRuns));
  std::vector<SweepCell> cells;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) cells.push_back(cell_at(axes, k));
  return cells;
}

// Between the ends of the axes. Words are taken as they come.
std::vector<SweepCell> hypercube(const SweepOptions& o) {
  std::vector<SweepCell> cells;
  for (const Point& p : latin_hypercube(o.latin, static_cast<int>(o.axes.size()), Rng{o.seed}.derive(Stream::probe, 0))) {
    SweepCell cell;
    for (std::size_t a = 0; a < o.axes.size(); ++a) {
      const SweepAxis& axis = o.axes[a];
      const double lower = axis.value.front(), upper = axis.value.back(), u = p[static_cast<Eigen::Index>(a)];
      const auto k = std::min(static_cast<std::size_t>(u * static_cast<double>(axis.value.size())), axis.value.size() - 1);
      double value = axis.log ? lower * std::exp(u * std::log(upper / lower)) : lower + u * (upper - lower);
      if (axis.whole) value = std::min(upper, std::floor(lower + u * (upper - lower + 1)));
      cell.place.push_back(axis.numeric ? value : axis.value[k]);
      cell.words.push_back(axis.numeric ? fmt::format("{}", value) : axis.words[k]);
    }
    cells.push_back(std::move(cell));
  }
  return cells;
}

void summarise(SweepCell& cell, std::size_t quantities) {
  for (std::size_t k = 0; k < quantities; ++k) {
    Moments over;
    for (const SweepRun& run : cell.runs) over.add(run.means[k]);
    cell.mean.push_back(over.count > 0 ? over.mean : kNaN);
    cell.sd.push_back(over.count > 1 ? std::sqrt(over.m2 / static_cast<double>(over.count - 1)) : kNaN);
  }
  std::map<std::string, int> states;
  for (const SweepRun& run : cell.runs)
    if (!run.state.empty()) ++states[run.state];
  int most = 0;
  for (const auto& [state, count] : states)
    if (count > most) most = count, cell.state = state;
  cell.share = cell.runs.empty() ? 0 : static_cast<double>(most) / static_cast<double>(cell.runs.size());
}

// Which cells the runs of one piece of work fill, in the order in which it makes them.
std::vector<std::vector<std::size_t>> chains(const Sweep& sweep, std::size_t up) {
  std::vector<std::vector<std::size_t>> out;
  if (!sweep.hysteresis) {
    for (std::size_t k = 0; k < sweep.cells.size(); ++k) out.push_back({k});
    return out;
  }
  const std::size_t length = sweep.axes.front().value.size();
  for (std::size_t first = 0; first < up; first += length) {
    out.emplace_back();
    for (std::size_t k = 0; k < length; ++k) out.back().push_back(first + k);
    for (std::size_t k = length; k-- > 0;) out.back().push_back(up + first + k);
  }
  return out;
}

std::vector<Scenario> scenes_of(const SweepOptions& options, const Sweep& sweep) {
  std::vector<Scenario> scenes;
  for (const SweepCell& cell : sweep.cells) {
    scenes.push_back(options.scene_at(cell.words));
    model_of(scenes.back());  // refuses what it cannot do
  }
  return scenes;
}

void require_parameter(const SweepAxis& axis, const Scenario& scene) {
  if (scene.model.spec->find(axis.name) < 0)
    throw InputError(
        fmt::format("`hysteresis`: {} is not a parameter of {}; expected one along the first axis, which changes while it runs", axis.name,
                    scene.model.spec->name));
}

}  // namespace

Sweep run_sweep(const SweepOptions& options, const OnSweep& on_progress, const Runtime& runtime, const Part& part) {
  Sweep sweep;
  sweep.axes = options.axes;
  sweep.what = options.measure.what;
  sweep.latin = options.latin > 0, sweep.hysteresis = options.hysteresis;
  sweep.seeds = options.seeds;
  sweep.cells = sweep.latin ? hypercube(options) : grid(options.axes);
  const std::size_t up = sweep.cells.size();
  if (options.hysteresis) {
    const std::vector<SweepCell> way_up = sweep.cells;
    sweep.cells.insert(sweep.cells.end(), way_up.begin(), way_up.end());
    for (std::size_t k = up; k < sweep.cells.size(); ++k) sweep.cells[k].down = true;
  }
  const std::vector<Scenario> scenes = scenes_of(options, sweep);
  sweep.model = scenes.front().model.name;
  if (options.hysteresis) require_parameter(options.axes.front(), scenes.front());

  const auto all = chains(sweep, up);
  const auto seeds = static_cast<std::size_t>(options.seeds);
  std::vector<std::size_t> pieces;  // chain × seed
  std::vector<std::string> keys;
  for (std::size_t k = 0; k < all.size() * seeds; ++k)
    if (part.has(k)) pieces.push_back(k), keys.push_back(sha256_hex(fmt::format("run {}", k)));
  const auto make = [&](std::size_t piece) {
    std::vector<Scenario> chain;
    for (const std::size_t cell : all[piece / seeds]) chain.push_back(scenes[cell]);
    return to_bytes(simulated(options, chain, options.seed + piece % seeds, *runtime.executor));
  };
  const auto work = [&](std::span<const std::size_t> batch) {
    return runtime.executor->run(batch.size(), [&](std::size_t i) { return make(pieces[batch[i]]); });
  };
  const auto on_kept = [&](std::size_t done) {
    if (on_progress) on_progress(done, pieces.size());
  };
  const auto results = checkpointed_batches(runtime.checkpoint, keys, work, on_kept);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    auto runs = from_bytes<std::vector<SweepRun>>(results[k]);
    const auto& cells = all[pieces[k] / seeds];
    for (std::size_t i = 0; i < cells.size(); ++i) sweep.cells[cells[i]].runs.push_back(std::move(runs[i]));
  }
  for (SweepCell& cell : sweep.cells) summarise(cell, sweep.what.size());
  return sweep;
}

}  // namespace swarmfit
