// SPDX-License-Identifier: MIT
#include "fit/synthesis/extend.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "fit/experiment/conditions.h"
#include "fit/synthesis/recorded_velocities.h"
#include "libswarm/replay.h"
#include "libswarm/simulate.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr double kEscapeSpeed = 1e3;  // in multiples of the recorded mean speed

// Forward differences; the last row repeats the one before, and who was seen once is at rest.
Rows velocities(const Rows& pos, double dt) {
  const Index n = pos.rows();
  Rows vel = Rows::Zero(n, 3);
  for (Index k = 0; k + 1 < n; ++k) vel.row(k) = (pos.row(k + 1) - pos.row(k)) / dt;
  if (n > 1) vel.row(n - 1) = vel.row(n - 2);
  return vel;
}

std::vector<Replay::Individual> individuals_of(const Tracks& recording) {
  std::vector<Replay::Individual> all(recording.track_count());
  for_each_segment(recording, 1, [&](std::span<const Index> rows) {
    const auto first = static_cast<std::size_t>(rows.front());
    Replay::Individual& one = all[recording.track()[first]];
    one.id = recording.track()[first];
    one.kind = recording.kind(rows.front());
    Replay::Stretch stretch{recording.frame()[first], Rows(static_cast<Index>(rows.size()), 3), {}, false};
    for (std::size_t k = 0; k < rows.size(); ++k) stretch.pos.row(static_cast<Index>(k)) = recording.pos().row(rows[k]);
    stretch.vel = velocities(stretch.pos, recording.dt());
    one.stretches.push_back(std::move(stretch));
    one.until = one.stretches.back().last();
  });
  std::erase_if(all, [](const Replay::Individual& one) { return one.stretches.empty(); });
  return all;
}

// Does another take begin in (from, to]?
bool another_take(const Tracks& recording, std::int64_t from, std::int64_t to) {
  const auto takes = recording.episodes();
  return std::any_of(takes.begin(), takes.end(), [&](std::int64_t first) { return from < first && first <= to; });
}

void check_names(const char* setting, const PerIndividual& per, const Tracks& recording) {
  for (const auto& entry : per.own)
    if (std::find(recording.names().begin(), recording.names().end(), entry.first) == recording.names().end())
      throw InputError(fmt::format("`{}` {}: no individual in {} has that name; expected one of {}", setting, entry.first,
                                   recording.meta().from.path, fmt::join(recording.names(), ", ")));
}

// The moving picture in which some are replayed.
struct Staged {
  Tracks all;
  std::vector<Replay::Arrival> arrivals;
};

Staged flown(const Tracks& recording, const Pilot& pilot, std::vector<Replay::Individual> individuals, State start, std::int64_t last,
             std::vector<std::string> names, bool guided) {
  const Scales scales = natural_scales(recording);
  if (!(scales.speed > 0))
    throw InputError(recording.meta().from.path + ": nothing moves; expected tracks of at least two frames with motion");
  Plan plan;
  plan.frame_dt = recording.dt();
  plan.substeps = stable_steps(pilot.model, scales, recording.dt());
  plan.first_frame = recording.frames().front().number;
  plan.frames = last - plan.first_frame + 1;
  plan.speed_limit = kEscapeSpeed * scales.speed;
  const auto model = make_model(pilot.model, {.dims = recording.dims(),
                                              .scales = scales,
                                              .reference = &recording,
                                              .rng = {pilot.seed},
                                              .step = plan.frame_dt / plan.substeps,
                                              .kinds = recording.kinds()});
  World world;
  world.dims = recording.dims();
  world.bounds = parse_arena(pilot.arena, recording);
  world.add(std::make_unique<Replay>(std::move(individuals), recording.dt()));
  auto parameters = pilot_parameters(pilot, scales);
  if (const int row = pilot.model.spec->find("w_user"); guided && row >= 0 && !pilot.set.contains("w_user"))
    parameters[static_cast<std::size_t>(row)] = 1;
  TrackCollector collector(std::move(names));
  Lane lane{std::move(parameters), {pilot.seed}, std::move(start), std::move(world), &collector, {}, false};
  cpu_backend().run(*model, plan, {&lane, 1});
  if (lane.blew_up) throw InputError(pilot.model.name + ": the simulation diverged; expected parameters that keep motion finite");
  return {collector.take(recording.meta()), lane.world.part<Replay>()->arrivals()};
}

// Who was recorded when, as bits by (frame, track); tracks that are not in the recording were not.
class RecordedPoints {
 public:
  explicit RecordedPoints(const Tracks& recording) {
    for (Index row = 0; row < recording.rows(); ++row)
      keys_.push_back({recording.frame()[static_cast<std::size_t>(row)], recording.track()[static_cast<std::size_t>(row)]});
  }
  bool operator()(std::int64_t frame, std::uint32_t track) const {
    return std::binary_search(keys_.begin(), keys_.end(), std::pair(frame, track));
  }

 private:
  std::vector<std::pair<std::int64_t, std::uint32_t>> keys_;  // sorted, as rows are
};

// Spreads what each bridge misses the next stretch by over its frames.
void correct(TrackColumns& columns, const Staged& staged, const RecordedPoints& recorded) {
  for (const Replay::Arrival& a : staged.arrivals) {
    const auto rows = staged.all.rows_of(a.id);
    const auto at = std::lower_bound(rows.begin(), rows.end(), a.frame, [&](Index row, std::int64_t frame) {
      return staged.all.frame()[static_cast<std::size_t>(row)] < frame;
    });
    auto from = at;
    while (from != rows.begin() && !recorded(staged.all.frame()[static_cast<std::size_t>(*(from - 1))], a.id)) --from;
    const auto gap = static_cast<double>(at - from + 1);
    for (auto row = from; row != at; ++row) columns.pos.row(*row) += (static_cast<double>(row - from + 1) / gap * a.missed_by).transpose();
  }
}

Tracks labelled(const Tracks& recording, const Staged& staged) {
  const RecordedPoints recorded(recording);
  TrackColumns columns = staged.all.columns();
  columns.vel.resize(0, 3);
  columns.kind.resize(columns.frame.size(), 0);
  correct(columns, staged, recorded);
  const int kinds = recording.kinds();
  std::size_t synthetic = 0;
  for (std::size_t row = 0; row < columns.frame.size(); ++row)
    if (!recorded(columns.frame[row], columns.track[row]))
      columns.kind[row] = static_cast<std::uint8_t>(columns.kind[row] + kinds), ++synthetic;
  columns.episodes.assign(recording.episodes().begin(), recording.episodes().end());
  TrackMeta meta = recording.meta();
  meta.kinds = origin_kinds(recording);
  meta.from.synthetic = true;
  meta.from.notes.push_back(fmt::format("{} of {} points are synthetic: made by a simulator", synthetic, columns.frame.size()));
  return Tracks(std::move(columns), std::move(meta));
}

}  // namespace

std::int64_t PerIndividual::of(const std::string& name) const {
  const auto found = own.find(name);
  return found == own.end() ? all : found->second;
}

std::vector<std::string> origin_kinds(const Tracks& recording) {
  const int kinds = recording.kinds();
  if (kinds > 127)
    throw InputError(fmt::format("{}: {} kinds of individuals; expected at most 127, as each has a synthetic one beside it",
                                 recording.meta().from.path, kinds));
  if (kinds == 1) return {"recorded", "synthetic"};
  std::vector<std::string> names;
  for (int k = 0; k < kinds; ++k)
    names.push_back(static_cast<std::size_t>(k) < recording.meta().kinds.size() ? recording.meta().kinds[static_cast<std::size_t>(k)]
                                                                                : std::to_string(k));
  for (int k = 0; k < kinds; ++k) names.push_back("synthetic " + names[static_cast<std::size_t>(k)]);
  return names;
}

std::vector<double> pilot_parameters(const Pilot& pilot, const Scales& scales) {
  std::vector<double> values;
  std::vector<std::string_view> names;
  for (const Parameter& p : pilot.model.spec->parameters) {
    values.push_back(p.fit.initial * p.scale(scales));
    names.push_back(p.name);
  }
  for (const auto& [name, value] : pilot.set) {
    const int row = pilot.model.spec->find(name);
    if (row < 0)
      throw InputError(
          fmt::format("`set` {}: {} has no such parameter; expected one of {}", name, pilot.model.spec->name, fmt::join(names, ", ")));
    values[static_cast<std::size_t>(row)] = value;
  }
  return values;
}

Tracks extend(const Tracks& recording, const ExtendOptions& options) {
  check_names("onward", options.onward, recording);
  check_names("bridge", options.bridge, recording);
  auto individuals = individuals_of(recording);
  std::int64_t last = recording.frames().back().number;
  bool guided = false, anything = false;
  for (Replay::Individual& one : individuals) {
    const std::string& name = recording.names()[one.id];
    for (std::size_t k = 0; k + 1 < one.stretches.size(); ++k) {
      const std::int64_t from = one.stretches[k].last(), to = one.stretches[k + 1].first;
      one.stretches[k].bridged = to - from > 1 && to - from - 1 <= options.bridge.of(name) && !another_take(recording, from, to);
      guided = guided || one.stretches[k].bridged;
    }
    one.until += options.onward.of(name);
    anything = anything || options.onward.of(name) > 0;
    last = std::max(last, one.until);
  }
  if (!guided && !anything)
    throw InputError(fmt::format("{}: nothing to add: no track goes on and there is no gap to bridge; expected `onward` frames",
                                 recording.meta().from.path));
  return labelled(recording, flown(recording, options.pilot, std::move(individuals), {}, last, recording.names(), guided));
}

Tracks augment(const Tracks& recording, const AugmentOptions& options) {
  const Rng rng{options.pilot.seed};
  const RecordedVelocities velocities(recording);
  if (velocities.none())
    throw InputError(recording.meta().from.path +
                     ": no individual is seen in two successive frames; expected tracks to take velocities from");
  std::vector<std::string> names = recording.names();
  State start;
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(options.add); ++k) {
    const auto u = rng.uniform2(Stream::start, 0, k);
    const auto place = static_cast<Index>(u[0] * static_cast<double>(recording.rows()));
    start.spawn(0, recording.pos().row(place).transpose(), velocities.at(u[1]), static_cast<std::uint32_t>(recording.track_count()) + k);
    names.push_back(fmt::format("synthetic{}", k + 1));
    if (std::find(recording.names().begin(), recording.names().end(), names.back()) != recording.names().end())
      throw InputError(fmt::format("{}: there is an individual by the name of {}; expected that name to be free",
                                   recording.meta().from.path, names.back()));
  }
  return labelled(recording, flown(recording, options.pilot, individuals_of(recording), std::move(start), recording.frames().back().number,
                                   std::move(names), false));
}

}  // namespace swarmfit
